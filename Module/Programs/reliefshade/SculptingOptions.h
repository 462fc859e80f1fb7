// SPDX-License-Identifier: BSD-3-Clause
#ifndef SculptingOptions_h
#define SculptingOptions_h

namespace reliefshade
{

class OptionParser;
struct Options;

/// Adds the options of heights that are made: of meshes, of normal maps, and reliefs.
void addSculptingOptions(OptionParser& parser, Options& options);

}

#endif

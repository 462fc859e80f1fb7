// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightOptions_h
#define LightOptions_h

namespace reliefshade
{

class OptionParser;
struct Options;

/// Adds the options of lights and environment.
void addLightOptions(OptionParser& parser, Options& options);

}

#endif

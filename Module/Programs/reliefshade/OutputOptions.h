// SPDX-License-Identifier: BSD-3-Clause
#ifndef OutputOptions_h
#define OutputOptions_h

namespace reliefshade
{

struct Options;
class OptionParser;

/// Adds the options that say what is in the pictures' files, and how it is stored there.
void addOutputOptions(OptionParser& parser, Options& options);

/// Whether OUTPUT or pictures of layers are written as TIFF by GDAL.
bool writesTiff(const Options& options);

/// Throws a Failure, UsageFailure, where these are of a format that no output has.
void checkOutputOptions(const Options& options);

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef OutputNames_h
#define OutputNames_h

#include <string>

namespace reliefshade
{

struct Options;

/// The file of a layer that has one of its own, beside the picture's.
std::string layerFile(const std::string& picture, const std::string& layer);

/// Gives OUTPUT a file's name, with an extension, where it is the standard output. Throws a Failure
/// for whatever else is to come or go through the standard streams.
void nameStreams(Options& options);

/// Throws a Failure if a run would write over what it reads, or write two outputs to one file. It
/// is asked before anything but the scene is read.
void checkNames(const Options& options);

}

#endif

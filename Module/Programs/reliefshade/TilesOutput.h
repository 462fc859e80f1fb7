// SPDX-License-Identifier: BSD-3-Clause
#ifndef TilesOutput_h
#define TilesOutput_h

#include "RasterFiles.h"

#include <functional>
#include <string>
#include <vector>

namespace reliefshade
{

struct Options;
class OptionParser;

/// Adds the options of tiles for web maps.
void addTilesOptions(OptionParser& parser, Options& options);

/// Where tiles are wanted, makes a GeoTIFF in their folder the OUTPUT. Throws a Failure,
/// UsageFailure, for what does not go with them.
void placeTiles(Options& options);

/// Throws a Failure unless tiles, if they are wanted, can be made of a raster.
void checkTiles(const Options& options, const Raster& raster);

/// Runs with tiles for an output: `run` shades the OUTPUT, if it is not there from a run that was
/// ended before its time, and tiles are made of it. `words` are those of the command line. Throws a
/// Failure.
void runTiles(Options& options, const std::vector<std::string>& words,
  const std::function<void(Options&)>& run);

}

#endif

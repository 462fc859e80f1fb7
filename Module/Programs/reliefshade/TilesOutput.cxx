// SPDX-License-Identifier: BSD-3-Clause
#include "TilesOutput.h"

#include "Failure.h"
#include "OptionParser.h"
#include "Options.h"
#include "OutputNames.h"
#include "Outputs.h"
#include "Ranks.h"
#include "Threads.h"
#include "Watch.h"

#ifdef RELIEFSHADE_STREAMING
#include "CommandKey.h"
#include "TileShading.h"
#include "WebTiles.h"
#endif

#include <algorithm>
#include <filesystem>
#include <memory>

namespace
{

using namespace reliefshade;

#ifdef RELIEFSHADE_STREAMING
//------------------------------------------------------------------------------
/// What the room says of the folder or a file in it, in the program's way.
void inFolder(const std::function<void()>& step)
{
  try
  {
    step();
  }
  catch (const relief::io::Aborted&)
  {
    stopIfInterrupted();
  }
  catch (const relief::io::Failure& failure)
  {
    throw Failure("", failure.what());
  }
}

//------------------------------------------------------------------------------
void makeTiles(const Options& options, relief::streaming::WebTiles& tiles)
{
  const relief::streaming::TilePlan plan = tiles.Plan(options.TilesSize, options.TilesZoom);
  const bool bar = showsBar(options);
  const auto watch = [bar](double share)
  {
    showProgress(bar, "tiles", share);
    return !interrupted();
  };
  tiles.Make(plan, watch);
}
#endif

//------------------------------------------------------------------------------
std::array<int, 2> toZoom(const std::string& word)
{
  const std::size_t hyphen = word.find('-', 1);
  const std::array<double, 2> zoom = { toWhole("--zoom", word.substr(0, hyphen)),
    toWhole("--zoom", hyphen == std::string::npos ? word : word.substr(hyphen + 1)) };
  constexpr double most = 24.0;
  if (!(zoom[0] >= 0.0) || !(zoom[0] <= zoom[1]) || !(zoom[1] <= most))
  {
    throw Failure(
      "--zoom", "'" + word + "' was given, LEAST-GREATEST from 0 to 24 is expected", UsageFailure);
  }
  return { static_cast<int>(zoom[0]), static_cast<int>(zoom[1]) };
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void addTilesOptions(OptionParser& parser, Options& options)
{
  parser.SetGroup("Tiles for web maps");
  parser.Word("--xyz", "DIR",
    "Writes tiles for web maps in place of OUTPUT. DIR/z/x/y.png in Web Mercator, y from the "
    "north, 8 bits of red, green, blue and alpha, none where there is no data, and DIR/tiles.json "
    "about them. INPUT needs a georeference. DIR is made; it has the whole picture as well until "
    "the tiles are done. The same command goes on with what was stopped",
    [&options](const std::string& folder)
    {
#ifdef RELIEFSHADE_STREAMING
      options.TilesFolder = folder;
#else
      throw Failure("--xyz", "needs GDAL, without which this program is built", UsageFailure);
#endif
    });
  parser.Word("--zoom", "LEAST-GREATEST",
    "Which tiles --xyz writes. From 0 to 24, as 8-14. Default: from the zoom at which one tile or "
    "two hold all to the one whose resolution is nearest to INPUT's",
    [&options](const std::string& word) { options.TilesZoom = toZoom(word); });
  const std::vector<std::string> sizes = { "256", "512" };
  parser.Word("--xyz-size", "256|512", "Samples along the side of a tile. Default: 256",
    [&options, sizes](const std::string& word)
    { options.TilesSize = toChoice("--xyz-size", word, sizes) == 0 ? 256 : 512; });
}

//------------------------------------------------------------------------------
void placeTiles(Options& options)
{
  if (options.TilesFolder.empty())
  {
    const char* const option = options.TilesZoom ? "--zoom"
      : options.TilesSize != 256                 ? "--xyz-size"
                                                 : nullptr;
    if (option)
    {
      throw Failure(option, "is about tiles; expected --xyz", UsageFailure);
    }
    return;
  }
  const char* const other = !options.Output.empty()         ? "OUTPUT"
    : options.Times.Frames                                  ? "--frames"
    : options.OutputType == VTK_FLOAT                       ? "--type float"
    : options.Bands != Options::AutoBands                   ? "--bands"
    : !options.Layers.empty() && options.LayersFile.empty() ? "--layers without a file"
                                                            : nullptr;
  if (other)
  {
    throw Failure("--xyz",
      std::string("tiles are one picture of 8 bits, red, green, blue and alpha, and the only "
                  "OUTPUT; expected no ") +
        other,
      UsageFailure);
  }
  if (isStandardInput(options.Input))
  {
    throw Failure("--xyz", "a run that goes on reads INPUT again; expected a file", UsageFailure);
  }
  options.Output = (std::filesystem::path(options.TilesFolder) / "shaded.tif").string();
  options.Bands = Options::Rgba;
  options.OutputType = VTK_UNSIGNED_CHAR;
  options.Tiff.CreationOptions = { "TILED=YES" }; // parts of it are read
  checkNames(options);
}

//------------------------------------------------------------------------------
void checkTiles(const Options& options, const Raster& raster)
{
#ifdef RELIEFSHADE_STREAMING
  if (!options.TilesFolder.empty())
  {
    try
    {
      const int size[2] = { raster.Columns, raster.Rows };
      relief::streaming::PlanTiles(raster.Reference, size, options.TilesSize, options.TilesZoom);
    }
    catch (const relief::io::Failure& failure)
    {
      throw Failure(options.Input, failure.what());
    }
  }
#else
  static_cast<void>(options);
  static_cast<void>(raster);
#endif
}

//------------------------------------------------------------------------------
void runTiles(
  Options& options, const std::vector<std::string>& words, const std::function<void(Options&)>& run)
{
#ifdef RELIEFSHADE_STREAMING
  inFolder(
    [&]
    {
      const std::vector<std::string> named = options.SceneEnvironment.empty()
        ? std::vector<std::string>()
        : std::vector<std::string>{ options.SceneEnvironment };
      // Of several processes, which shade the picture together, the first one makes the tiles.
      std::unique_ptr<relief::streaming::WebTiles> tiles;
      const bool first = ranks().GetRank() == 0;
      ranks().Together(
        [&]
        {
          tiles = first ? std::make_unique<relief::streaming::WebTiles>(
                            options.TilesFolder, commandKey(words, named) + memoryKey(options))
                        : nullptr;
        });
      // What the first one finds, all know.
      const bool done = ranks().FindFailed(!first || !tiles->AreDone()) == 0;
      const bool shades = ranks().FindFailed(!first || done || tiles->HasPicture()) == 0;
      if (done)
      {
        return;
      }
      try
      {
        if (shades)
        {
          run(options);
        }
        ranks().Together(
          [&]
          {
            if (first)
            {
              setThreads(options.Threads);
              makeTiles(options, *tiles);
            }
          });
      }
      catch (...)
      {
        if (first)
        {
          tiles->Forget();
        }
        throw;
      }
    });
#else
  static_cast<void>(words);
  run(options);
#endif
}

}

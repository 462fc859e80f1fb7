// SPDX-License-Identifier: BSD-3-Clause
#include "OutputOptions.h"

#include "Failure.h"
#include "OptionParser.h"
#include "Options.h"
#include "OutputNames.h"
#include "PictureChoice.h"
#include "PictureOutput.h"

#include <algorithm>

namespace
{

using namespace reliefshade;
using relief::raster::GeoTiffForm;

//------------------------------------------------------------------------------
Failure needsTiff(const char* option)
{
#ifdef RELIEFRASTER_USE_GDAL
  return Failure(option, "is for TIFF; OUTPUT is to end in .tif", UsageFailure);
#else
  return Failure(option, "needs GDAL, without which this program is built", UsageFailure);
#endif
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
bool writesTiff(const Options& options)
{
  return isGeoTiff(options.Output) || isGeoTiff(options.ShadowMask) ||
    (options.LayersFile.empty() &&
      std::any_of(options.Layers.begin(), options.Layers.end(),
        [&options](const std::string& layer)
        { return isGeoTiff(layerFile(options.Output, layer)); }));
}

//------------------------------------------------------------------------------
void addOutputOptions(OptionParser& parser, Options& options)
{
  const auto set = [](auto& member, auto value) { return [&member, value] { member = value; }; };
  const std::vector<std::string> bands = { "auto", "grey", "rgb", "rgba" };
  parser.Word("--bands", "auto|grey|rgb|rgba",
    "Which components OUTPUT has. auto: grey where material and lights are grey, else red, green "
    "and blue; alpha where some samples have no data; OpenEXR, Radiance HDR and PFM get all four. "
    "grey and rgb: no alpha; rgba: all four. What a format lacks is left out. Default: auto",
    [&options, bands](const std::string& word)
    {
      const std::string name = isWord(word, "gray") ? "grey" : word;
      options.Bands = static_cast<Options::PictureBands>(toChoice("--bands", name, bands));
    });
  parser.Choice("--nodata-out",
    "How OUTPUT tells samples without data. alpha: by an alpha of 0; value: TIFF declares a value, "
    "0, which samples with data do not have: black becomes 1; in floating point NaN. Default: "
    "value in floating point and with --bands grey or rgb, else alpha",
    { { "alpha", set(options.NoDataOut, Options::ByAlpha) },
      { "value", set(options.NoDataOut, Options::ByValue) } });
  parser.Choice("--compress",
    "How TIFF is compressed, without loss. What takes less room takes longer to write. Default: "
    "none; with --format cog GDAL's",
    { { "none", set(options.Tiff.Compression, GeoTiffForm::None) },
      { "deflate", set(options.Tiff.Compression, GeoTiffForm::Deflate) },
      { "zstd", set(options.Tiff.Compression, GeoTiffForm::ZStd) },
      { "lzw", set(options.Tiff.Compression, GeoTiffForm::LZW) } });
  const std::vector<std::string> formats = { "gtiff", "cog", "png", "jpg", "exr", "hdr", "bmp",
    "ppm" };
  parser.Word("--format", "gtiff|cog|png|jpg|exr|hdr|bmp|ppm",
    "What kind of TIFF is written, or what goes to the standard output. gtiff: GeoTIFF, BigTIFF "
    "where 4 GB may not do; cog: cloud-optimized, with tiles and overviews; the others are for the "
    "standard output: of files the extension tells. Default: gtiff",
    [&options, formats](const std::string& word)
    {
      options.Format = formats[static_cast<std::size_t>(toChoice("--format", word, formats))];
      options.Tiff.CloudOptimized = options.Format == "cog";
    });
  parser.Flag("--overviews",
    "TIFF gets overviews: smaller copies of the picture, for maps that show it from afar",
    options.Tiff.Overviews);
  parser
    .Word("--co", "NAME=VALUE",
      "One of GDAL's creation options for TIFF. As TILED=YES. May be repeated; it goes before what "
      "other options choose",
      [&options](const std::string& word) { options.Tiff.CreationOptions.push_back(word); })
    ->trigger_on_parse();
}

//------------------------------------------------------------------------------
void checkOutputOptions(const Options& options)
{
  const GeoTiffForm& form = options.Tiff;
  const char* const option = !form.CreationOptions.empty() ? "--co"
    : form.Compression != GeoTiffForm::Usual               ? "--compress"
    : form.CloudOptimized                                  ? "--format"
    : form.Overviews                                       ? "--overviews"
                                                           : nullptr;
  if (option && !writesTiff(options))
  {
    throw needsTiff(option);
  }
  if (options.NoDataOut == Options::ByValue && !isGeoTiff(options.Output) &&
    !(options.Output.empty() && isGeoTiff(options.ShadowMask)))
  {
    throw needsTiff("--nodata-out"); // which is not about layers
  }
  if (options.Bands == Options::Rgba && options.NoDataOut == Options::ByValue)
  {
    throw Failure("--nodata-out", "--bands rgba has an alpha; expected alpha", UsageFailure);
  }
  if (options.Bands == Options::Grey && !colorOf(options).empty())
  {
    throw Failure("--bands",
      "the picture is not grey: " + colorOf(options) +
        "; expected auto or "
        "rgb",
      UsageFailure);
  }
}

}

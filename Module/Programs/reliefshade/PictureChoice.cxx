// SPDX-License-Identifier: BSD-3-Clause
#include "PictureChoice.h"

#include "Options.h"
#include "PictureOutput.h"

namespace reliefshade
{

namespace
{
relief::raster::GeoTiffForm tiffOf(const Options& options)
{
  relief::raster::GeoTiffForm form = options.Tiff;
  form.Threads = options.Threads;
  return form;
}

//------------------------------------------------------------------------------
/// As the user has asked for it, where the file's format can.
void markNoData(const Options& options, const std::string& file, bool lacksData, PictureForm& form)
{
  if (options.NoDataOut == Options::ByAlpha ||
    (options.NoDataOut == Options::ByValue && isGeoTiff(file)))
  {
    form.Alpha = lacksData && options.NoDataOut == Options::ByAlpha;
    form.ByValue = lacksData && options.NoDataOut == Options::ByValue;
  }
}
}

//------------------------------------------------------------------------------
std::string colorOf(const Options& options)
{
  for (const std::string* picture :
    { &options.DiffuseTexture, &options.BaseTexture, &options.SpecularTexture, &options.Tint })
  {
    if (!picture->empty())
    {
      return *picture + " may have colours";
    }
  }
  return colorOf(options.Scene);
}

//------------------------------------------------------------------------------
int outputType(const Options& options)
{
  if (options.OutputType != VTK_VOID)
  {
    return options.OutputType;
  }
  return options.Output.empty() ? VTK_FLOAT : usualScalarType(options.Output);
}

//------------------------------------------------------------------------------
PictureForm formOfOutput(const Options& options, bool lacksData)
{
  const bool isGrey = colorOf(options).empty();
  PictureForm form = usualForm(options.Output, outputType(options), isGrey, lacksData);
  form.Tiff = tiffOf(options);
  if (options.Bands == Options::Rgba)
  {
    form.Colors = 3;
    form.Alpha = true;
    form.ByValue = false;
    return form;
  }
  if (options.Bands != Options::AutoBands)
  {
    form.Colors = options.Bands == Options::Grey ? 1 : 3;
    form.Alpha = false;
    form.ByValue = lacksData && isGeoTiff(options.Output);
  }
  markNoData(options, options.Output, lacksData, form);
  return form;
}

//------------------------------------------------------------------------------
PictureForm formOfMask(const Options& options, bool lacksData)
{
  PictureForm form = usualForm(options.ShadowMask, VTK_UNSIGNED_CHAR, true, lacksData);
  form.Tiff = tiffOf(options);
  markNoData(options, options.ShadowMask, lacksData, form);
  return form;
}

//------------------------------------------------------------------------------
PictureForm formOfLayer(const Options& options, int components)
{
  PictureForm form;
  form.ScalarType = VTK_FLOAT;
  form.Colors = components;
  form.Alpha = false;
  form.Tiff = tiffOf(options);
  return form;
}

}

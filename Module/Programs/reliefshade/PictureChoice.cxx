// SPDX-License-Identifier: BSD-3-Clause
#include "PictureChoice.h"

#include "Options.h"
#include "PictureOutput.h"

namespace reliefshade
{

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
  form.Tiff = options.Tiff;
  form.Tiff.Threads = options.Threads;
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
  if (options.NoDataOut != Options::UsualNoData)
  {
    form.Alpha = lacksData && options.NoDataOut == Options::ByAlpha;
    form.ByValue = lacksData && options.NoDataOut == Options::ByValue;
  }
  return form;
}

//------------------------------------------------------------------------------
PictureForm formOfLayer(const Options& options, int components)
{
  PictureForm form;
  form.ScalarType = VTK_FLOAT;
  form.Colors = components;
  form.Alpha = false;
  form.Tiff = options.Tiff;
  form.Tiff.Threads = options.Threads;
  return form;
}

}

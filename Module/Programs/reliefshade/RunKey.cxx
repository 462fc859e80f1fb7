// SPDX-License-Identifier: BSD-3-Clause
#include "RunKey.h"

#include "Options.h"
#include "RunKeys.h"
#include "SurveyFile.h"

#include "vtkImageData.h"
#include "vtkImageReliefShading.h"

#include <locale>
#include <sstream>

namespace reliefshade
{

//------------------------------------------------------------------------------
std::string keyOfRun(
  const Options& options, const std::string& heights, vtkImageReliefShading* shading)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << "version: ReliefShading " RELIEFSHADE_VERSION ", model "
       << vtkImageReliefShading::GetModelVersion() << "\n"
       << "heights: " << heights << "\n";
  // Which options may change, and the file's georeference.
  const double* spacing =
    vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0))->GetSpacing();
  text << "spacing: " << spacing[0] << " " << spacing[1] << "\n";
  text << relief::streaming::KeyOfScene(shading->GetScene());
  for (const std::string& file : { options.Environment, options.SceneEnvironment,
         options.DiffuseTexture, options.BaseTexture, options.SpecularTexture, options.Tint })
  {
    text << "picture: " << (file.empty() ? "none" : file + " " + relief::raster::StateOfInput(file))
         << "\n";
  }
  text << "numbers: " << (shading->GetOutputScalarType() == VTK_FLOAT ? "float" : "uint8") << "\n";
  return text.str();
}

}

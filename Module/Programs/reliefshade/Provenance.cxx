// SPDX-License-Identifier: BSD-3-Clause
#include "Provenance.h"

#include "vtkImageReliefShading.h"
#include "vtkReliefScene.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace reliefshade
{

//------------------------------------------------------------------------------
std::map<std::string, std::string> provenance(
  vtkImageReliefShading* shading, const std::string& verified)
{
  vtkReliefScene* scene = shading->GetScene();
  std::map<std::string, std::string> metadata;
  metadata["TIFFTAG_SOFTWARE"] = "ReliefShading " RELIEFSHADE_VERSION;
  metadata["RELIEF_MODEL_VERSION"] = std::to_string(vtkImageReliefShading::GetModelVersion());
  metadata["RELIEF_HEIGHT_HASH"] = shading->GetHeightHash();
  if (scene->GetIntegrator() == vtkReliefScene::Exact)
  {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::setprecision(9) << scene->GetTolerance();
    metadata["RELIEF_TOLERANCE"] = text.str();
  }
  if (!verified.empty())
  {
    metadata["RELIEF_VERIFIED"] = verified;
  }
  return metadata;
}

}

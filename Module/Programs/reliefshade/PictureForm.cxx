// SPDX-License-Identifier: BSD-3-Clause
#include "PictureForm.h"

#include "PictureOutput.h"

#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

namespace
{

bool isGrey(const double color[3])
{
  return color[0] == color[1] && color[1] == color[2];
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
std::string colorOf(vtkReliefScene* scene)
{
  vtkReliefMaterial* material = scene->GetMaterial();
  if (!isGrey(material->GetBaseColor()) || !isGrey(material->GetDiffuseColor()) ||
    !isGrey(material->GetSpecularColor()))
  {
    return "its material has a colour";
  }
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    if (!isGrey(light->GetDiffuseColor()))
    {
      return "a light has a colour";
    }
  }
  vtkReliefEnvironment* environment = scene->GetEnvironment();
  const bool white =
    !environment || environment->GetImageSource() == vtkReliefEnvironment::WhiteDome;
  return white ? std::string() : "light from all around may have colours";
}

//------------------------------------------------------------------------------
PictureForm usualForm(const std::string& file, int scalarType, bool isGrey, bool lacksData)
{
  PictureForm form;
  form.ScalarType = scalarType;
  if (usualScalarType(file) != VTK_FLOAT)
  {
    form.Colors = isGrey ? 1 : 3;
    form.ByValue = lacksData && scalarType == VTK_FLOAT && isGeoTiff(file);
    form.Alpha = lacksData && !form.ByValue;
  }
  return form;
}

}

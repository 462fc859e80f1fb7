// SPDX-License-Identifier: BSD-3-Clause
#include "RunKey.h"

#include "Options.h"
#include "SceneParameters.h"
#include "SurveyFile.h"

#include "vtkCollectionRange.h"
#include "vtkImageReliefShading.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <locale>
#include <sstream>

namespace
{

//------------------------------------------------------------------------------
void addParameters(
  relief::parameters::Owner owner, vtkObject* object, const char* name, std::ostream& text)
{
  text << name << ":";
  for (const relief::parameters::Parameter& parameter : relief::parameters::All())
  {
    if (parameter.Of == owner)
    {
      text << " " << parameter.Name;
      for (const double value : parameter.Get(object))
      {
        text << " " << value;
      }
    }
  }
  text << "\n";
}

//------------------------------------------------------------------------------
void addLights(vtkReliefScene* scene, std::ostream& text)
{
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    double position[3];
    double focus[3];
    light->GetTransformedPosition(position);
    light->GetTransformedFocalPoint(focus);
    text << "light: " << (light->GetPositional() ? "lamp" : "sun");
    for (int axis = 0; axis < 3; ++axis)
    {
      text << " " << position[axis] << " " << focus[axis];
    }
    text << " " << light->GetSwitch() << " ";
    addParameters(relief::parameters::Owner::Light, light, "with", text);
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
std::string keyOfRun(
  const Options& options, const std::string& heights, vtkImageReliefShading* shading)
{
  using relief::parameters::Owner;
  vtkReliefScene* scene = shading->GetScene();
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << "version: ReliefShading " RELIEFSHADE_VERSION ", model "
       << vtkImageReliefShading::GetModelVersion() << "\n"
       << "heights: " << heights << "\n";
  if (options.Spacing)
  {
    text << "spacing: " << (*options.Spacing)[0] << " " << (*options.Spacing)[1] << "\n";
  }
  addParameters(Owner::Scene, scene, "scene", text);
  addParameters(Owner::Material, scene->GetMaterial(), "material", text);
  addLights(scene, text);
  if (scene->GetEnvironment())
  {
    addParameters(Owner::Environment, scene->GetEnvironment(), "environment", text);
  }
  for (const std::string& file : { options.Environment, options.SceneEnvironment,
         options.DiffuseTexture, options.BaseTexture, options.SpecularTexture, options.Tint })
  {
    text << "picture: "
         << (file.empty() ? "none" : file + " " + relief::raster::StateOfFiles({ file })) << "\n";
  }
  text << "numbers: " << (shading->GetOutputScalarType() == VTK_FLOAT ? "float" : "uint8") << "\n";
  return text.str();
}

}

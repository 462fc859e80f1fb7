// SPDX-License-Identifier: BSD-3-Clause
#include "PreparedScene.h"

#include "HostInputs.h"
#include "SceneConversion.h"

#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkReliefScene.h"

#include <algorithm>
#include <tuple>

namespace relief::hosts
{
namespace
{
// A light of the world in the coordinates of data.
vtkSmartPointer<vtkLight> ToData(vtkLight* light, vtkMatrix4x4* toData)
{
  auto transform = [&](const double world[3], double data[3])
  {
    const double point[4] = { world[0], world[1], world[2], 1.0 };
    double result[4];
    toData->MultiplyPoint(point, result);
    std::transform(result, result + 3, data, [&](double c) { return c / result[3]; });
  };
  double position[3];
  double focal[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focal);
  transform(position, position);
  transform(focal, focal);
  auto result = vtkSmartPointer<vtkLight>::New();
  result->SetLightTypeToSceneLight();
  result->SetPositional(light->GetPositional());
  result->SetPosition(position);
  result->SetFocalPoint(focal);
  result->SetDiffuseColor(light->GetDiffuseColor());
  result->SetIntensity(light->GetIntensity());
  result->SetSwitch(light->GetSwitch());
  result->SetInformation(light->GetInformation());
  return result;
}
}

//------------------------------------------------------------------------------
bool PreparedScene::StandIn::operator==(const StandIn& other) const
{
  return this->light == other.light && this->time == other.time &&
    this->transform == other.transform && this->transformTime == other.transformTime;
}

//------------------------------------------------------------------------------
bool PreparedScene::Origin::operator==(const Origin& other) const
{
  auto parts = [](const Origin& o)
  { return std::tie(o.scene, o.time, o.field, o.textures, o.standIns, o.toWorld); };
  return parts(*this) == parts(other);
}

//------------------------------------------------------------------------------
PreparedScene::Origin PreparedScene::FindOrigin(
  HostInputs& inputs, vtkLightCollection* worldLights, vtkMatrix4x4* toWorld)
{
  Origin origin;
  origin.scene = inputs.GetScene();
  origin.time = origin.scene->GetMTime();
  origin.field = inputs.GetField().GetVersion();
  origin.textures = inputs.GetTextures().GetVersion();
  const bool unlit =
    origin.scene->GetLights()->GetNumberOfItems() == 0 && !origin.scene->GetEnvironment();
  if (!unlit || !worldLights)
  {
    return origin;
  }
  for (vtkLight* light : vtk::Range(worldLights))
  {
    if (!light->LightTypeIsHeadlight())
    {
      vtkMatrix4x4* transform = light->GetTransformMatrix();
      origin.standIns.push_back(
        { light, light->GetMTime(), transform, transform ? transform->GetMTime() : 0 });
    }
  }
  if (!origin.standIns.empty() && toWorld)
  {
    std::copy_n(toWorld->GetData(), 16, origin.toWorld.begin());
  }
  return origin;
}

//------------------------------------------------------------------------------
std::string PreparedScene::Update(
  HostInputs& inputs, vtkLightCollection* worldLights, vtkMatrix4x4* toWorld)
{
  const Origin origin = FindOrigin(inputs, worldLights, toWorld);
  if (this->MadeFrom == origin)
  {
    return std::string();
  }
  this->MadeFrom = Origin(); // of no scene
  const HeightField& field = inputs.GetField();
  Scene scene = ConvertMaterial(origin.scene, inputs.GetFrame(), field.GetDatum());

  vtkNew<vtkLightCollection> standIns;
  vtkNew<vtkMatrix4x4> toData;
  if (toWorld)
  {
    vtkMatrix4x4::Invert(toWorld, toData);
  }
  for (const StandIn& standIn : origin.standIns)
  {
    standIns->AddItem(ToData(standIn.light, toData));
  }
  std::string wrong =
    ConvertLights(origin.scene, origin.standIns.empty() ? nullptr : standIns.Get(),
      inputs.GetEnvironmentLights(), inputs.GetFrame(), field, scene);
  wrong = wrong.empty() ? inputs.GetTextures().AddTo(scene) : wrong;
  if (wrong.empty())
  {
    this->Converted = std::move(scene);
    ++this->Version;
    this->MadeFrom = origin;
  }
  return wrong;
}
}

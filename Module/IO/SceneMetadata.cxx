// SPDX-License-Identifier: BSD-3-Clause
#include "SceneMetadata.h"

#include "ImageFrame.h"
#include "ModelVersion.h"
#include "SceneParameters.h"

#include "vtkCollectionRange.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkReliefAngles.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <ImfFloatAttribute.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

namespace relief::io
{
namespace
{
/// Adds attributes whose names begin alike. Numbers are single precision where that is enough:
/// compositors show those, and pass over doubles.
class Attributes
{
public:
  Attributes(Imf::Header& header, const std::string& prefix)
    : Header(header)
    , Prefix(prefix)
  {
  }

  void Text(const std::string& name, const std::string& value)
  {
    this->Header.insert(this->Prefix + name, Imf::StringAttribute(value));
  }
  void Count(const std::string& name, int value)
  {
    this->Header.insert(this->Prefix + name, Imf::IntAttribute(value));
  }
  void Number(const std::string& name, double value)
  {
    this->Header.insert(this->Prefix + name, Imf::FloatAttribute(static_cast<float>(value)));
  }
  /// World coordinates need all their digits.
  void Place(const std::string& name, const double v[3])
  {
    this->Header.insert(this->Prefix + name, Imf::V3dAttribute(Imath::V3d(v[0], v[1], v[2])));
  }
  void Parameter(const parameters::Parameter& parameter, const parameters::Values& v)
  {
    const std::string name = this->Prefix + parameter.Key;
    switch (parameter.Is)
    {
      case parameters::Kind::Count:
      case parameters::Kind::Flag:
        this->Count(parameter.Key, static_cast<int>(v[0]));
        break;
      case parameters::Kind::Choice:
        this->Text(parameter.Key, parameters::Text(parameter, v));
        break;
      case parameters::Kind::Range:
        this->Header.insert(name, Imf::V2fAttribute(Imath::V2f(Imath::V2d(v[0], v[1]))));
        break;
      case parameters::Kind::Color:
        this->Header.insert(name, Imf::V3fAttribute(Imath::V3f(Imath::V3d(v[0], v[1], v[2]))));
        break;
      default:
        this->Number(parameter.Key, v[0]);
    }
  }
  /// Those that count.
  void Parameters(parameters::Owner owner, vtkObject* object)
  {
    for (const parameters::Parameter* parameter : parameters::Of(owner))
    {
      if (parameters::Counts(*parameter, object))
      {
        this->Parameter(*parameter, parameter->Get(object));
      }
    }
  }

private:
  Imf::Header& Header;
  std::string Prefix;
};

//------------------------------------------------------------------------------
void AddLight(vtkLight* light, Attributes attributes)
{
  double position[3];
  double focal[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focal);
  attributes.Text("kind", light->GetPositional() ? "point" : "sun");
  if (light->GetPositional())
  {
    attributes.Place("position", position);
  }
  else
  {
    double toward[3];
    vtkMath::Subtract(position, focal, toward);
    double azimuth;
    double altitude;
    vtkReliefAngles(toward, azimuth, altitude);
    attributes.Number("azimuth", azimuth);
    attributes.Number("altitude", altitude);
  }
  attributes.Parameters(parameters::Owner::Light, light);
}

//------------------------------------------------------------------------------
void AddLights(vtkReliefScene* scene, Imf::Header& header)
{
  // A scene without any light is lit by this sun.
  vtkNew<vtkReliefScene> unlit;
  vtkLightCollection* lights = scene->GetLights();
  if (lights->GetNumberOfItems() == 0 && !scene->GetEnvironment())
  {
    unlit->AddSun(parameters::UsualAzimuth, parameters::UsualAltitude);
    lights = unlit->GetLights();
  }
  int count = 0;
  for (vtkLight* light : vtk::Range(lights))
  {
    if (light->GetSwitch())
    {
      AddLight(light, Attributes(header, "relief:light" + std::to_string(++count) + ":"));
    }
  }
  Attributes(header, "relief:").Count("lights", count);
}

//------------------------------------------------------------------------------
void AddEnvironment(vtkReliefEnvironment* environment, Attributes attributes)
{
  const int source = environment->GetImageSource();
  attributes.Text("image",
    environment->GetImage() || source != vtkReliefEnvironment::UserImage
      ? parameters::NameAsKey(parameters::ImageSourceNames()[source])
      : "none");
  if (source == vtkReliefEnvironment::File)
  {
    attributes.Text("file", environment->GetFileName());
  }
  if (source == vtkReliefEnvironment::ClearSky)
  {
    attributes.Number("azimuth", environment->GetClearSkyParameters()[0]);
    attributes.Number("altitude", environment->GetClearSkyParameters()[1]);
    attributes.Number("turbidity", environment->GetClearSkyParameters()[2]);
  }
  attributes.Parameters(parameters::Owner::Environment, environment);
}
}

//------------------------------------------------------------------------------
std::string AddMetadata(vtkImageData* image, vtkReliefScene* scene, Imf::Header& header)
{
  hosts::ImageFrame frame;
  const std::string wrong = frame.Assign(image);
  if (!wrong.empty())
  {
    return wrong;
  }
  header.pixelAspectRatio() = static_cast<float>(frame.Spacing[0] / frame.Spacing[1]);
  header.insert("Software", Imf::StringAttribute("ReliefShading " RELIEFSHADING_VERSION));
  Attributes attributes(header, "relief:");
  attributes.Count("modelVersion", ModelVersion);
  attributes.Place("origin", image->GetPoint(0));
  attributes.Place("spacing", image->GetSpacing());
  if (!scene)
  {
    return std::string();
  }
  attributes.Parameters(parameters::Owner::Scene, scene);
  AddLights(scene, header);
  if (scene->GetEnvironment())
  {
    AddEnvironment(scene->GetEnvironment(), Attributes(header, "relief:environment:"));
  }
  vtkReliefMaterial* material = scene->GetMaterial();
  attributes.Parameters(parameters::Owner::Material, material);
  // The one in use.
  attributes.Number("subsurfaceDepth", material->GetDepthFor(frame.Spacing));
  return std::string();
}
}

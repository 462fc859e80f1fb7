// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefMetadata.h"

#include "vtkCollectionRange.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkReliefConversion.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <ImfFloatAttribute.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include <cmath>

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

  void Text(const char* name, const std::string& value)
  {
    this->Header.insert(this->Prefix + name, Imf::StringAttribute(value));
  }
  void Count(const char* name, int value)
  {
    this->Header.insert(this->Prefix + name, Imf::IntAttribute(value));
  }
  void Number(const char* name, double value)
  {
    this->Header.insert(this->Prefix + name, Imf::FloatAttribute(static_cast<float>(value)));
  }
  void Pair(const char* name, const double v[2])
  {
    this->Header.insert(this->Prefix + name, Imf::V2fAttribute(Imath::V2f(Imath::V2d(v[0], v[1]))));
  }
  void Triple(const char* name, const double v[3])
  {
    this->Header.insert(
      this->Prefix + name, Imf::V3fAttribute(Imath::V3f(Imath::V3d(v[0], v[1], v[2]))));
  }
  /// World coordinates need all their digits.
  void Place(const char* name, const double v[3])
  {
    this->Header.insert(this->Prefix + name, Imf::V3dAttribute(Imath::V3d(v[0], v[1], v[2])));
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
    // As vtkReliefScene::AddSun takes them: clockwise from +y, and above the horizon.
    const double azimuth = vtkMath::DegreesFromRadians(std::atan2(toward[0], toward[1]));
    attributes.Number("azimuth", azimuth < 0.0 ? azimuth + 360.0 : azimuth);
    attributes.Number("altitude",
      vtkMath::DegreesFromRadians(std::atan2(toward[2], std::hypot(toward[0], toward[1]))));
    attributes.Number("angularDiameter", vtkReliefScene::GetAngularDiameter(light));
  }
  attributes.Triple("color", light->GetDiffuseColor());
  attributes.Number("intensity", light->GetIntensity());
}

//------------------------------------------------------------------------------
void AddLights(vtkReliefScene* scene, Imf::Header& header)
{
  // A scene without any light is lit by this sun.
  vtkNew<vtkReliefScene> unlit;
  vtkLightCollection* lights = scene->GetLights();
  if (lights->GetNumberOfItems() == 0 && !scene->GetEnvironment())
  {
    unlit->AddSun(315.0, 45.0);
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
  static const char* const samplings[] = { "Uniform", "SolidAngle", "Importance" };
  attributes.Text("sampling", samplings[environment->GetSampling()]);
  attributes.Count("numberOfSamples", environment->GetNumberOfSamples());
  attributes.Number("rotationZ", environment->GetRotationZ());
  attributes.Number("tilt", environment->GetTilt());
  attributes.Number("intensity", environment->GetIntensity());
  attributes.Number("radius", environment->GetRadius());
}

//------------------------------------------------------------------------------
void AddMaterial(vtkReliefMaterial* material, double depth, Attributes attributes)
{
  const bool exponential = material->GetAttenuation() == vtkReliefMaterial::Exponential;
  const bool vertical = material->GetOffsetMode() == vtkReliefMaterial::Vertical;
  attributes.Triple("baseColor", material->GetBaseColor());
  attributes.Triple("diffuseColor", material->GetDiffuseColor());
  attributes.Triple("specularColor", material->GetSpecularColor());
  attributes.Number("specularCoefficient", material->GetSpecularCoefficient());
  attributes.Pair("specularRange", material->GetSpecularRange());
  attributes.Number("specularPower", material->GetSpecularPower());
  attributes.Number("forwardScatterCoefficient", material->GetForwardScatterCoefficient());
  attributes.Pair("forwardScatterRange", material->GetForwardScatterRange());
  attributes.Number("forwardScatterPower", material->GetForwardScatterPower());
  attributes.Number("subsurfaceDepth", depth);
  attributes.Text("offsetMode", vertical ? "Vertical" : "SurfaceNormal");
  attributes.Text("attenuation", exponential ? "Exponential" : "Reciprocal");
  if (exponential)
  {
    attributes.Number("density", material->GetDensity());
  }
  if (material->GetUseFloor())
  {
    attributes.Number("floorHeight", material->GetFloorHeight());
  }
}
}

//------------------------------------------------------------------------------
std::string AddMetadata(vtkImageData* image, vtkReliefScene* scene, Imf::Header& header)
{
  vtkReliefImageFrame frame;
  const std::string wrong = frame.Assign(image);
  if (!wrong.empty())
  {
    return wrong;
  }
  header.pixelAspectRatio() = static_cast<float>(frame.Spacing[0] / frame.Spacing[1]);
  header.insert("Software", Imf::StringAttribute("ReliefShading " RELIEFSHADING_VERSION));
  Attributes attributes(header, "relief:");
  attributes.Place("origin", image->GetPoint(0));
  attributes.Place("spacing", image->GetSpacing());
  if (!scene)
  {
    return std::string();
  }
  const bool exact = scene->GetIntegrator() == vtkReliefScene::Exact;
  attributes.Number("heightScale", scene->GetHeightScale());
  attributes.Text("integrator", exact ? "Exact" : "FixedStep");
  if (exact)
  {
    attributes.Number("tolerance", scene->GetTolerance());
  }
  else
  {
    attributes.Count("numberOfSteps", scene->GetNumberOfSteps());
  }
  AddLights(scene, header);
  if (scene->GetEnvironment())
  {
    AddEnvironment(scene->GetEnvironment(), Attributes(header, "relief:environment:"));
  }
  const double depth = vtkReliefConvertMaterial(scene, frame, 0.0).medium.depth;
  AddMaterial(scene->GetMaterial(), depth, attributes);
  return std::string();
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefConversion.h"

#include "vtkCollectionRange.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include "LightSampling.h"

#include <algorithm>
#include <cmath>
#include <sstream>

static_assert(
  static_cast<int>(vtkReliefMaterial::SurfaceNormal) == relief::f64::RELIEF_SURFACE_NORMAL);
static_assert(static_cast<int>(vtkReliefMaterial::Exponential) == relief::f64::RELIEF_EXPONENTIAL);

namespace
{
// The model's single precision needs room for squares and products. What is beyond counts as the
// limit, which looks the same: Documentation/Conventions.md.
constexpr double LargestLength = 1e32;
constexpr double LargestColor = 1e6;
constexpr double LargestRadiance = 1e30;
constexpr double LargestNumber = 1e30;
constexpr double LargestHeight = 4e37; // beyond any relief that is not refused

double Bounded(double value, double largest)
{
  return std::clamp(value, -largest, largest);
}

relief::f64::ReliefFalloff Falloff(const double range[2], double power)
{
  return { Bounded(range[0], LargestNumber), Bounded(range[1], LargestNumber),
    Bounded(power, LargestNumber) };
}

// A lamp farther away stands in the same direction, and light that is stronger is as white.
void Bound(relief::Light& light)
{
  const double length = std::hypot(light.vector.x, light.vector.y, light.vector.z);
  if (light.positional && length > LargestLength)
  {
    light.vector *= LargestLength / length;
  }
  const double brightest =
    std::max({ std::abs(light.color.x), std::abs(light.color.y), std::abs(light.color.z) }) *
    std::abs(light.weight);
  if (std::abs(light.intensity) * brightest > LargestRadiance)
  {
    light.intensity = std::copysign(LargestRadiance / brightest, light.intensity);
  }
}
}

//------------------------------------------------------------------------------
std::string vtkReliefImageFrame::Assign(vtkImageData* image)
{
  const int* extent = image->GetExtent();
  const double* spacing = image->GetSpacing();
  std::copy_n(image->GetOrigin(), 3, this->Origin);
  std::copy_n(image->GetDirectionMatrix()->GetData(), 9, this->Direction);
  std::ostringstream message;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double size = std::abs(spacing[axis]);
    if (!(size >= 1.0 / LargestLength && size <= LargestLength))
    {
      message << "the spacing is (" << spacing[0] << ", " << spacing[1]
              << "), numbers from 1e-32 to 1e32, or these negative, are expected";
      return message.str();
    }
    this->Spacing[axis] = std::abs(spacing[axis]);
    this->Sign[axis] = spacing[axis] < 0.0 ? -1.0 : 1.0;
    this->First[axis] = extent[2 * axis] * this->Spacing[axis];
  }
  vtkMatrix3x3::Invert(this->Direction, this->Inverse);
  // The volume that the three directions span: beside that of a box of the same lengths it tells
  // how near to a plane they lie, where their inverse has no digits left.
  double box = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* m = this->Direction;
    box *= std::hypot(m[axis], m[3 + axis], m[6 + axis]);
  }
  const double volume = std::abs(vtkMatrix3x3::Determinant(this->Direction));
  if (!std::isfinite(this->Origin[0] + this->Origin[1] + this->Origin[2]) ||
    !(volume >= 1e-12 * box && box >= 1e-15 && box <= 1e15))
  {
    return "origin and direction matrix must be finite, and the matrix regular";
  }
  return std::string();
}

//------------------------------------------------------------------------------
glm::dvec3 vtkReliefImageFrame::VectorFromWorld(const double world[3]) const
{
  double local[3];
  vtkMatrix3x3::MultiplyPoint(this->Inverse, world, local);
  return { local[0] * this->Sign[0], local[1] * this->Sign[1], local[2] };
}

//------------------------------------------------------------------------------
glm::dvec3 vtkReliefImageFrame::PointFromWorld(const double world[3]) const
{
  const double fromOrigin[3] = { world[0] - this->Origin[0], world[1] - this->Origin[1],
    world[2] - this->Origin[2] };
  return this->VectorFromWorld(fromOrigin) - glm::dvec3(this->First[0], this->First[1], 0.0);
}

//------------------------------------------------------------------------------
bool vtkReliefImageFrame::IsWorld() const
{
  static const double identity[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  return this->Sign[0] > 0.0 && this->Sign[1] > 0.0 &&
    std::equal(identity, identity + 9, this->Direction);
}

//------------------------------------------------------------------------------
void vtkReliefImageFrame::NormalToWorld(float* n) const
{
  const double local[3] = { n[0] * this->Sign[0], n[1] * this->Sign[1], n[2] };
  double world[3];
  vtkMatrix3x3::MultiplyPoint(this->Direction, local, world);
  std::copy_n(world, 3, n);
}

//------------------------------------------------------------------------------
std::string vtkReliefCheckImage(vtkImageData* image, vtkDataArray* scalars, const char* what)
{
  std::ostringstream message;
  const int* extent = image->GetExtent();
  if (image->GetNumberOfPoints() < 1)
  {
    message << "the " << what << " image is empty";
  }
  else if (extent[4] != extent[5])
  {
    message << "the " << what << " image has " << extent[5] - extent[4] + 1
            << " slices, 1 is expected";
  }
  else if (!scalars)
  {
    message << "the " << what << " image has no scalars";
  }
  else if (scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    message << "the " << what << " array has " << scalars->GetNumberOfTuples() << " values, "
            << image->GetNumberOfPoints() << " are expected";
  }
  else if (scalars->GetDataType() == VTK_BIT)
  {
    message << "the " << what << " scalars are bits, a numeric type is expected";
  }
  return message.str();
}

//------------------------------------------------------------------------------
std::string vtkReliefCheckInput(vtkImageData* image, vtkDataArray* scalars, const char* what)
{
  std::string wrong = vtkReliefCheckImage(image, scalars, what);
  if (wrong.empty() && scalars->GetNumberOfComponents() != 1)
  {
    std::ostringstream message;
    message << "the " << what << " image has " << scalars->GetNumberOfComponents()
            << " components, 1 is expected";
    wrong = message.str();
  }
  return wrong;
}

//------------------------------------------------------------------------------
std::string vtkReliefConvertColors(
  vtkImageData* image, vtkDataArray* scalars, const char* what, relief::ColorTexture& result)
{
  const std::string wrong = vtkReliefCheckImage(image, scalars, what);
  if (!wrong.empty())
  {
    return wrong;
  }
  std::ostringstream message;
  switch (scalars->GetDataType())
  {
    case VTK_UNSIGNED_CHAR:
      result.type = relief::ColorTexture::Type::Byte;
      break;
    case VTK_UNSIGNED_SHORT:
      result.type = relief::ColorTexture::Type::Short;
      break;
    case VTK_FLOAT:
      result.type = relief::ColorTexture::Type::Float;
      break;
    case VTK_DOUBLE:
      result.type = relief::ColorTexture::Type::Double;
      break;
    default:
      message << "the " << what << " scalars are of type " << scalars->GetDataTypeAsString()
              << "; unsigned char or unsigned short (sRGB), float or double (linear) is expected";
      return message.str();
  }
  result.components = scalars->GetNumberOfComponents();
  if (result.components < 1 || result.components > 4)
  {
    message << "the " << what << " image has " << result.components
            << " components, 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGB, alpha) are expected";
    return message.str();
  }
  result.texels = scalars->GetVoidPointer(0);
  result.columns = image->GetDimensions()[0];
  result.rows = image->GetDimensions()[1];
  return std::string();
}

//------------------------------------------------------------------------------
std::string vtkReliefConvertLight(
  vtkLight* light, const vtkReliefImageFrame& frame, double datum, relief::Light& result)
{
  double position[3];
  double focal[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focal);
  result.color = glm::dvec3(
    light->GetDiffuseColor()[0], light->GetDiffuseColor()[1], light->GetDiffuseColor()[2]);
  result.intensity = light->GetIntensity();
  result.positional = light->GetPositional() != 0;
  if (!std::isfinite(result.intensity) ||
    !std::isfinite(result.color.x + result.color.y + result.color.z))
  {
    return "its intensity and colour must be finite";
  }
  if (!std::isfinite(position[0] + position[1] + position[2]))
  {
    return "its position must be finite";
  }
  if (result.positional)
  {
    result.vector = frame.PointFromWorld(position) - glm::dvec3(0.0, 0.0, datum);
    return std::isfinite(std::hypot(result.vector.x, result.vector.y, result.vector.z))
      ? std::string()
      : "its position must be finite";
  }
  const double toward[3] = { position[0] - focal[0], position[1] - focal[1],
    position[2] - focal[2] };
  glm::dvec3 v = frame.VectorFromWorld(toward);
  const double length = std::hypot(v.x, v.y, v.z);
  if (!std::isfinite(length) || length == 0.0)
  {
    return "its position and focal point must be finite and differ";
  }
  result.vector = v / length;
  return std::string();
}

//------------------------------------------------------------------------------
std::string vtkReliefConvertLights(vtkReliefScene* scene, vtkLightCollection* otherwise,
  const vtkReliefImageFrame& frame, const relief::HeightField& field,
  std::vector<relief::Light>& result)
{
  result.clear();
  vtkReliefEnvironment* environment = scene->GetEnvironment();
  vtkNew<vtkReliefScene> unlit;
  vtkLightCollection* lights = scene->GetLights();
  if (lights->GetNumberOfItems() == 0 && !environment)
  {
    lights = otherwise;
    if (!lights)
    {
      unlit->AddSun(315.0, 45.0);
      lights = unlit->GetLights();
    }
  }
  int lightIndex = 0;
  for (vtkLight* light : vtk::Range(lights))
  {
    if (light->GetSwitch())
    {
      relief::Light converted;
      const std::string wrong = vtkReliefConvertLight(light, frame, field.GetDatum(), converted);
      if (!wrong.empty())
      {
        return "light " + std::to_string(lightIndex) + ": " + wrong;
      }
      const double diameter =
        converted.positional ? 0.0 : vtkReliefScene::GetAngularDiameter(light);
      const std::vector<relief::Light> disc = relief::SampleDisc(
        converted, vtkMath::RadiansFromDegrees(diameter), scene->GetNumberOfSunSamples());
      result.insert(result.end(), disc.begin(), disc.end());
    }
    ++lightIndex;
  }

  if (environment)
  {
    std::vector<relief::Light> samples;
    const std::string wrong = vtkReliefEnvironmentSampler::Sample(environment, frame, samples);
    if (!wrong.empty())
    {
      return wrong;
    }
    if (std::isfinite(environment->GetRadius()))
    {
      const relief::HeightView<float>& heights = field.GetField().heights;
      const glm::dvec3 center(0.5 * (heights.columns - 1) * heights.spacingX,
        0.5 * (heights.rows - 1) * heights.spacingY,
        field.HasData() ? 0.5 * (static_cast<double>(field.GetBottom()) + field.GetTop()) : 0.0);
      relief::PlaceOnSphere(samples, center, environment->GetRadius());
    }
    result.insert(result.end(), samples.begin(), samples.end());
  }
  std::for_each(result.begin(), result.end(), Bound);
  return std::string();
}

//------------------------------------------------------------------------------
relief::Scene vtkReliefConvertMaterial(
  vtkReliefScene* scene, const vtkReliefImageFrame& frame, double datum)
{
  vtkReliefMaterial* material = scene->GetMaterial();
  auto color = [](const double c[3])
  {
    return glm::dvec3(
      std::min(c[0], LargestColor), std::min(c[1], LargestColor), std::min(c[2], LargestColor));
  };
  relief::Scene result;
  result.base = color(material->GetBaseColor());
  result.diffuse = color(material->GetDiffuseColor());
  result.specular = color(material->GetSpecularColor());
  result.specularCoefficient = material->GetSpecularCoefficient();
  result.scatterCoefficient = material->GetForwardScatterCoefficient();
  result.specularFalloff = Falloff(material->GetSpecularRange(), material->GetSpecularPower());
  result.scatterFalloff =
    Falloff(material->GetForwardScatterRange(), material->GetForwardScatterPower());
  result.medium.depth = material->GetAutomaticSubsurfaceDepth()
    ? (frame.Spacing[0] + frame.Spacing[1]) / 2.0
    : std::min(material->GetSubsurfaceDepth(), LargestLength);
  result.medium.offset = material->GetOffsetMode();
  result.medium.attenuation = material->GetAttenuation();
  result.medium.density = std::min(material->GetDensity(), LargestNumber);
  result.medium.useFloor = material->GetUseFloor();
  result.medium.floorHeight = Bounded(material->GetFloorHeight() - datum, LargestHeight);
  result.medium.tolerance = std::min(scene->GetTolerance(), 1.0); // of d, which is no more
  result.integrator = scene->GetIntegrator() == vtkReliefScene::Exact
    ? relief::Integrator::Exact
    : relief::Integrator::FixedStep;
  result.steps = scene->GetNumberOfSteps();
  return result;
}

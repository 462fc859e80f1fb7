// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentLights.h"

#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkReliefEnvironment.h"

#include "EnvironmentMap.h"

#include <new>

static_assert(static_cast<int>(vtkReliefEnvironment::Uniform) ==
  static_cast<int>(relief::EnvironmentSampling::Uniform));
static_assert(static_cast<int>(vtkReliefEnvironment::SolidAngle) ==
  static_cast<int>(relief::EnvironmentSampling::SolidAngle));
static_assert(static_cast<int>(vtkReliefEnvironment::Importance) ==
  static_cast<int>(relief::EnvironmentSampling::Importance));

namespace relief::hosts
{
//------------------------------------------------------------------------------
std::string EnvironmentLights::Sample(
  vtkReliefEnvironment* environment, const ImageFrame& frame, std::vector<Light>& result)
{
  result.clear();
  vtkImageData* image = environment->GetImage();
  if (!image)
  {
    this->Release();
    return std::string();
  }
  ColorTexture colors;
  const std::string wrong =
    ConvertColors(image, image->GetPointData()->GetScalars(), "environment", colors);
  if (!wrong.empty())
  {
    return wrong;
  }

  // From the image through the world to the relief's frame, one axis a column.
  const glm::dmat3 axes = TurnOf(environment->GetRotationZ(), environment->GetTilt());
  const glm::dmat3 toField(frame.VectorFromWorld(&axes[0].x), frame.VectorFromWorld(&axes[1].x),
    frame.VectorFromWorld(&axes[2].x));

  const vtkMTimeType time = image->GetMTime();
  try
  {
    if (this->MapTime != time)
    {
      // The zenith is the picture's top row, the image's last.
      this->Map = MapOf(colors, false);
      this->MapTime = time;
      if (this->Map.GetCleaned() > 0)
      {
        vtkWarningWithObjectMacro(environment,
          "The image has " << this->Map.GetCleaned()
                           << " texels that are not finite, negative or above "
                           << RadianceMap::Largest
                           << "; a negative component counts as 0, the others as black texels.");
      }
    }
    const auto madeFrom =
      std::make_tuple(time, environment->GetSampling(), environment->GetNumberOfSamples(), toField);
    if (this->LightsMadeFrom != madeFrom)
    {
      this->Lights =
        SampleEnvironment(this->Map, static_cast<EnvironmentSampling>(environment->GetSampling()),
          environment->GetNumberOfSamples(), toField);
      this->LightsMadeFrom = madeFrom;
    }
    result = this->Lights;
  }
  catch (const std::bad_alloc&)
  {
    return "there is not enough memory for the environment's lights";
  }
  for (Light& light : result)
  {
    light.intensity = environment->GetIntensity();
  }
  return std::string();
}

//------------------------------------------------------------------------------
void EnvironmentLights::Release()
{
  *this = EnvironmentLights();
}
}

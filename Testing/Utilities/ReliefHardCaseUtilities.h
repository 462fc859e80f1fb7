// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefHardCaseUtilities_h
#define ReliefHardCaseUtilities_h

/// @file
/// The model's catalogue of hard cases (Testing/Model/HardCases.h) as images and scenes of VTK.

#include "ReliefTestUtilities.h"

#include "vtkLight.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include "HardCases.h"
#include "HardSceneChecks.h"

inline vtkSmartPointer<vtkImageData> ImageOf(const Terrain& terrain)
{
  auto image = MakeHeights<vtkDoubleArray>(
    terrain.columns, terrain.rows, [&](int i, int j) { return terrain.At(i, j); });
  image->SetSpacing(terrain.spacingX, terrain.spacingY, 1.0);
  return image;
}

/// Gives a scene one of a hard scene's lights, and its material.
inline void Assign(const HardScene& hard, std::size_t index, vtkReliefScene* scene)
{
  const relief::Light& light = hard.lights[index];
  vtkNew<vtkLight> converted;
  converted->SetLightTypeToSceneLight();
  converted->SetPositional(light.positional);
  converted->SetPosition(light.vector.x, light.vector.y, light.vector.z);
  converted->SetFocalPoint(0.0, 0.0, 0.0);
  scene->RemoveAllLights();
  scene->AddLight(converted);
  scene->SetTolerance(0.0);
  vtkReliefMaterial* material = scene->GetMaterial();
  material->SetSubsurfaceDepth(hard.medium.depth);
  material->SetOffsetMode(hard.medium.offset);
  material->SetAttenuation(hard.medium.attenuation);
  material->SetDensity(hard.medium.density);
  material->SetUseFloor(hard.medium.useFloor);
  material->SetFloorHeight(hard.medium.floorHeight);
}

/// Calls body(name, hard scene, index of a light) for every light of every row that is not refused.
template <class Body>
void ForEachHardLight(Body&& body)
{
  for (const HardCase& test : HardCases())
  {
    for (std::size_t k = 0; !test.refused && k < test.scene.lights.size(); ++k)
    {
      body(test.name, test.scene, k);
    }
  }
}

/// Counts the samples of which a red component is not d of heights within rounding, or not a number
/// just where there is data; says which.
inline int CountWrong(const char* what, const char* name, const HardScene& scene, std::size_t light,
  vtkImageData* image, const char* array)
{
  int wrong = 0;
  for (int j = 0; j < scene.terrain.rows; ++j)
  {
    for (int i = 0; i < scene.terrain.columns; ++i)
    {
      const double d = Value(image, array, i, j);
      const bool hasData = std::isfinite(scene.terrain.At(i, j));
      const bool right = hasData ? IsExplained(scene, scene.lights[light], i, j, d, Method::Scene)
                                 : (array ? std::isnan(d) : d == 0.0);
      if (!right)
      {
        ++wrong;
        std::cout << what << ", " << name << ", light " << light << ", sample " << i << ' ' << j
                  << ": d = " << d << std::endl;
      }
    }
  }
  return wrong;
}

#endif

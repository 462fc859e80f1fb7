// SPDX-License-Identifier: BSD-3-Clause
#ifndef FilterRun_h
#define FilterRun_h

#include "BenchmarkTerrain.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkImageReliefShading.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkReliefScene.h>
#include <vtkSMPTools.h>

#include <string>
#include <utility>
#include <vector>

namespace bench
{

/// Suns all over the sky, between 10 and 80 degrees high: azimuth and altitude.
inline std::vector<std::pair<double, double>> Suns(int count)
{
  std::vector<std::pair<double, double>> suns;
  for (int k = 0; k < count; ++k)
  {
    suns.emplace_back(360.0 * k / count + 7.0, 10.0 + 10.0 * (k * 5 % 8));
  }
  return suns;
}

/// The whole filter, heights to colour: padded copy, bounds, rays and colours, 8 bits of each
/// unless changed, at the default tolerance and with t = one sample's spacing.
class FilterRun
{
public:
  FilterRun(const Relief& relief, const std::vector<std::pair<double, double>>& suns)
  {
    ThreadedBackend(); // is asked for before the first change
    this->Image->SetDimensions(relief.columns, relief.rows, 1);
    this->Image->SetSpacing(relief.spacing, relief.spacing, 1.0);
    vtkNew<vtkFloatArray> heights;
    heights->SetArray(
      const_cast<float*>(relief.heights.data()), static_cast<vtkIdType>(relief.heights.size()), 1);
    this->Image->GetPointData()->SetScalars(heights);
    this->Shading->SetInputData(this->Image);
    this->Shading->SetOutputScalarTypeToUnsignedChar();
    for (const auto& [azimuth, altitude] : suns)
    {
      this->Shading->GetScene()->AddSun(azimuth, altitude);
    }
  }

  ///@{
  /// What is run, to be changed.
  vtkImageReliefShading* GetFilter() { return this->Shading; }
  vtkReliefScene* GetScene() { return this->Shading->GetScene(); }
  ///@}

  /// How VTK runs several threads: as it is configured to.
  static const std::string& ThreadedBackend()
  {
    static const std::string backend = []
    {
      const std::string preset = vtkSMPTools::GetBackend();
      return preset == "Sequential" ? std::string("STDThread") : preset;
    }();
    return backend;
  }

  /// Computes everything anew.
  void Run(int threads)
  {
    this->Image->Modified();
    this->Update(threads);
  }

  /// The first light moves a little, and nothing else has changed.
  void RunMoved(int threads)
  {
    auto* light = vtkLight::SafeDownCast(this->GetScene()->GetLights()->GetItemAsObject(0));
    double* position = light->GetPosition();
    light->SetPosition(position[0] + this->Move, position[1], position[2]);
    this->Move = -this->Move;
    this->Update(threads);
  }

private:
  void Update(int threads)
  {
    // The sequential backend stays on this thread, whose time then is all the time.
    vtkSMPTools::SetBackend(threads > 1 ? ThreadedBackend().c_str() : "Sequential");
    vtkSMPTools::Initialize(threads);
    this->Shading->Update();
  }

  vtkNew<vtkImageData> Image;
  vtkNew<vtkImageReliefShading> Shading;
  double Move = 1.0e-9;
};

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
//
// Random sequences of what programs do to a mapper: whatever has happened before, a still frame
// shows the filter's picture. RELIEF_SEED repeats a run, RELIEF_SEQUENCES makes it longer.

#include "ReliefMapperTestUtilities.h"

#include "vtkGenericRenderWindowInteractor.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"

#include <cstdlib>
#include <limits>
#include <random>

namespace
{

int Failures = 0;

int FromEnvironment(const char* name, int otherwise)
{
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

class Player
{
public:
  explicit Player(unsigned int seed)
    : Random(seed)
  {
  }

  void Play(int sequences)
  {
    for (int k = 0; k < sequences; ++k)
    {
      const int steps = this->Below(8) + 2;
      for (int step = 0; step < steps; ++step)
      {
        this->Step();
      }
      this->Verify();
      if (Failures > 0)
      {
        std::cout << "in sequence " << k << std::endl;
        return;
      }
    }
  }

private:
  int Below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(this->Random); }
  double Share() { return std::uniform_real_distribution<double>(0.0, 1.0)(this->Random); }

  vtkSmartPointer<vtkImageData> Heights()
  {
    const unsigned int seed = this->Random();
    const bool holes = this->Below(3) == 0;
    return MakeHeights(20 + this->Below(60), 20 + this->Below(50),
      [=](int i, int j)
      {
        return holes && (i * 5 + j * 3) % 37 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                                  : Hills(seed)(i, j);
      });
  }

  void Step()
  {
    vtkReliefScene* scene = this->Stage.Scene();
    vtkReliefMaterial* material = scene->GetMaterial();
    vtkLightCollection* lights = scene->GetLights();
    switch (this->Below(20))
    {
      case 0:
        scene->AddSun(360.0 * this->Share(), 20.0 + 60.0 * this->Share())->SetIntensity(0.5);
        break;
      case 1:
      {
        vtkNew<vtkLight> lamp;
        lamp->PositionalOn();
        lamp->SetPosition(80.0 * this->Share(), 60.0 * this->Share(), 60.0 + 40.0 * this->Share());
        scene->AddLight(lamp);
        break;
      }
      case 2:
        if (lights->GetNumberOfItems() > 0)
        {
          auto* light = vtkLight::SafeDownCast(
            lights->GetItemAsObject(this->Below(lights->GetNumberOfItems())));
          light->SetPosition(80.0 * this->Share(), 60.0 * this->Share(), 70.0);
        }
        break;
      case 3:
        scene->RemoveAllLights();
        scene->SetEnvironment(nullptr);
        break;
      case 4:
        scene->SetLightsToSkyDome();
        scene->GetEnvironment()->SetNumberOfSamples(6 + this->Below(20));
        break;
      case 5:
        material->SetDiffuseColor(this->Share(), this->Share(), this->Share());
        break;
      case 6:
        material->SetSpecularCoefficient(this->Below(2) ? 0.5 * this->Share() : 0.0);
        break;
      case 7:
        material->SetForwardScatterCoefficient(this->Below(2) ? this->Share() : 0.0);
        break;
      case 8:
        material->SetSubsurfaceDepth(0.5 + 5.0 * this->Share());
        break;
      case 9:
        material->SetOffsetMode(this->Below(2));
        break;
      case 10:
        material->SetUseFloor(this->Below(2) != 0);
        break;
      case 11:
        this->Stage.mapper->SetInputData(this->Heights());
        break;
      case 12:
        this->Stage.window->SetSize(40 + this->Below(150), 40 + this->Below(120));
        break;
      case 13:
        this->Stage.mapper->ReleaseGraphicsResources(this->Stage.window);
        break;
      case 14:
        this->Stage.window->Finalize();
        break;
      case 15:
        this->Stage.mapper->SetCacheMemoryLimit(this->Below(3) * 20);
        break;
      case 16:
        this->Stage.renderer->GetActiveCamera()->SetParallelScale(3.0 + 100.0 * this->Share());
        break;
      case 17:
        this->Stage.renderer->GetActiveCamera()->Azimuth(40.0 * (this->Share() - 0.5));
        break;
      case 18:
        this->Stage.window->SetDesiredUpdateRate(10000.0);
        break;
      default:
        this->Stage.mapper->SetTextureSizeLimit(this->Below(2) * 64);
        break;
    }
    if (this->Below(3) == 0)
    {
      CHECK(this->Stage.Render());
    }
  }

  // One texel for each sample, as the filter has it.
  void Verify()
  {
    vtkImageData* heights = this->Stage.mapper->GetInput();
    this->Stage.window->SetDesiredUpdateRate(0.0001);
    this->Stage.mapper->SetTextureSizeLimit(0);
    this->Stage.window->SetSize(heights->GetDimensions()[0], heights->GetDimensions()[1]);
    this->Stage.LookAtAll();
    CHECK(this->Stage.Render());
    CHECK(this->Stage.mapper->GetConverged());
    vtkNew<vtkImageReliefShading> filter;
    filter->SetInputData(heights);
    filter->SetScene(this->Stage.Scene());
    filter->Update();
    const Agreement agreement = CompareColors(filter->GetOutput(), this->Stage.Shading(), 2.0e-2);
    CHECK(agreement.shareBeyond <= 5.0e-3);
  }

  std::mt19937 Random;
  MapperStage Stage{ MakeHeights(60, 40, Hills(1)) };
};

}

int TestReliefImageMapperSequences(int, char*[])
{
  const int seed =
    FromEnvironment("RELIEF_SEED", static_cast<int>(std::random_device()() & 0x7fffffff));
  std::cout << "RELIEF_SEED=" << seed << std::endl;
  Player player(static_cast<unsigned int>(seed));
  player.Play(FromEnvironment("RELIEF_SEQUENCES", 40));
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

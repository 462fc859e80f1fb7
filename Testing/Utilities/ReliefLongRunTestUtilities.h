// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefLongRunTestUtilities_h
#define ReliefLongRunTestUtilities_h

#include "ReliefTestUtilities.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <limits>
#include <random>

#if defined(__linux__)
#include <malloc.h>
#include <unistd.h>
#endif

/// A number from the environment, by which a test is repeated or made longer.
inline int FromEnvironment(const char* name, int otherwise)
{
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

/// RELIEF_SEED, or a new seed; printed.
inline unsigned int ChooseSeed()
{
  const int seed =
    FromEnvironment("RELIEF_SEED", static_cast<int>(std::random_device()() & 0x7fffffff));
  std::cout << "RELIEF_SEED=" << seed << std::endl;
  return static_cast<unsigned int>(seed);
}

/// Random changes of what is shaded, the same for the same seed.
class RandomChanges
{
public:
  explicit RandomChanges(unsigned int seed)
    : Random(seed)
  {
  }

  int Below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(this->Random); }
  double Share() { return std::uniform_real_distribution<double>(0.0, 1.0)(this->Random); }

  /// Hills of any size up to some, one in three with holes.
  vtkSmartPointer<vtkImageData> Heights(int columns = 80, int rows = 70)
  {
    const unsigned int seed = this->Random();
    const bool holes = this->Below(3) == 0;
    return MakeHeights(columns / 4 + this->Below(3 * columns / 4),
      rows / 4 + this->Below(3 * rows / 4),
      [=](int i, int j)
      {
        return holes && (i * 5 + j * 3) % 37 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                                  : Hills(seed)(i, j);
      });
  }

  /// A picture for a texture, or none.
  vtkSmartPointer<vtkImageData> Picture()
  {
    if (this->Below(2) == 0)
    {
      return nullptr;
    }
    auto picture = vtkSmartPointer<vtkImageData>::New();
    picture->SetDimensions(2 + this->Below(30), 2 + this->Below(30), 1);
    picture->AllocateScalars(VTK_UNSIGNED_CHAR, 3 + this->Below(2));
    vtkDataArray* values = picture->GetPointData()->GetScalars();
    auto* bytes = static_cast<unsigned char*>(values->GetVoidPointer(0));
    std::generate_n(bytes, values->GetNumberOfValues(),
      [this]() { return static_cast<unsigned char>(this->Random()); });
    return picture;
  }

  /// One change of a scene.
  void ChangeScene(vtkReliefScene* scene)
  {
    vtkReliefMaterial* material = scene->GetMaterial();
    vtkLightCollection* lights = scene->GetLights();
    switch (this->Below(16))
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
        if (lights->GetNumberOfItems() > 2)
        {
          scene->RemoveLight(vtkLight::SafeDownCast(lights->GetItemAsObject(0)));
        }
        break;
      case 5:
        scene->SetLightsToSkyDome();
        scene->GetEnvironment()->SetNumberOfSamples(6 + this->Below(20));
        break;
      case 6:
        if (scene->GetEnvironment())
        {
          scene->GetEnvironment()->SetRotationZ(360.0 * this->Share());
        }
        break;
      case 7:
        material->SetDiffuseColor(this->Share(), this->Share(), this->Share());
        break;
      case 8:
        material->SetSpecularCoefficient(this->Below(2) ? 0.5 * this->Share() : 0.0);
        break;
      case 9:
        material->SetForwardScatterCoefficient(this->Below(2) ? this->Share() : 0.0);
        break;
      case 10:
        material->SetSubsurfaceDepth(0.5 + 5.0 * this->Share());
        break;
      case 11:
        material->SetOffsetMode(this->Below(3));
        break;
      case 12:
        material->SetUseFloor(this->Below(2) != 0);
        break;
      case 13:
        material->SetAttenuation(this->Below(2));
        break;
      case 14:
        scene->SetHeightScale(0.5 + this->Share());
        break;
      default:
        scene->SetIntegrator(
          this->Below(3) == 0 ? vtkReliefScene::FixedStep : vtkReliefScene::Exact);
        break;
    }
  }

private:
  std::mt19937 Random;
};

/// The memory of this process, noted again and again when it is in the same state.
///
/// On Linux with glibc: what is allocated, to the byte, and what the system has given. Elsewhere,
/// and under sanitizers, both are 0, and nothing grows.
class Footprint
{
public:
  void Note(int updates)
  {
    const Bytes now = Measure();
    std::cout << std::fixed << std::setprecision(0) << updates << " updates: " << now.allocated
              << " bytes allocated, " << now.resident << " resident" << std::defaultfloat
              << std::endl;
    if (this->Notes++ == 0)
    {
      this->First = this->Last = now;
    }
    this->Step = std::max(this->Step, now.allocated - this->Last.allocated);
    this->Last = now;
  }

  ///@{
  /// Growth from the first note to the last, in bytes. What is allocated between two of many notes
  /// and never again is not counted: Mesa 26 does so with 1 MB, and what leaks grows between all of
  /// them.
  double Allocated() const
  {
    return this->Last.allocated - this->First.allocated - (this->Notes < 8 ? 0.0 : this->Step);
  }
  double Resident() const { return this->Last.resident - this->First.resident; }
  ///@}

private:
  struct Bytes
  {
    double allocated = 0.0;
    double resident = 0.0;
  };

  static Bytes Measure()
  {
    Bytes bytes;
    if (IsMemorySanitized)
    {
      return bytes;
    }
#if defined(__linux__)
    std::ifstream pages("/proc/self/statm");
    double all = 0.0;
    pages >> all >> bytes.resident;
    bytes.resident *= static_cast<double>(sysconf(_SC_PAGESIZE));
#endif
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
    const struct mallinfo2 info = mallinfo2();
    bytes.allocated = static_cast<double>(info.uordblks + info.hblkhd);
#endif
    return bytes;
  }

  Bytes First;
  Bytes Last;
  double Step = 0.0; // the largest
  int Notes = 0;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
//
// Ten thousand updates of the filter with changing scenes, heights, textures and settings leave no
// memory behind. RELIEF_SEED repeats a run, RELIEF_UPDATES makes it longer. What glibc keeps at
// hand for each thread would count as left behind: CTest sets
// GLIBC_TUNABLES=glibc.malloc.tcache_count=0.

#include "ReliefLongRunTestUtilities.h"

#include "vtkColorTransferFunction.h"

namespace
{

int Failures = 0;

class Shading
{
public:
  explicit Shading(unsigned int seed)
    : Changes(seed)
  {
    this->Table->AddRGBPoint(0.0, 0.1, 0.5, 0.2);
    this->Table->AddRGBPoint(60.0, 0.9, 0.8, 0.6);
  }

  // Changes something and shades.
  void Step()
  {
    vtkImageReliefShading* filter = this->Filter;
    switch (this->Changes.Below(12))
    {
      case 0:
      case 1:
        filter->SetInputData(this->Changes.Heights(60, 50));
        filter->SetMaskData(nullptr);
        break;
      case 2:
        filter->SetDiffuseTextureData(this->Changes.Picture());
        filter->StretchTexturesOn();
        break;
      case 3:
        filter->SetBaseTextureData(this->Changes.Picture());
        filter->SetSpecularTextureData(this->Changes.Picture());
        filter->StretchTexturesOn();
        break;
      case 4:
        filter->SetLookupTable(this->Changes.Below(2) ? this->Table.Get() : nullptr);
        break;
      case 5:
        filter->SetOutputScalarType(this->Changes.Below(2) ? VTK_FLOAT : VTK_UNSIGNED_CHAR);
        break;
      case 6:
        filter->SetGenerateIllumination(this->Changes.Below(2));
        filter->SetGenerateThickness(this->Changes.Below(2));
        filter->SetGenerateNormals(this->Changes.Below(2));
        filter->SetGenerateSpecular(this->Changes.Below(2));
        break;
      case 7:
        filter->SetCacheMemoryLimit(this->Changes.Below(3) * 20);
        break;
      case 8:
      {
        const int* size = vtkImageData::SafeDownCast(filter->GetInput())->GetDimensions();
        filter->SetMaskData(MakeHeights<vtkUnsignedCharArray>(
          size[0], size[1], [](int i, int j) { return (i / 3 + j / 4) % 5 == 0 ? 0.0 : 1.0; }));
        break;
      }
      default:
        this->Changes.ChangeScene(filter->GetScene());
        break;
    }
    filter->Update();
    CHECK(filter->GetOutput()->GetNumberOfPoints() > 0);
  }

  // The same state and picture, whatever has been before.
  void Rest()
  {
    vtkImageReliefShading* filter = this->Filter;
    filter->SetScene(vtkNew<vtkReliefScene>());
    filter->SetInputData(this->Heights);
    for (int port = 1; port < 5; ++port)
    {
      filter->SetInputData(port, nullptr);
    }
    filter->SetLookupTable(nullptr);
    filter->SetOutputScalarTypeToFloat();
    filter->GenerateIlluminationOff();
    filter->GenerateThicknessOff();
    filter->GenerateNormalsOff();
    filter->GenerateSpecularOff();
    filter->SetCacheMemoryLimit(1024);
    filter->Update();
    if (!this->Picture)
    {
      this->Picture = vtkSmartPointer<vtkImageData>::New();
      this->Picture->DeepCopy(filter->GetOutput());
    }
    CHECK(SameBytes(this->Picture->GetPointData()->GetScalars(),
      filter->GetOutput()->GetPointData()->GetScalars()));
  }

private:
  RandomChanges Changes;
  vtkNew<vtkImageReliefShading> Filter;
  vtkNew<vtkColorTransferFunction> Table;
  vtkSmartPointer<vtkImageData> Heights = MakeHeights(60, 50, Hills(1));
  vtkSmartPointer<vtkImageData> Picture;
};

}

int TestReliefLongRun(int, char*[])
{
  Shading shading(ChooseSeed());
  const int updates = FromEnvironment("RELIEF_UPDATES", 10000);
  Footprint footprint;
  shading.Rest();
  for (int update = 1; update <= updates && Failures == 0; ++update)
  {
    shading.Step();
    // The first tenth warms up.
    if (update % (updates / 10) == 0)
    {
      shading.Rest();
      footprint.Note(update);
    }
  }
  // Seen: 300 bytes up or down, the rests of blocks that are a little larger than asked for. An
  // object forgotten in one of a hundred updates would be more.
  CHECK(footprint.Allocated() <= 2048.0);
  // Seen: 0.2 MB, pages in which a block is left.
  CHECK(footprint.Resident() <= 2.0e6);
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

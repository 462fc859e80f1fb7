// SPDX-License-Identifier: BSD-3-Clause
#ifndef OpenEXRLayerTestUtilities_h
#define OpenEXRLayerTestUtilities_h

/// @file
/// Files of layers, read back by OpenImageIO and checked by OpenEXR.

#include "ImageFileTestUtilities.h"

#include "vtkErrorCode.h"
#include "vtkLight.h"
#include "vtkOpenEXRLayerWriter.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <ImfCheckFile.h>

#include <limits>
#include <set>

inline int Failures = 0;
inline std::string Directory; ///< of the running test

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
constexpr float Infinity = std::numeric_limits<float>::infinity();

/// What OpenEXR's program exrcheck finds. The function returns whether it found damage, though its
/// header says the opposite; TestOpenEXRLayerWriterInvalid sees to it that it does.
inline bool IsDamaged(const std::string& name)
{
  return Imf::checkOpenEXRFile(name.c_str());
}

/// A file as OpenImageIO sees it.
struct Layers
{
  explicit Layers(const std::string& name)
    : Values(ReadFile(name, this->Spec))
  {
    CHECK(!this->Values.empty());
    CHECK(!IsDamaged(name));
  }

  int Index(const std::string& channel) const
  {
    const int index = this->Spec.channelindex(channel);
    if (index < 0)
    {
      std::cout << "there is no channel " << channel << std::endl;
      ++Failures;
    }
    return index;
  }

  /// A value by the image's indices from its lower left sample.
  float At(int channel, int i, int j) const
  {
    const size_t pixel = static_cast<size_t>(this->Spec.height - 1 - j) * this->Spec.width + i;
    return channel < 0 || this->Values.empty()
      ? NaN
      : this->Values[pixel * this->Spec.nchannels + channel];
  }
  float operator()(const std::string& channel, int i, int j) const
  {
    return this->At(this->Index(channel), i, j);
  }

  OIIO::TypeDesc Type(const std::string& channel) const
  {
    return this->Spec.channelformat(this->Spec.channelindex(channel));
  }

  OIIO::ImageSpec Spec;
  std::vector<float> Values;
};

/// Hills with a hole, every layer, two lights, extents that begin elsewhere.
inline vtkSmartPointer<vtkImageData> MakeShaded(int columns, int rows, vtkReliefScene* scene)
{
  const auto hills = Hills(5);
  auto heights =
    MakeHeights(columns, rows, [&](int i, int j) { return i == 3 && j == 2 ? NaN : hills(i, j); });
  heights->SetExtent(7, 6 + columns, -4, rows - 5, 2, 2);
  heights->SetOrigin(1000.0, 2000.0, 0.0);
  heights->SetSpacing(2.0, 3.0, 1.0);
  vtkReliefMaterial* material = scene->GetMaterial();
  material->SetBaseColor(0.1, 0.05, 0.02);
  material->SetDiffuseColor(0.9, 0.7, 0.4);
  material->SetSpecularCoefficient(0.2);
  material->SetForwardScatterCoefficient(0.3);
  material->SetSpecularPower(3.0);
  material->UseFloorOn();
  material->SetFloorHeight(-5.0);
  scene->AddSun(310.0, 35.0)->SetDiffuseColor(1.0, 0.9, 0.7);
  scene->AddSun(120.0, -20.0)->SetIntensity(0.4);
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(heights);
  shading->SetScene(scene);
  shading->GenerateBaseOn();
  shading->GenerateDiffuseOn();
  shading->GenerateScatterOn();
  shading->GenerateSpecularOn();
  shading->GenerateIlluminationOn();
  shading->GenerateThicknessOn();
  shading->GenerateNormalsOn();
  shading->Update();
  return shading->GetOutput();
}

inline void WriteGood(vtkOpenEXRLayerWriter* writer, vtkImageData* image, const std::string& name)
{
  MessageKeeper messages(writer);
  const int files = CountFiles(Directory);
  const bool old = std::filesystem::exists(name);
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->Write();
  CHECK(writer->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
  CHECK(CountFiles(Directory) == files + (old ? 0 : 1));
}

/// Every sample of every channel is the array's, NaN as 0.
inline void CompareWithArrays(const Layers& file, vtkImageData* image)
{
  static const std::vector<std::pair<std::string, std::string>> channels = { { "", "RGBA" },
    { "Base", "RGB" }, { "Diffuse", "RGB" }, { "Scatter", "RGB" }, { "Specular", "RGB" },
    { "Illumination", "Y" }, { "Thickness", "Z" }, { "Normals", "XYZ" } };
  int extent[6];
  image->GetExtent(extent);
  std::set<std::string> expected;
  size_t wrong = 0;
  for (const auto& layer : channels)
  {
    for (size_t c = 0; c < layer.second.size(); ++c)
    {
      const std::string name = (layer.first.empty() ? "" : layer.first + ".") + layer.second[c];
      expected.insert(name);
      const int index = file.Index(name);
      vtkDataArray* array = layer.first.empty()
        ? image->GetPointData()->GetScalars()
        : image->GetPointData()->GetArray(layer.first.c_str());
      vtkIdType point = 0;
      for (int j = extent[2]; j <= extent[3]; ++j)
      {
        for (int i = extent[0]; i <= extent[1]; ++i)
        {
          const auto value = static_cast<float>(array->GetComponent(point++, static_cast<int>(c)));
          const float stored = file.At(index, i - extent[0], j - extent[2]);
          wrong += stored != (std::isnan(value) ? 0.0f : value) ? 1 : 0;
        }
      }
    }
  }
  CHECK(wrong == 0);
  const auto& names = file.Spec.channelnames;
  CHECK(std::set<std::string>(names.begin(), names.end()) == expected);
  CHECK(file.Spec.x == 0 && file.Spec.y == 0 && file.Spec.full_x == 0 && file.Spec.full_y == 0);
  CHECK(file.Spec.full_width == file.Spec.width && file.Spec.full_height == file.Spec.height);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef TiledHeightsTestUtilities_h
#define TiledHeightsTestUtilities_h

/// @file
/// Heights that are read as they are needed beside the same in memory, for the tests of both.

#include "vtkImageReliefShading.h"

#include "ReliefTestUtilities.h"
#include "TiledHeights.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <atomic>
#include <cstring>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>

using relief::hosts::HeightSupply;
using relief::hosts::HeightSurvey;
using relief::hosts::TiledHeights;

// An image's heights, window by window.
class ImageSupply : public HeightSupply
{
public:
  ImageSupply(vtkImageData* heights, vtkImageData* mask, bool useNoData, double noData)
    : Heights(heights)
    , Mask(mask)
    , UseNoData(useNoData)
    , NoData(noData)
  {
  }

  int GetColumns() const override { return this->Heights->GetDimensions()[0]; }
  int GetRows() const override { return this->Heights->GetDimensions()[1]; }
  int GetBytesPerSample() const override { return this->Heights->GetScalarSize(); }

  Part Read(const Window& window) override
  {
    if (this->Fails)
    {
      throw std::runtime_error("the disk is gone");
    }
    this->Samples += (window.i1 - window.i0) * (window.j1 - window.j0);
    return { Cut(this->Heights, window), this->Mask ? Cut(this->Mask, window) : nullptr,
      this->UseNoData, this->NoData };
  }

  void Advance(double share) override { this->Share = share; }

  bool FindSurvey(double scale, HeightSurvey& survey) override
  {
    const bool found = this->Kept && this->Kept->scale == scale;
    if (found)
    {
      survey = *this->Kept;
    }
    return found;
  }
  void KeepSurvey(const HeightSurvey& survey) override
  {
    this->Kept = std::make_shared<HeightSurvey>(survey);
  }

  bool Fails = false;
  double Share = 0.0;
  std::atomic<long> Samples{ 0 };
  std::shared_ptr<HeightSurvey> Kept;

private:
  static vtkSmartPointer<vtkImageData> Cut(vtkImageData* image, const Window& window)
  {
    auto part = vtkSmartPointer<vtkImageData>::New();
    part->SetDimensions(window.i1 - window.i0, window.j1 - window.j0, 1);
    part->AllocateScalars(image->GetScalarType(), 1);
    const std::size_t size = image->GetScalarSize();
    for (int j = window.j0; j < window.j1; ++j)
    {
      std::memcpy(part->GetScalarPointer(0, j - window.j0, 0),
        image->GetScalarPointer(window.i0, j, 0), size * (window.i1 - window.i0));
    }
    return part;
  }

  vtkSmartPointer<vtkImageData> Heights;
  vtkSmartPointer<vtkImageData> Mask;
  bool UseNoData;
  double NoData;
};

inline double Between(std::mt19937& random, double least, double greatest)
{
  return std::uniform_real_distribution<double>(least, greatest)(random);
}

inline bool Chance(std::mt19937& random, double share)
{
  return Between(random, 0.0, 1.0) < share;
}

// Two filters that differ in nothing but where the heights are.
struct Pair
{
  vtkNew<vtkImageReliefShading> Whole;
  vtkNew<vtkImageReliefShading> Tiled;
  vtkSmartPointer<vtkImageData> Heights;
  vtkNew<TiledHeights> Array;
  std::shared_ptr<ImageSupply> Supply;

  void SetHeights(vtkImageData* heights, vtkImageData* mask, bool useNoData, double noData)
  {
    this->Heights = heights;
    this->Supply = std::make_shared<ImageSupply>(heights, mask, useNoData, noData);
    this->Array->SetSupply(this->Supply);
    vtkNew<vtkImageData> image;
    image->CopyStructure(heights);
    image->GetPointData()->SetScalars(this->Array);
    this->Whole->SetInputData(heights);
    if (mask)
    {
      this->Whole->SetMaskData(mask);
    }
    if (useNoData)
    {
      this->Whole->SetNoDataValue(noData);
    }
    this->Tiled->SetInputData(image);
  }

  template <class Change>
  void ForBoth(const Change& change)
  {
    change(this->Whole.Get());
    change(this->Tiled.Get());
  }
};

// Compares an extent of the second filter with the first one's output, bit for bit.
inline std::string Compare(vtkImageData* whole, vtkImageReliefShading* tiled, const int extent[6])
{
  tiled->Modified(); // else what lies in the last extent is not made anew
  tiled->UpdateExtent(extent);
  vtkImageData* piece = tiled->GetOutput();
  const int columns = whole->GetDimensions()[0];
  const std::size_t width = extent[1] - extent[0] + 1;
  const int count = whole->GetPointData()->GetNumberOfArrays();
  if (piece->GetPointData()->GetNumberOfArrays() != count || piece->GetNumberOfPoints() == 0)
  {
    return "arrays are missing";
  }
  for (int array = 0; array < count; ++array)
  {
    vtkDataArray* a = whole->GetPointData()->GetArray(array);
    vtkDataArray* b = piece->GetPointData()->GetArray(a->GetName());
    const std::size_t tuple =
      static_cast<std::size_t>(a->GetNumberOfComponents()) * a->GetDataTypeSize();
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      const char* rowA = static_cast<const char*>(a->GetVoidPointer(0)) +
        (static_cast<std::size_t>(j) * columns + extent[0]) * tuple;
      const char* rowB =
        static_cast<const char*>(b->GetVoidPointer(0)) + (j - extent[2]) * width * tuple;
      if (std::memcmp(rowA, rowB, width * tuple) != 0)
      {
        return "row " + std::to_string(j) + " of " + a->GetName();
      }
    }
  }
  return std::string();
}

#endif

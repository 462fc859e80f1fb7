// SPDX-License-Identifier: BSD-3-Clause
#ifndef NormalMapTestUtilities_h
#define NormalMapTestUtilities_h

#include "vtkNormalMapToHeightField.h"

#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include "ReliefTestUtilities.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

/// A surface as a function of the indices: its height, and its slopes to the right and up.
struct SurfaceAt
{
  double height;
  double x;
  double y;
};
using Surface = std::function<SurfaceAt(int, int)>;
using Domain = std::function<bool(int, int)>;

/// Normals of any number of components and any type, as a function of the indices.
template <class ArrayType = vtkDoubleArray>
vtkSmartPointer<vtkImageData> MakeVectors(
  int columns, int rows, int components, const std::function<void(int, int, double*)>& vector)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, 1);
  vtkNew<ArrayType> values;
  values->SetNumberOfComponents(components);
  values->SetNumberOfTuples(static_cast<vtkIdType>(columns) * rows);
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      double tuple[4] = { 0.0, 0.0, 0.0, 0.0 };
      vector(i, j, tuple);
      values->SetTuple(static_cast<vtkIdType>(j) * columns + i, tuple);
    }
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

/// The unit normals of a surface, with noise of a standard deviation on each component.
inline vtkSmartPointer<vtkImageData> MakeNormals(
  int columns, int rows, const Surface& surface, double noise = 0.0, unsigned int seed = 1)
{
  std::mt19937 generator(seed);
  // The same numbers with every library, unlike those of std::normal_distribution.
  const auto draw = [&generator]
  {
    double sum = -6.0;
    for (int k = 0; k < 12; ++k)
    {
      sum += generator() / 4294967296.0;
    }
    return sum;
  };
  return MakeVectors(columns, rows, 3,
    [&](int i, int j, double* n)
    {
      const SurfaceAt at = surface(i, j);
      const double length = std::hypot(at.x, at.y, 1.0);
      n[0] = -at.x / length;
      n[1] = -at.y / length;
      n[2] = 1.0 / length;
      for (int c = 0; c < 3 && noise > 0.0; ++c)
      {
        n[c] += noise * draw();
      }
    });
}

/// A mask of a domain.
inline vtkSmartPointer<vtkImageData> MakeMask(int columns, int rows, const Domain& domain)
{
  return MakeHeights<vtkUnsignedCharArray>(
    columns, rows, [&](int i, int j) { return domain(i, j) ? 1.0 : 0.0; });
}

/// How far heights are from those expected, up to a constant, where both are numbers.
struct HeightError
{
  double rms = 0.0;
  double mean = 0.0;
  double worst = 0.0;
  double range = 0.0; ///< of those expected
  int count = 0;
};

inline HeightError CompareHeights(
  vtkImageData* image, const std::function<double(int, int)>& expected)
{
  const int* dimensions = image->GetDimensions();
  std::vector<double> differences;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  double sum = 0.0;
  for (int j = 0; j < dimensions[1]; ++j)
  {
    for (int i = 0; i < dimensions[0]; ++i)
    {
      const double height = image->GetPointData()->GetScalars()->GetComponent(
        static_cast<vtkIdType>(j) * dimensions[0] + i, 0);
      const double wanted = expected(i, j);
      if (!std::isnan(height) && !std::isnan(wanted))
      {
        differences.push_back(height - wanted);
        sum += height - wanted;
        least = std::min(least, wanted);
        most = std::max(most, wanted);
      }
    }
  }
  HeightError error;
  error.count = static_cast<int>(differences.size());
  const double offset = error.count > 0 ? sum / error.count : 0.0;
  for (const double difference : differences)
  {
    error.rms += (difference - offset) * (difference - offset) / error.count;
    error.mean += std::abs(difference - offset) / error.count;
    error.worst = std::max(error.worst, std::abs(difference - offset));
  }
  error.rms = std::sqrt(error.rms);
  error.range = error.count > 0 ? most - least : 0.0;
  return error;
}

/// The height of a sample of an output.
inline double HeightAt(vtkImageData* image, int i, int j)
{
  return image->GetPointData()->GetScalars()->GetComponent(
    static_cast<vtkIdType>(j) * image->GetDimensions()[0] + i, 0);
}

#endif

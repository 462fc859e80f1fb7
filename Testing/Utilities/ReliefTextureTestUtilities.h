// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefTextureTestUtilities_h
#define ReliefTextureTestUtilities_h

#include "ReliefTestUtilities.h"

#include <array>

using Color = std::array<double, 4>;

/// sRGB to linear, by IEC 61966-2-1.
inline double Decode(double c)
{
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// A texture whose texels are a function of their indices; `most` is what stands for 1.
template <class ArrayType>
vtkSmartPointer<vtkImageData> MakeTexture(int columns, int rows, int components,
  const std::function<Color(int, int)>& color, double most = 1.0)
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
      for (int c = 0; c < components; ++c)
      {
        values->SetComponent(static_cast<vtkIdType>(j) * columns + i, c, color(i, j)[c] * most);
      }
    }
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

/// What the filter makes now.
inline vtkSmartPointer<vtkImageData> Update(vtkImageReliefShading* filter)
{
  filter->Update();
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->ShallowCopy(filter->GetOutput());
  return result;
}

#endif

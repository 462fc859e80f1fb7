// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureArrays_h
#define PictureArrays_h

/// @file
/// Room for what is shaded, aligned as the model writes it. Not installed.

#include "LargePages.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <new>

namespace relief::hosts
{
/// Memory that begins at a line of the caches, which whole lines can be written to.
constexpr std::align_val_t Line{ 64 };

inline void FreeLines(void* memory)
{
  ::operator delete(memory, Line);
}

/// Room for a picture. That of the last run is used again where nobody else has come to hold it,
/// as vtkImageData::AllocateScalars() does.
template <class Array>
vtkSmartPointer<Array> MakePicture(
  vtkSmartPointer<vtkDataArray>& last, vtkIdType samples, int components)
{
  auto array = Array::SafeDownCast(last) != nullptr && last->GetReferenceCount() == 1 &&
      last->GetNumberOfComponents() == components && last->GetNumberOfTuples() == samples
    ? vtkSmartPointer<Array>(Array::SafeDownCast(last))
    : nullptr;
  last = nullptr; // before there is more
  if (array)
  {
    array->Modified();
    return array;
  }
  using Number = typename Array::ValueType;
  array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(components);
  const vtkIdType values = samples * components;
  const std::size_t bytes = static_cast<std::size_t>(values) * sizeof(Number);
  auto* memory = static_cast<Number*>(::operator new(bytes, Line));
  UseLargePages(memory, bytes);
  array->SetArray(memory, values, 0, vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
  array->SetArrayFreeFunction(FreeLines);
  return array;
}

/// Room for a layer, which is added to an image if it is wanted; else null.
inline float* AddLayer(vtkImageData* image, bool wanted, const char* name, int components)
{
  if (!wanted)
  {
    return nullptr;
  }
  // Where there is no memory, VTK's own arrays would report it as well.
  vtkSmartPointer<vtkDataArray> none;
  const auto layer = MakePicture<vtkFloatArray>(none, image->GetNumberOfPoints(), components);
  layer->SetName(name);
  image->GetPointData()->AddArray(layer);
  return layer->GetPointer(0);
}
}

#endif

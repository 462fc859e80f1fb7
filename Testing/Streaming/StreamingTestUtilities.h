// SPDX-License-Identifier: BSD-3-Clause
#ifndef StreamingTestUtilities_h
#define StreamingTestUtilities_h

#include "FileGuard.h"
#include "FileTestUtilities.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

/// What a step throws as a Failure; empty if it does not.
inline std::string Thrown(const std::function<void()>& step)
{
  try
  {
    step();
  }
  catch (const relief::io::Failure& failure)
  {
    return failure.what();
  }
  return std::string();
}

inline bool Contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// One array of a piece: its bytes at random, or all from one number, as floats have them: NaN of
/// any kind, infinity, -0 and denormal numbers among them.
template <class ArrayType>
void AddArray(vtkImageData* piece, const char* name, int components, std::mt19937& random)
{
  auto array = vtkSmartPointer<ArrayType>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(piece->GetNumberOfPoints());
  const std::size_t size =
    static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize();
  std::vector<unsigned char> bytes(size);
  static const std::uint32_t alike[] = { 0u, 0x80000000u, 0x7fc00000u, 0xffc00001u, 0x7f800001u,
    0xff7fffffu, 0x7f800000u, 0xffffffffu, 1u };
  if (random() % 2 == 0)
  {
    for (unsigned char& byte : bytes)
    {
      byte = static_cast<unsigned char>(random());
    }
  }
  else
  {
    const std::uint32_t word = alike[random() % (sizeof alike / sizeof alike[0])];
    for (std::size_t at = 0; at < size; ++at)
    {
      bytes[at] = static_cast<unsigned char>(word >> (8 * (at % 4)));
    }
  }
  std::memcpy(array->GetVoidPointer(0), bytes.data(), size);
  if (piece->GetPointData()->GetNumberOfArrays() == 0)
  {
    piece->GetPointData()->SetScalars(array);
  }
  else
  {
    piece->GetPointData()->AddArray(array);
  }
}

/// A piece of that extent with a picture and up to three layers, the same for the same seed.
inline vtkSmartPointer<vtkImageData> RandomPiece(const int extent[6], unsigned int seed)
{
  std::mt19937 random(seed);
  auto piece = vtkSmartPointer<vtkImageData>::New();
  piece->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  if (random() % 2 == 0)
  {
    AddArray<vtkUnsignedCharArray>(piece, "Shading", 4, random);
  }
  else
  {
    AddArray<vtkFloatArray>(piece, "Shading", 4, random);
  }
  static const char* const names[] = { "Illumination", "Normals", "A layer/of: its own" };
  static const int components[] = { 1, 3, 7 };
  for (std::size_t k = 0; k < random() % 4; ++k)
  {
    AddArray<vtkFloatArray>(piece, names[k], components[k], random);
  }
  return piece;
}

inline std::vector<std::string> NamesOf(vtkImageData* piece)
{
  std::vector<std::string> names;
  for (int k = 0; k < piece->GetPointData()->GetNumberOfArrays(); ++k)
  {
    names.emplace_back(piece->GetPointData()->GetArrayName(k));
  }
  return names;
}

/// Whether two pieces have the same arrays over the same extent, bit for bit.
inline bool SamePieces(vtkImageData* one, vtkImageData* other)
{
  if (NamesOf(one) != NamesOf(other) ||
    std::memcmp(one->GetExtent(), other->GetExtent(), 6 * sizeof(int)) != 0)
  {
    return false;
  }
  for (int k = 0; k < one->GetPointData()->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* a = one->GetPointData()->GetArray(k);
    vtkDataArray* b = other->GetPointData()->GetArray(k);
    if (a->GetDataType() != b->GetDataType() ||
      a->GetNumberOfComponents() != b->GetNumberOfComponents() ||
      a->GetNumberOfTuples() != b->GetNumberOfTuples() ||
      std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
        static_cast<std::size_t>(a->GetNumberOfValues()) * a->GetDataTypeSize()) != 0)
    {
      return false;
    }
  }
  return one->GetPointData()->GetScalars() == one->GetPointData()->GetArray(0) &&
    other->GetPointData()->GetScalars() == other->GetPointData()->GetArray(0);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "PictureBands.h"

#include "FileGuard.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"

#include <limits>
#include <type_traits>

namespace relief::raster
{
namespace
{
template <class T>
constexpr T Opaque()
{
  return std::is_floating_point_v<T> ? T(1) : std::numeric_limits<T>::max();
}

//------------------------------------------------------------------------------
/// What a picture's values tell.
struct Found
{
  bool Grey = true;
  bool Opaque = true;
};

template <class T>
Found LookAt(const T* values, vtkIdType count, int components)
{
  Found found;
  const int alpha = components % 2 == 0 ? components - 1 : -1;
  for (vtkIdType i = 0; i < count; ++i, values += components)
  {
    // As bits go: where there is no data all three may be NaN.
    const auto same = [](T a, T b) { return a == b || (a != a && b != b); };
    found.Grey =
      found.Grey && (components < 3 || (same(values[0], values[1]) && same(values[0], values[2])));
    found.Opaque = found.Opaque && (alpha < 0 || values[alpha] == Opaque<T>());
  }
  return found;
}

//------------------------------------------------------------------------------
template <class T>
void Take(const T* from, int given, T* to, int wanted, vtkIdType count)
{
  for (vtkIdType i = 0; i < count; ++i, from += given, to += wanted)
  {
    const int colors = wanted < 3 ? 1 : 3;
    for (int c = 0; c < colors; ++c)
    {
      to[c] = from[given < 3 ? 0 : c];
    }
    if (wanted % 2 == 0)
    {
      to[wanted - 1] = given % 2 == 0 ? from[given - 1] : Opaque<T>();
    }
  }
}

//------------------------------------------------------------------------------
int CountOf(PictureBands wanted, int given, const Found& found)
{
  switch (wanted)
  {
    case PictureBands::Auto:
      return (found.Grey ? 1 : 3) + (found.Opaque ? 0 : 1);
    case PictureBands::Grey:
      return 1;
    case PictureBands::RGB:
      return 3;
    case PictureBands::RGBA:
      return 4;
    default:
      return given;
  }
}
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataArray> ChooseBands(vtkDataArray* picture, PictureBands wanted)
{
  const int given = picture->GetNumberOfComponents();
  const vtkIdType count = picture->GetNumberOfTuples();
  if (wanted == PictureBands::Given)
  {
    return picture;
  }
  Found found;
  if (wanted == PictureBands::Auto || wanted == PictureBands::Grey)
  {
    switch (picture->GetDataType())
    {
      vtkTemplateMacro(
        found = LookAt(static_cast<const VTK_TT*>(picture->GetVoidPointer(0)), count, given));
    }
  }
  if (wanted == PictureBands::Grey && !found.Grey)
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "its colours are not grey, which is what Bands asks for; AUTO or RGB keeps them");
  }
  const int components = CountOf(wanted, given, found);
  if (components == given)
  {
    return picture;
  }
  auto chosen =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(picture->GetDataType()));
  chosen->SetName(picture->GetName());
  chosen->SetNumberOfComponents(components);
  chosen->SetNumberOfTuples(count);
  switch (picture->GetDataType())
  {
    vtkTemplateMacro(Take(static_cast<const VTK_TT*>(picture->GetVoidPointer(0)), given,
      static_cast<VTK_TT*>(chosen->GetVoidPointer(0)), components, count));
  }
  return chosen;
}
}

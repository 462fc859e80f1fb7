// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFrame.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"

#include "SceneBounds.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace relief::hosts
{
//------------------------------------------------------------------------------
std::string ImageFrame::Assign(vtkImageData* image)
{
  const int* extent = image->GetExtent();
  const double* spacing = image->GetSpacing();
  std::copy_n(image->GetOrigin(), 3, this->Origin);
  std::copy_n(image->GetDirectionMatrix()->GetData(), 9, this->Direction);
  std::ostringstream message;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double size = std::abs(spacing[axis]);
    if (!(size >= 1.0 / LargestLength && size <= LargestLength))
    {
      message << "the spacing is (" << spacing[0] << ", " << spacing[1]
              << "), numbers from 1e-32 to 1e32, or these negative, are expected";
      return message.str();
    }
    this->Spacing[axis] = std::abs(spacing[axis]);
    this->Sign[axis] = spacing[axis] < 0.0 ? -1.0 : 1.0;
    this->First[axis] = extent[2 * axis] * this->Spacing[axis];
  }
  vtkMatrix3x3::Invert(this->Direction, this->Inverse);
  // The volume that the three directions span: beside that of a box of the same lengths it tells
  // how near to a plane they lie, where their inverse has no digits left.
  double box = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* m = this->Direction;
    box *= std::hypot(m[axis], m[3 + axis], m[6 + axis]);
  }
  const double volume = std::abs(vtkMatrix3x3::Determinant(this->Direction));
  if (!std::isfinite(this->Origin[0] + this->Origin[1] + this->Origin[2]) ||
    !(volume >= 1e-12 * box && box >= 1e-15 && box <= 1e15))
  {
    return "origin and direction matrix must be finite, and the matrix regular";
  }
  return std::string();
}

//------------------------------------------------------------------------------
glm::dvec3 ImageFrame::VectorFromWorld(const double world[3]) const
{
  double local[3];
  vtkMatrix3x3::MultiplyPoint(this->Inverse, world, local);
  return { local[0] * this->Sign[0], local[1] * this->Sign[1], local[2] };
}

//------------------------------------------------------------------------------
glm::dvec3 ImageFrame::PointFromWorld(const double world[3]) const
{
  const double fromOrigin[3] = { world[0] - this->Origin[0], world[1] - this->Origin[1],
    world[2] - this->Origin[2] };
  return this->VectorFromWorld(fromOrigin) - glm::dvec3(this->First[0], this->First[1], 0.0);
}

//------------------------------------------------------------------------------
bool ImageFrame::IsWorld() const
{
  static const double identity[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  return this->Sign[0] > 0.0 && this->Sign[1] > 0.0 &&
    std::equal(identity, identity + 9, this->Direction);
}

//------------------------------------------------------------------------------
void ImageFrame::NormalToWorld(float* n) const
{
  const double local[3] = { n[0] * this->Sign[0], n[1] * this->Sign[1], n[2] };
  double world[3];
  vtkMatrix3x3::MultiplyPoint(this->Direction, local, world);
  std::copy_n(world, 3, n);
}

//------------------------------------------------------------------------------
std::string CheckImage(vtkImageData* image, vtkDataArray* scalars, const char* what)
{
  std::ostringstream message;
  const int* extent = image->GetExtent();
  if (image->GetNumberOfPoints() < 1)
  {
    message << "the " << what << " image is empty";
  }
  else if (extent[4] != extent[5])
  {
    message << "the " << what << " image has " << extent[5] - extent[4] + 1
            << " slices, 1 is expected";
  }
  else if (!scalars)
  {
    message << "the " << what << " image has no scalars";
  }
  else if (scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    message << "the " << what << " array has " << scalars->GetNumberOfTuples() << " values, "
            << image->GetNumberOfPoints() << " are expected";
  }
  else if (scalars->GetDataType() == VTK_BIT)
  {
    message << "the " << what << " scalars are bits, a numeric type is expected";
  }
  return message.str();
}

//------------------------------------------------------------------------------
std::string CheckInput(vtkImageData* image, vtkDataArray* scalars, const char* what)
{
  std::string wrong = CheckImage(image, scalars, what);
  if (wrong.empty() && scalars->GetNumberOfComponents() != 1)
  {
    std::ostringstream message;
    message << "the " << what << " image has " << scalars->GetNumberOfComponents()
            << " components, 1 is expected";
    wrong = message.str();
  }
  return wrong;
}

//------------------------------------------------------------------------------
std::string ConvertColors(
  vtkImageData* image, vtkDataArray* scalars, const char* what, relief::ColorTexture& result)
{
  const std::string wrong = CheckImage(image, scalars, what);
  if (!wrong.empty())
  {
    return wrong;
  }
  std::ostringstream message;
  switch (scalars->GetDataType())
  {
    case VTK_UNSIGNED_CHAR:
      result.type = relief::ColorTexture::Type::Byte;
      break;
    case VTK_UNSIGNED_SHORT:
      result.type = relief::ColorTexture::Type::Short;
      break;
    case VTK_FLOAT:
      result.type = relief::ColorTexture::Type::Float;
      break;
    case VTK_DOUBLE:
      result.type = relief::ColorTexture::Type::Double;
      break;
    default:
      message << "the " << what << " scalars are of type " << scalars->GetDataTypeAsString()
              << "; unsigned char or unsigned short (sRGB), float or double (linear) is expected";
      return message.str();
  }
  result.components = scalars->GetNumberOfComponents();
  if (result.components < 1 || result.components > 4)
  {
    message << "the " << what << " image has " << result.components
            << " components, 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGB, alpha) are expected";
    return message.str();
  }
  result.texels = scalars->GetVoidPointer(0);
  result.columns = image->GetDimensions()[0];
  result.rows = image->GetDimensions()[1];
  return std::string();
}
}

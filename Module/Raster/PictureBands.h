// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureBands_h
#define PictureBands_h

#include "vtkSmartPointer.h"

class vtkDataArray;

namespace relief::raster
{
/// Which components a picture is written with.
enum class PictureBands
{
  Given, ///< as it has them
  Auto,  ///< grey if it is that everywhere, and alpha if that hides anything
  Grey,
  RGB,
  RGBA
};

/// A picture of 1 to 4 components (grey, grey and alpha, red, green and blue, these and alpha) with
/// those that are wanted: the same array where it has them. Throws a Failure where it would lose
/// colours, or a std::bad_alloc.
vtkSmartPointer<vtkDataArray> ChooseBands(vtkDataArray* picture, PictureBands wanted);
}

#endif

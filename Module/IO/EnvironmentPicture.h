// SPDX-License-Identifier: BSD-3-Clause
#ifndef EnvironmentPicture_h
#define EnvironmentPicture_h

/// @file
/// Reads the image of an environment. Private to the module.

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace relief::io
{
/// An image, or why there is none: part of a sentence that does not name the file.
struct EnvironmentPicture
{
  vtkSmartPointer<vtkImageData> Image;
  std::string Reason;
};

/// Reports nothing itself.
EnvironmentPicture ReadEnvironmentPicture(const std::string& fileName);
}

#endif

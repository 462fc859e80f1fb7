// SPDX-License-Identifier: BSD-3-Clause
#ifndef OpenedPicture_h
#define OpenedPicture_h

/// @file
/// A file of OpenImageIO's that is open at the picture and the channels that are asked for. Private
/// to the module.

#include "FileGuard.h"
#include "ImageFileAccess.h"

#include <OpenImageIO/imageio.h>

#include <array>
#include <memory>
#include <string>

namespace relief::io
{
/// What vtkOpenImageIOReader's properties ask for.
struct Request
{
  std::string FileName;
  int Subimage = 0;
  std::string SubimageName;
  std::string ChannelName;
  int MipLevel = 0;
  bool AlphaAsMask = false;
  bool StraightAlpha = false;
  vtkTypeInt64 MemoryLimit = 0;
};

/// Throws a Failure for what is not read.
struct Picture
{
  explicit Picture(const Request& request);

  /// Of the scalars.
  int Components() const;

  std::unique_ptr<OIIO::ImageInput> Input;
  OIIO::ImageSpec Spec;
  int Subimage = 0;
  int ScalarType = VTK_VOID;
  int Orientation = 1;
  /// The channel that is asked for; -1 for all.
  int Channel = -1;
  /// The one that becomes a point array of its own; -1 for none.
  int Separate = -1;
  /// What colours are divided by to be those that the file means.
  bool DividedByAlpha = false;
  std::array<double, 3> Exposure{ 1.0, 1.0, 1.0 };

private:
  void CheckSpec();
};
}

#endif

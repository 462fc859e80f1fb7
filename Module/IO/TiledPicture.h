// SPDX-License-Identifier: BSD-3-Clause
#ifndef TiledPicture_h
#define TiledPicture_h

/// @file
/// Pictures that are never in memory as a whole. Not installed.

#include "vtkIOReliefShadingModule.h" // For export macro

#include <cstddef>
#include <memory>
#include <string>

namespace relief::io
{
/// An OpenEXR file in tiles that is written some rows at a time, the upper ones first.
class VTKIORELIEFSHADING_EXPORT TiledPicture
{
public:
  /// Creates a file of that size under this very name, of float numbers. Throws a Failure.
  TiledPicture(const std::string& file, const int size[2], int components);
  ~TiledPicture();
  TiledPicture(const TiledPicture&) = delete;
  void operator=(const TiledPicture&) = delete;

  /// Writes the next rows, `bytes` from one to the next in memory, below 0 where they lie the other
  /// way round. Throws a Failure.
  void Write(int rows, const void* first, std::ptrdiff_t bytes);

  /// Writes what is still in memory, and looks whether all is there. Throws a Failure.
  void Finish();

private:
  struct Internals;
  std::unique_ptr<Internals> Internal;
};
}

#endif

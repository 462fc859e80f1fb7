// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureTags_h
#define PictureTags_h

/// @file
/// What a picture's file says of how its pixels are stored, read from its tags: of TIFF, and of the
/// EXIF in JPEG, PNG and WebP. Not installed.

#include "vtkIOReliefRasterModule.h" // For export macro

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace relief::raster
{
/// The bytes of a file from a place on; fewer where it ends.
using ByteSource = std::function<std::string(std::uint64_t begin, std::size_t count)>;

/// The bytes of a file on the disk; none if it cannot be opened.
VTKIORELIEFRASTER_EXPORT ByteSource BytesOf(const std::string& file);

/// How the rows lie, as the tag Orientation counts: 1, also where there is none, for the upper row
/// first, from left to right; 6 for the right column first, from top to bottom; and so on to 8.
VTKIORELIEFRASTER_EXPORT int FindOrientation(const ByteSource& file);

/// Whether a TIFF says that its colours are multiplied by alpha.
bool HasPremultipliedAlpha(const ByteSource& file);
}

#endif

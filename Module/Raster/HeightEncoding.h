// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightEncoding_h
#define HeightEncoding_h

/// @file
/// Heights that are spread over the three bytes of a colour, as the tiles of web maps have them.
/// Not installed.

#include "RasterFile.h"

#include <functional>
#include <memory>

namespace relief::raster
{
/// Opens a file with these options; null if it is of another kind.
using OpenFile = std::function<std::unique_ptr<RasterFile>(const ReadOptions&)>;

/// Opens a file as the options' encoding says: as it is or, once for each of red, green and blue,
/// for heights in metres, as float. Its alpha or mask is kept, a value of its bytes for no data is
/// not. Null if `open` gives that. Throws a Failure unless there are three bands of bytes.
VTKIORELIEFRASTER_EXPORT std::unique_ptr<RasterFile> OpenEncoded(
  const ReadOptions& options, const OpenFile& open);
}

#endif

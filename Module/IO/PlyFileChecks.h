// SPDX-License-Identifier: BSD-3-Clause
#ifndef PlyFileChecks_h
#define PlyFileChecks_h

/// @file
/// What is looked at in a PLY file before VTK's reader is let at it. Private to the module.

#include <cstdint>
#include <istream>

namespace relief::io
{

/// Goes through a file of a size, from its beginning. Throws a Failure if its header is damaged,
/// lacks points or polygons, if there is less behind it than it tells, or if a polygon names a
/// point that is not there.
void CheckPlyFile(std::istream& stream, std::uint64_t size);

}

#endif

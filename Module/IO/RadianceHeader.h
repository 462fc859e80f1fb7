// SPDX-License-Identifier: BSD-3-Clause
#ifndef RadianceHeader_h
#define RadianceHeader_h

/// @file
/// What the header of a Radiance picture says. Private to the module.

#include <array>
#include <ios>
#include <string>

namespace relief::io
{
struct RadianceHeader
{
  /// What the stored red, green and blue are to be divided by: the exposures and the corrections of
  /// colour together.
  std::array<double, 3> Exposure{ 1.0, 1.0, 1.0 };
  /// How the pixels lie, as EXIF counts: 1 is the upper row first, from left to right.
  int Orientation = 1;
  /// How many pixels a line has, and how many lines there are, where Orientation is 1; 0 where the
  /// header does not say it.
  int Columns = 0;
  int Rows = 0;
  /// Where they begin in the file.
  std::streamoff Pixels = 0;
};

/// Whether a file begins as Radiance's do.
bool IsRadiance(const std::string& fileName);

/// Throws a Failure for colours of another kind than red, green and blue.
RadianceHeader ReadRadianceHeader(const std::string& fileName);
}

#endif

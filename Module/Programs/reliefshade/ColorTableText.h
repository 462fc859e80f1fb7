// SPDX-License-Identifier: BSD-3-Clause
#ifndef ColorTableText_h
#define ColorTableText_h

#include <array>
#include <functional>
#include <istream>
#include <string>
#include <vector>

namespace reliefshade
{

/// A colour at a height; between two of them colours are interpolated.
struct ColorNode
{
  double Height;
  std::array<double, 4> Color; ///< red, green, blue, alpha from 0 to 1
};

/// Reads a colour table in any of the three forms that readColorTable takes. Returns its nodes by
/// height; where the colour jumps, two of them are as close as numbers can be. `heightOfShare`
/// gives the height of a share of the raster's range (0 to 1). `gmt` says that the file's name is
/// one of GMT's. Throws a std::runtime_error that names the line.
std::vector<ColorNode> parseColorTable(
  std::istream& stream, bool gmt, const std::function<double(double)>& heightOfShare);

}

#endif

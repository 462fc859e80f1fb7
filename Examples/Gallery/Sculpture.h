// SPDX-License-Identifier: BSD-3-Clause
#ifndef Sculpture_h
#define Sculpture_h

/// @file
/// Sculptures made by program, as height images of any resolution. Needs nothing but C++17.

#include <cstddef>
#include <vector>

namespace sculpture
{

/// Heights seen from the front, toward the viewer, in the unit in which the image is 2 wide; NaN
/// beside the sculpture. Row 0 is the lowest.
struct HeightImage
{
  int columns = 0;
  int rows = 0;
  double spacing = 0.0;
  std::vector<float> heights;

  std::size_t At(int i, int j) const { return static_cast<std::size_t>(j) * this->columns + i; }
};

/// An owl on a branch, in full round: feathers, claws, bark. About 2 wide, 2.3 high and 0.7 deep.
/// `detail` is how deep feathers and bark are carved; 0 leaves smooth forms. `size` is the number
/// of columns, at least 1. Time grows with its square: about a second at 256.
HeightImage CarveOwl(int size, double detail = 1.0);

/// A medallion: a disc with a molded rim, a ring of beads and a rosette of petals in two tiers.
/// `size` is the number of columns and rows, at least 1.
HeightImage StrikeRosette(int size);

}

#endif

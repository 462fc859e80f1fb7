// SPDX-License-Identifier: BSD-3-Clause
//
// Carves the owl of the gallery for the page, standing on level ground, as a grey picture of 16
// bits (PGM) whose comment has the spacing and the height of white, in the unit in which the
// picture is 2 wide.
#include "Sculpture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>

int main(int argc, char* argv[])
{
  const int size = argc == 3 ? std::atoi(argv[1]) : 0;
  if (size < 2 || size > 8192)
  {
    std::cerr << "usage: reliefWebFigure SAMPLES FILE.pgm, SAMPLES from 2 to 8192\n";
    return EXIT_FAILURE;
  }
  const sculpture::HeightImage owl = sculpture::CarveOwl(size);
  float ground = std::numeric_limits<float>::infinity();
  float top = -ground;
  for (const float height : owl.heights)
  {
    ground = std::isnan(height) ? ground : std::min(ground, height);
    top = std::isnan(height) ? top : std::max(top, height);
  }
  std::ofstream file(argv[2], std::ios::binary);
  file << "P5\n# " << owl.spacing << ' ' << top - ground << '\n'
       << owl.columns << ' ' << owl.rows << "\n65535\n";
  for (int j = owl.rows - 1; j >= 0; --j)
  {
    for (int i = 0; i < owl.columns; ++i)
    {
      const float height = owl.heights[owl.At(i, j)];
      const float share = std::isnan(height) ? 0.0f : (height - ground) / (top - ground);
      const long code = std::lround(65535.0f * share);
      file.put(static_cast<char>(code >> 8)).put(static_cast<char>(code & 255));
    }
  }
  file.close();
  if (!file)
  {
    std::cerr << argv[2] << " cannot be written\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

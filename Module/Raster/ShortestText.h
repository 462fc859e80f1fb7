// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShortestText_h
#define ShortestText_h

#include <array>
#include <charconv>
#include <string>

namespace relief::raster
{
/// The shortest text that means the same number, of single or double precision.
template <class Real>
std::string TextOf(Real number)
{
  std::array<char, 32> text;
  return std::string(
    text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr);
}
}

#endif

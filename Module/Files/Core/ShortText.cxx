// SPDX-License-Identifier: BSD-3-Clause
#include "ShortText.h"

namespace relief::io
{

//------------------------------------------------------------------------------
std::string Shortened(const std::string& text, std::size_t longest)
{
  if (text.size() <= longest)
  {
    return text;
  }
  // No character of several bytes is cut in two: those behind its first begin with the bits 10.
  const auto inside = [&text](std::size_t at)
  { return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80; };
  const std::string gap = "...";
  const std::size_t half = (longest - gap.size()) / 2;
  std::size_t begin = half;
  std::size_t end = text.size() - half;
  while (begin > 0 && inside(begin))
  {
    --begin;
  }
  while (inside(end))
  {
    ++end;
  }
  return text.substr(0, begin) + gap + text.substr(end);
}

}

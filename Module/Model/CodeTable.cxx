// SPDX-License-Identifier: BSD-3-Clause
#include "CodeTable.h"

#include "ReliefModel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief
{

const CodeTable& CodeTable::Get()
{
  static const CodeTable table;
  return table;
}

CodeTable::CodeTable()
{
  this->Begin[0] = 0.0f;
  for (int code = 1; code < 256; ++code)
  {
    this->Begin[code] = static_cast<float>(f64::reliefDecode((code - 0.5) / 255.0));
  }
  this->Begin[256] = std::numeric_limits<float>::infinity();
  int code = 0;
  for (int k = 0; k <= Steps; ++k)
  {
    const float linear = static_cast<float>(k) / Steps;
    while (linear >= this->Begin[code + 1])
    {
      ++code;
    }
    this->First[k] = static_cast<unsigned char>(code);
    // Where the next code begins is a whole number of parts: from 1/2 of a step on a float is a
    // multiple of one.
    const double next = static_cast<double>(this->Begin[code + 1]) * Steps - k;
    const auto before = static_cast<std::uint32_t>(std::min(next, 1.0) * Parts);
    this->Entries[k] =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(code) * Parts + (Parts - before));
  }
}

unsigned char CodeTable::operator()(float linear) const
{
  const float c = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f; // NaN too
  int code = this->First[static_cast<int>(c * Steps)];
  while (c >= this->Begin[code + 1])
  {
    ++code;
  }
  return static_cast<unsigned char>(code);
}

}

// SPDX-License-Identifier: BSD-3-Clause
#ifndef HardCases_h
#define HardCases_h

#include "HardScene.h"

#include <functional>
#include <ostream>
#include <vector>

/// One row of the catalogue of what is hard to compute.
struct HardCase
{
  const char* name;
  const char* hard; ///< what is hard about it
  HardScene scene;
  /// What d of the first light is, where that is known; every sample with data is compared.
  std::function<double(int i, int j)> known;
  /// What the message says by which the heights are refused, or null.
  const char* refused = nullptr;
};

/// As GoogleTest names it.
inline void PrintTo(const HardCase& hardCase, std::ostream* os)
{
  *os << hardCase.name;
}

/// The catalogue: every method computes each row, and for each row all that HardSceneChecks.h says
/// must hold. A failing scene that the random ones find is pasted here.
const std::vector<HardCase>& HardCases();

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef AccuracyChart_h
#define AccuracyChart_h

#include "AccuracyTable.h"
#include "Drawing.h"

#include <string>

namespace reliefshade
{

/// Error against time, both logarithmic: more exact is down, quicker is left. `captions` are lines
/// below.
Drawing drawAccuracy(const AccuracyTable& table, const std::vector<std::string>& captions);

/// A drawing as an element of a page, whose style gives the colours of the classes paper, grid,
/// frame, words, exact, steps and mark.
std::string toSvg(const Drawing& drawing);

}

#endif

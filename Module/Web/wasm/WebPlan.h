// SPDX-License-Identifier: BSD-3-Clause
#ifndef WebPlan_h
#define WebPlan_h

/// @file
/// A scene for a host that has a graphics processor but not the model: its numbers as the model
/// takes them, and what is wanted of each light.

#include "WebScene.h"

#include <string>
#include <vector>

namespace relief::web
{

/// What a plan depends on of heights, besides their size and spacing: the least and the greatest,
/// before they are scaled. Where there are no data the least is the greater one.
struct WebRange
{
  double least = 0.0;
  double greatest = 0.0;
  bool floats = true; ///< heights are in single precision
};

/// The numbers of a plan, in the order in which plan.js reads them. Returns what is wrong. The
/// samples of `heights` are not looked at.
std::string PlanNumbers(const WebScene& scene, const WebHeights& heights, const WebRange& range,
  std::vector<double>& numbers);

}

#endif

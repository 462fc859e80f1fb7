// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightFrame_h
#define HeightFrame_h

#include <string>

namespace relief
{

/// What part of a plane is sampled, and how finely.
struct FrameRequest
{
  double bounds[4] = { 0, 0, 0, 0 }; ///< of what lies there: x from, to, y from, to
  double margin = 0.02;              ///< free around the bounds, as a part of their longer side
  bool hasFrame = false;             ///< whether `frame` counts instead of bounds and margin
  double frame[4] = { 0, 0, 0, 0 };  ///< as bounds are
  int dimensions[2] = { 0, 0 };      ///< samples along x and y, 0 for what resolution makes
  int resolution = 1024;             ///< samples along the longer side
};

/// Samples at the centers of the cells that a frame is divided into.
struct HeightFrame
{
  int columns = 0;
  int rows = 0;
  double first[2] = { 0.0, 0.0 }; ///< the first sample
  double spacing[2] = { 1.0, 1.0 };
};

/// Returns an empty text, or why there is no such frame. Around bounds cells are squares; those of
/// a given frame are what its dimensions make of them.
std::string FitHeightFrame(const FrameRequest& request, HeightFrame& result);

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef Verify_h
#define Verify_h

#include <string>

class vtkImageReliefShading;

namespace reliefshade
{

struct Options;
class TileShading;

/// Retraces samples of what was shaded by the reference, as the options want it, and prints what
/// came out. Returns it in words. `pieces` are those of heights that do not fit into memory, or
/// null. Throws a Failure if the illumination does not keep what is promised.
std::string verify(
  vtkImageReliefShading* shading, const Options& options, const TileShading* pieces, bool bar);

}

#endif

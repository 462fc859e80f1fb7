// SPDX-License-Identifier: BSD-3-Clause
#ifndef RunKey_h
#define RunKey_h

#include <string>

class vtkImageReliefShading;

namespace reliefshade
{

struct Options;

/// What a run's picture depends on, in lines that begin with what they are about: two runs of one
/// key shade the same. `heights` tells the heights. Throws a Failure for files that are not there.
std::string keyOfRun(
  const Options& options, const std::string& heights, vtkImageReliefShading* shading);

}

#endif

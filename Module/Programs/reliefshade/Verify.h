// SPDX-License-Identifier: BSD-3-Clause
#ifndef Verify_h
#define Verify_h

#include <string>

class vtkImageReliefShading;

namespace reliefshade
{

struct Options;

/// Retraces samples of what was shaded by the reference, as the options want it, and prints what
/// came out. Returns it in words. Throws a Failure if the illumination does not keep what is
/// promised.
std::string verify(vtkImageReliefShading* shading, const Options& options, bool bar);

}

#endif

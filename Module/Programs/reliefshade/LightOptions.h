// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightOptions_h
#define LightOptions_h

#include <cstddef>
#include <vector>

class vtkLight;

namespace reliefshade
{

class OptionParser;
struct Options;

/// Intensity and colour of a light from the numbers behind its `used` first ones.
void setPower(vtkLight* light, const std::vector<double>& numbers, std::size_t used);

/// Adds the options of lights and environment.
void addLightOptions(OptionParser& parser, Options& options);

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightScaling_h
#define HeightScaling_h

#include "RasterFiles.h"

#include <string>

class vtkReliefScene;

namespace reliefshade
{

/// Where the scale of heights comes from.
enum class HeightScaling
{
  Usual, ///< from the heights where they have no unit, else 1
  Given, ///< by an option or a scene's file
  Fitted ///< from the heights, whatever their unit
};

/// The scale, as --height-scale takes it, that makes a good first picture of heights that were
/// placed; 0 where there is nothing to scale.
double fittingHeightScale(const Raster& raster);

/// Gives a scene the height scale of a file's heights that were placed. `unit` tells whether they
/// are known to be lengths in the unit of their spacing. Returns what is to be told of it, in one
/// line; empty if there is nothing to tell.
std::string scaleHeights(
  HeightScaling scaling, bool unit, const Raster& raster, vtkReliefScene* scene);

/// Smooths the terraces of heights within half a step. What a sample takes for it is not claimed:
/// smoothedBytes. Throws a std::runtime_error.
void smoothSteps(Raster& raster);
constexpr double smoothedBytes = 30.0;

/// Whether heights are stored in so few steps that terraces show.
bool showsTerraces(const Raster& raster);

}

#endif

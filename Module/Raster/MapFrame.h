// SPDX-License-Identifier: BSD-3-Clause
#ifndef MapFrame_h
#define MapFrame_h

#include "Raster.h"

class vtkImageReliefShading;
class vtkReliefScene;

namespace relief::raster
{
/// Makes the raster what is shaded: its heights, its mask, and which height stands for no data.
VTKIORELIEFRASTER_EXPORT void SetHeights(const Raster& raster, vtkImageReliefShading* shading);

/// Between scenes as files and the command line have them, with lamps in coordinates of the map and
/// heights in the file's unit, and scenes in the frame of PlaceHeights().
class VTKIORELIEFRASTER_EXPORT MapFrame
{
public:
  MapFrame() = default;
  explicit MapFrame(const RasterHeader& raster);

  /// Takes lamps and height scale of a scene from the map to the heights' frame, or back.
  void ToHeights(vtkReliefScene* scene) const;
  void ToMap(vtkReliefScene* scene) const;

  /// One coordinate, x (0) or y (1), from the heights' frame to the map, and back. On the map it is
  /// rounded to a decimal number of about a millionth of a sample, so that it reads well and comes
  /// back as it was.
  double CoordinateToMap(int axis, double value) const;
  double CoordinateToHeights(int axis, double value) const;

private:
  std::array<double, 2> Origin{ 0.0, 0.0 };
  std::array<double, 2> Step{ 1.0, 1.0 };
  std::array<double, 2> Scale{ 1.0, 1.0 };
  double HeightUnit = 1.0;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef Field_h
#define Field_h

#include "MapFrame.h"
#include "RasterReader.h"

#include <string>

namespace reliefviewer
{

/// A height field that is ready to be shaded, and what the viewer wants to know of it.
struct Field
{
  reliefshade::Raster Heights;
  reliefshade::MapFrame Frame;
  /// Samples along x and y.
  std::array<int, 2> Samples{ 1, 1 };
  /// Of the samples that have data, in the values of the image; 0 if there are none.
  double Lowest = 0.0;
  double Highest = 0.0;
  double Mean = 0.0;

  /// Whether a sample, counted along rows, has a height.
  bool HasData(vtkIdType sample) const;
  /// The mean spacing, which is the automatic depth.
  double MeanSpacing() const { return 0.5 * (Heights.Spacing[0] + Heights.Spacing[1]); }
  /// From the first sample to the last along an axis.
  double Length(int axis) const { return (Samples[axis] - 1) * Heights.Spacing[axis]; }
  /// The height scale with which the heights span a tenth of the longer side; 0 for a flat relief.
  double FittingScale() const;
  /// The longer side, or a spacing for a single sample.
  double Size() const;
};

/// Reads a file as reliefshade does. Throws a Failure that names it.
Field readField(const std::string& file, const reliefshade::ReadOptions& options);

/// The same of heights that are there already.
Field makeField(reliefshade::Raster heights);

}

#endif

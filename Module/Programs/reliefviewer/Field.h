// SPDX-License-Identifier: BSD-3-Clause
#ifndef Field_h
#define Field_h

#include "RasterFiles.h"

#include <string>

namespace reliefviewer
{

/// A height field that is ready to be shaded, and what the viewer wants to know of it.
struct Field
{
  reliefshade::Raster Heights; ///< masked by all that there is
  reliefshade::MapFrame Frame;
  /// How the file was read.
  reliefshade::ReadOptions Reading;
  /// The file of a mask, and how it was read; empty if there is none.
  std::string MaskFile;
  reliefshade::ReadOptions MaskReading;
  /// The mask of the heights' own file; null if it has none.
  vtkSmartPointer<vtkImageData> OwnMask;
  /// Samples along x and y.
  std::array<int, 2> Samples{ 1, 1 };
  /// Of the samples that have data, in the values of the image; 0 if there are none.
  double Lowest = 0.0;
  double Highest = 0.0;
  double Mean = 0.0;
  /// The least coordinates of samples in the heights' frame: 0 unless the raster is turned.
  std::array<double, 2> Corner{ 0.0, 0.0 };
  /// How far the samples reach from there along x and y.
  std::array<double, 2> Reach{ 0.0, 0.0 };

  /// Whether a sample, counted along rows, has a height.
  bool HasData(vtkIdType sample) const;
  /// The mean spacing, which is the automatic depth.
  double MeanSpacing() const { return 0.5 * (Heights.Spacing[0] + Heights.Spacing[1]); }
  /// From the least to the greatest coordinate of samples along an axis.
  double Length(int axis) const { return Reach[axis]; }
  /// A coordinate at a share of that.
  double At(int axis, double share) const { return Corner[axis] + share * Reach[axis]; }
  /// The sample nearest to a place, counted along rows; -1 outside of all.
  vtkIdType SampleAt(double x, double y) const;
  /// The height scale that makes a good first picture, as reliefshade finds it; 0 for a flat
  /// relief.
  double FittingScale = 0.0;
  /// The height scale that the field has unless somebody chooses one: 1 where its heights have the
  /// unit of their spacing, or are flat.
  double UsualScale = 1.0;
  /// The longer side, or a spacing for a single sample.
  double Size() const;
};

/// Reads a file as reliefshade does. Throws a Failure that names it.
Field readField(const std::string& file, const reliefshade::ReadOptions& options);

/// The field, which `heights` names, with the mask of a file in place of any that it had. Throws a
/// Failure that names the file.
Field withMask(const Field& field, const std::string& heights, const std::string& file,
  const reliefshade::ReadOptions& options);

/// The field without the mask of a file.
Field withoutMask(const Field& field);

/// The same of heights that are there already.
Field makeField(reliefshade::Raster heights);

}

#endif

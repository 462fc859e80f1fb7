// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefGrid_h
#define ReliefGrid_h

/// @file
/// Which samples of a field a view needs. No OpenGL here.

namespace relief
{

/// The part of a field that can be seen, in samples: sample (i, j) covers [i, i + 1) x [j, j + 1).
struct VisiblePart
{
  bool any = false;
  double lo[2] = { 0.0, 0.0 };
  double hi[2] = { 0.0, 0.0 };
  double stride[2] = { 1.0, 1.0 }; ///< samples in a pixel, where it has fewest, along x and y
};

/// Finds it. `toClip` takes column vectors of sample coordinates (x, y, 0, 1) to clip coordinates,
/// row by row; `area` is the part of the field that is shown at all: x0, x1, y0, y1.
VisiblePart FindVisiblePart(
  const double toClip[16], const double area[4], const int viewportSize[2]);

/// A regular choice of a field's samples. Texel k stands for the samples in [k, k + 1) strides and
/// shades the middle one, so that grids of one stride hold the same samples wherever they begin.
struct ReliefGrid
{
  int first[2] = { 0, 0 };
  int size[2] = { 0, 0 };
  double stride[2] = { 1.0, 1.0 }; ///< at least 1

  bool operator==(const ReliefGrid& other) const;
  bool operator!=(const ReliefGrid& other) const { return !(*this == other); }
  bool IsEmpty() const { return this->size[0] < 1 || this->size[1] < 1; }
  /// Texels for a sample.
  double GetDetail() const { return 1.0 / (this->stride[0] * this->stride[1]); }
  double GetNumberOfTexels() const { return static_cast<double>(this->size[0]) * this->size[1]; }

  /// Whether the other grid's samples are among this one's.
  bool Holds(const ReliefGrid& other) const;

  /// Whether this grid reaches as far as the other, however coarse it is.
  bool Reaches(const ReliefGrid& other) const;

  /// The sample that a texel, counted from the first, shades.
  int SampleOf(int axis, int texel, int samples) const;
};

/// A grid over the visible part of a field of columns x rows samples, with a texel a pixel, or a
/// sample where these are larger, times `coarseness`, at least 1; coarser where it would have more
/// than maximumTexels texels, or more than maximumSize along a side. Strides are rounded down to
/// quarters of an octave, so that zooming does not change them all the time.
ReliefGrid MakeGrid(const VisiblePart& part, int columns, int rows, double coarseness,
  double maximumTexels, int maximumSize);

}

#endif

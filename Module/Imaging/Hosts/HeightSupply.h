// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightSupply_h
#define HeightSupply_h

/// @file
/// Where the heights of a raster come from of which only parts are in memory. Not installed.

#include "RasterBounds.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <limits>

namespace relief::hosts
{
/// What is known of all heights after a pass over them.
struct HeightSurvey
{
  ///@{
  /// The least and the greatest height, before any scale; the least is greater where none has data.
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();
  ///@}
  std::uint64_t hash = 0; ///< as HashHeights() has it
  ///@{
  /// The bounds of the heights as lengths, with this scale and above this datum.
  double scale = 1.0;
  double datum = 0.0;
  RasterBounds bounds;
  ///@}
};

/// A raster whose heights are read window by window.
class HeightSupply
{
public:
  /// Samples [i0, i1) x [j0, j1); row 0 is that of the least y.
  struct Window
  {
    int i0, i1, j0, j1;
  };

  /// Heights of a window, and what tells which of them are none, as HeightInputs has it.
  struct Part
  {
    vtkSmartPointer<vtkImageData> heights;
    vtkSmartPointer<vtkImageData> mask; ///< or null
    bool useNoData = false;
    double noData = 0.0;
  };

  virtual ~HeightSupply() = default;

  virtual int GetColumns() const = 0;
  virtual int GetRows() const = 0;

  /// How many bytes the numbers of a height and of its mask take.
  virtual int GetBytesPerSample() const = 0;

  /// Reads a window; from several threads at once. Throws a std::exception that tells what is
  /// wrong.
  virtual Part Read(const Window& window) = 0;

  /// Told how much of a pass over all heights is done, from 0 to 1. Throws what ends it.
  virtual void Advance(double share) = 0;

  ///@{
  /// Finds what an earlier run has kept of a pass with that scale, and keeps what this one has
  /// found. The first returns whether there is any that still holds; keeping may fail silently,
  /// since the next run would only take longer.
  virtual bool FindSurvey(double scale, HeightSurvey& survey) = 0;
  virtual void KeepSurvey(const HeightSurvey& survey) = 0;
  ///@}
};
}

#endif

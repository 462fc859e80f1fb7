// SPDX-License-Identifier: BSD-3-Clause
#ifndef BandShading_h
#define BandShading_h

#include "vtkImageData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <functional>
#include <string>

class vtkImageReliefShading;

namespace reliefshade
{

/// What was done in all of a run's bands.
struct ShadingReport
{
  std::string Effects;
  vtkTypeInt64 LightsTraced = 0;
  vtkTypeInt64 RaysTraced = 0;
  vtkTypeInt64 CellsVisited = 0;
  double Exposure = 0.0;
  double Seconds = 0.0;
  /// Pieces of which some heights are known by their bounds only, and what that took of the
  /// tolerance at most.
  vtkTypeInt64 PiecesByBounds = 0;
  double ToleranceTaken = 0.0;
};

/// Rows that are shaded at a time: enough that what is done once for all of them costs nothing, and
/// few enough that they take no memory that counts. Of a whole number of the filter's tiles and of
/// a TIFF's strips.
int rowsOfBand(int columns, double bytesPerSample);

/// A part of a run: where it begins and how long it is, both as shares of all.
struct RunPart
{
  double Begin = 0.0;
  double Length = 1.0;
};

/// Shades an extent and adds to the report what was done. Throws a Failure that names the file for
/// what the filter reports.
vtkSmartPointer<vtkImageData> shadePart(vtkImageReliefShading* shading, const std::string& file,
  const int extent[6], ShadingReport& report);

/// Shades all of the filter's input, some rows at a time from the upper ones on or, `upward`, from
/// the lower ones; 0 rows for all at once. Its progress is that of a part of the run. Each band is
/// handed to `take`, one after another, while the next is shaded; what that throws comes out.
/// Throws a Failure that names the file for what the filter reports.
ShadingReport shadeBands(vtkImageReliefShading* shading, const std::string& file, int rows,
  bool upward, const RunPart& part, const std::function<void(vtkImageData*)>& take);

}

#endif

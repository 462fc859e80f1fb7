// SPDX-License-Identifier: BSD-3-Clause
#include "BandShading.h"

#include "Failure.h"
#include "MessageLog.h"
#include "Taker.h"
#include "Watch.h"

#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkReliefStatistics.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <chrono>

namespace reliefshade
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> shadePart(vtkImageReliefShading* shading, const std::string& file,
  const int extent[6], ShadingReport& report)
{
  const auto start = std::chrono::steady_clock::now();
  shading->UpdateExtent(extent);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  stopIfInterrupted();
  if (hasError())
  {
    throw Failure(file, takeError());
  }
  vtkReliefStatistics* statistics = shading->GetStatistics();
  report.Effects = statistics->GetEffectNames();
  report.LightsTraced = std::max<vtkTypeInt64>(report.LightsTraced, statistics->GetLightsTraced());
  report.RaysTraced += statistics->GetRaysTraced();
  report.CellsVisited += statistics->GetCellsVisited();
  report.Exposure = statistics->GetExposure();
  report.Seconds += seconds.count();
  // The filter makes another array for the next.
  auto band = vtkSmartPointer<vtkImageData>::New();
  band->ShallowCopy(shading->GetOutput());
  return band;
}

//------------------------------------------------------------------------------
int rowsOfBand(int columns, double bytesPerSample)
{
  constexpr double most = 16.0 * 1024.0 * 1024.0;
  int rows = 16; // of a tile
  while (2.0 * rows * columns * bytesPerSample <= most)
  {
    rows *= 2;
  }
  return rows;
}

//------------------------------------------------------------------------------
ShadingReport shadeBands(vtkImageReliefShading* shading, const std::string& file, int rows,
  bool upward, const RunPart& part, const std::function<void(vtkImageData*)>& take)
{
  ShadingReport report;
  int extent[6];
  vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0))->GetExtent(extent);
  const int first = extent[2];
  const int count = extent[3] - first + 1;
  rows = rows > 0 ? std::min(rows, count) : count;
  const int bands = (count + rows - 1) / rows;
  if (bands == 1)
  {
    shading->SetProgressShiftScale(part.Begin, part.Length);
    take(shadePart(shading, file, extent, report));
    return report;
  }

  Taker taker(take);
  for (int k = 0; k < bands; ++k)
  {
    const int band = upward ? k : bands - 1 - k;
    extent[2] = first + band * rows;
    extent[3] = std::min(extent[2] + rows, first + count) - 1;
    shading->SetProgressShiftScale(part.Begin + part.Length * k / bands, part.Length / bands);
    taker.Give(shadePart(shading, file, extent, report));
  }
  taker.Finish();
  return report;
}

}

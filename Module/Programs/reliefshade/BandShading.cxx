// SPDX-License-Identifier: BSD-3-Clause
#include "BandShading.h"

#include "Failure.h"
#include "MessageLog.h"
#include "Watch.h"

#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkReliefStatistics.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace
{

using namespace reliefshade;

/// Runs a step over bands in a thread of its own. One is waiting at most.
class Taker
{
public:
  explicit Taker(const std::function<void(vtkImageData*)>& step)
    : Step(step)
    , Thread([this] { this->Run(); })
  {
  }

  /// Waits for what is under way; what is waiting is forgotten.
  ~Taker() { this->Join(false); }
  Taker(const Taker&) = delete;
  void operator=(const Taker&) = delete;

  /// Waits until there is room for another. Throws what the step has thrown.
  void Give(const vtkSmartPointer<vtkImageData>& band);

  /// Waits for all. Throws what the step has thrown.
  void Finish();

private:
  void Run();
  void Join(bool whole);

  const std::function<void(vtkImageData*)>& Step;
  std::mutex Mutex;
  std::condition_variable Changed;
  vtkSmartPointer<vtkImageData> Waiting;
  bool Ended = false;
  std::exception_ptr Thrown;
  std::thread Thread; // last: it uses the others
};

//------------------------------------------------------------------------------
void Taker::Run()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  for (;;)
  {
    this->Changed.wait(lock, [this] { return this->Waiting || this->Ended; });
    if (!this->Waiting)
    {
      return;
    }
    vtkSmartPointer<vtkImageData> band;
    std::swap(band, this->Waiting);
    this->Changed.notify_all();
    lock.unlock();
    std::exception_ptr thrown;
    try
    {
      this->Step(band);
    }
    catch (...)
    {
      thrown = std::current_exception();
    }
    band = nullptr;
    lock.lock();
    if (thrown)
    {
      this->Thrown = thrown;
      this->Ended = true;
      this->Changed.notify_all();
      return;
    }
  }
}

//------------------------------------------------------------------------------
void Taker::Give(const vtkSmartPointer<vtkImageData>& band)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->Changed.wait(lock, [this] { return !this->Waiting || this->Thrown; });
  if (this->Thrown)
  {
    std::rethrow_exception(this->Thrown);
  }
  this->Waiting = band;
  this->Changed.notify_all();
}

//------------------------------------------------------------------------------
void Taker::Join(bool whole)
{
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Waiting = whole ? this->Waiting : nullptr;
    this->Ended = true;
    this->Changed.notify_all();
  }
  if (this->Thread.joinable())
  {
    this->Thread.join();
  }
}

//------------------------------------------------------------------------------
void Taker::Finish()
{
  this->Join(true);
  if (this->Thrown)
  {
    std::rethrow_exception(this->Thrown);
  }
}

//------------------------------------------------------------------------------
/// Shades rows and adds to the report what was done.
vtkSmartPointer<vtkImageData> shadeBand(vtkImageReliefShading* shading, const std::string& file,
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

}

namespace reliefshade
{

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
    take(shadeBand(shading, file, extent, report));
    return report;
  }

  Taker taker(take);
  for (int k = 0; k < bands; ++k)
  {
    const int band = upward ? k : bands - 1 - k;
    extent[2] = first + band * rows;
    extent[3] = std::min(extent[2] + rows, first + count) - 1;
    shading->SetProgressShiftScale(part.Begin + part.Length * k / bands, part.Length / bands);
    taker.Give(shadeBand(shading, file, extent, report));
  }
  taker.Finish();
  return report;
}

}

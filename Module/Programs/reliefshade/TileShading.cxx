// SPDX-License-Identifier: BSD-3-Clause
#include "TileShading.h"

#include "Failure.h"
#include "MessageLog.h"
#include "Options.h"
#include "OutputNames.h"
#include "Outputs.h"
#include "PictureChoice.h"
#include "PictureOutput.h"
#include "PiecePlan.h"
#include "Ranks.h"
#include "RunKey.h"
#include "Taker.h"
#include "TileStore.h"
#include "TiledHeights.h"
#include "TiledRaster.h"
#include "Watch.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageReliefShading.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <locale>
#include <sstream>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace
{

using namespace reliefshade;
using relief::hosts::TiledHeights;
using relief::raster::TiledRaster;
using relief::streaming::BoundsBytes;

constexpr double MiB = 1024.0 * 1024.0;

//------------------------------------------------------------------------------
/// The memory that a run may take; 0 for any.
double memoryOf(const Options& options)
{
  return options.Memory > 0.0 ? options.Memory : options.MemoryLimit / countRanks();
}

//------------------------------------------------------------------------------
/// What needs all heights, or all of the picture, at once; empty for nothing.
std::string optionOfWholes(const Options& options)
{
  return options.SmoothSteps          ? "--smooth-steps"
    : options.Sculpted.Relief         ? "--relief"
    : !options.AccuracyReport.empty() ? "--accuracy-report"
                                      : "";
}

//------------------------------------------------------------------------------
/// The file that the folder of pieces lies beside; without any, the heights.
const std::string& firstOutput(const Options& options)
{
  for (const std::string* file : { &options.Output, &options.LayersFile, &options.ShadowMask })
  {
    if (!file->empty())
    {
      return *file;
    }
  }
  return options.Input;
}

//------------------------------------------------------------------------------
/// What runs that were killed have left of the outputs: this one has the folder of the pieces, so
/// none of them goes on.
void removeUnfinished(const Options& options)
{
  std::vector<std::string> files{ options.Output, options.LayersFile, options.ShadowMask };
  if (options.LayersFile.empty())
  {
    for (const std::string& layer : options.Layers)
    {
      files.push_back(layerFile(options.Output, layer));
    }
  }
  for (const std::string& file : files)
  {
    if (!file.empty())
    {
      relief::streaming::RunFolder::RemoveUnfinished(file);
    }
  }
}

//------------------------------------------------------------------------------
/// Windows of heights come and go, each of about the size of the last: their memory is not given
/// back between them, which would cost as much as reading them.
void keepFreedMemory()
{
#ifdef __GLIBC__
  constexpr int most = 32 * 1024 * 1024; // that it takes
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, 4 * most);
#endif
}

//------------------------------------------------------------------------------
/// As --memory takes it.
std::string inMebibytes(double bytes)
{
  return std::to_string(static_cast<long long>(std::ceil(bytes / MiB))) + "M";
}

//------------------------------------------------------------------------------
std::unique_ptr<TiledRaster> openTiled(const std::string& file, const ReadOptions& reading)
{
  return std::make_unique<TiledRaster>(
    file, reading, [file, reading] { return openRaster(file, reading); });
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
std::string memoryKey(const Options& options)
{
  return options.BoundsBeyondMemory
    ? "heights by bounds: of " + std::to_string(static_cast<long long>(memoryOf(options))) + "\n"
    : "";
}

//------------------------------------------------------------------------------
bool readsAsNeeded(const Options& options, const ReadOptions& reading,
  std::unique_ptr<relief::raster::RasterFile>& opened)
{
  // With a limit that was given, and nothing else, what needs more is refused.
  const bool may = options.Memory > 0.0 || !options.MemoryLimitGiven;
  if (!may || !(memoryOf(options) > 0.0) || options.Sculpted.Green || isMesh(options.Input))
  {
    return false;
  }
  double samples = 0.0;
  double besides = 0.0;
  bool windows = false;
  int stored = 0;
  aboutFile(options.Input,
    [&]
    {
      try
      {
        opened = openRaster(options.Input, reading);
        const relief::raster::RasterHeader& header = opened->GetHeader();
        samples = 1.0 * header.Columns * header.Rows;
        stored = vtkDataArray::GetDataTypeSize(std::max(header.ScalarType, 1));
        windows = opened->HasWindows();
        besides = opened->GetReadingBytes();
      }
      catch (const relief::raster::OptionFailure&)
      {
        return; // reading tells it
      }
    });
  // In pieces the bounds stay in memory, and pictures of formats that are written as a whole.
  const bool tiff = options.Output.empty() || isGeoTiff(options.Output);
  const bool exr = lowerExtension(options.Output) == ".exr";
  const double bytes = stored + bytesPerSample(options) + (tiff ? 0.0 : exr ? 16.0 : 4.0);
  const double kept = samples * (BoundsBytes + (tiff || exr ? 0.0 : 4.0));
  if (!windows && countRanks() > 1)
  {
    throw Failure(options.Input,
      "its format is read as a whole, and not by several processes; gdal_translate makes a GeoTIFF "
      "of it");
  }
  if (!windows || (samples * bytes + besides <= memoryOf(options) && countRanks() < 2))
  {
    return false;
  }
  if (kept > 0.5 * memoryOf(options))
  {
    if (options.Memory > 0.0)
    {
      throw Failure("--memory",
        "what has to be kept of all samples takes about " +
          std::to_string(static_cast<long long>(std::ceil(kept / MiB))) +
          " MiB; give twice as much" +
          (tiff || exr ? "" : ", or write TIFF or OpenEXR, which are not kept"));
    }
    return false; // and is refused
  }
  const std::string whole = optionOfWholes(options);
  if (!whole.empty())
  {
    throw Failure(whole,
      "it needs all heights in memory, about " +
        std::to_string(static_cast<long long>(std::ceil(samples * bytes / MiB))) +
        " MiB; leave it out, or give as much by --memory");
  }
  return true;
}

//------------------------------------------------------------------------------
Raster readAsNeeded(const Options& options)
{
  Raster raster;
  std::shared_ptr<TiledRaster> file;
  aboutFile(options.Input, [&] { file = openTiled(options.Input, options.Reading); });
  if (!options.Mask.empty())
  {
    aboutFile(options.Mask, [&] { file->SetMask(openTiled(options.Mask, ReadOptions())); });
  }
  file->SetWatcher(
    [bar = showsBar(options)](double share)
    {
      showProgress(bar, "reading", share);
      return !interrupted();
    });
  TiledRaster::LimitDecoding(memoryOf(options) / 8.0);
  keepFreedMemory();
  ranks().FirstAhead(
    [&]
    {
      aboutFile(options.Input,
        [&]
        {
          // As the scene will have it when it is in the frame of the heights.
          const double scale = options.Scene->GetHeightScale() * file->GetHeader().HeightUnit;
          raster = relief::raster::ReadTiled(file, scale);
        });
    });
  return raster;
}

//------------------------------------------------------------------------------
bool isTiled(const Raster& raster)
{
  return TiledHeights::SafeDownCast(raster.Heights->GetPointData()->GetScalars()) != nullptr;
}

//------------------------------------------------------------------------------
TileShading::TileShading(
  const Options& options, const Raster& raster, vtkImageReliefShading* shading, double sampleBytes)
  : Given(options)
  , Heights(raster)
  , Shading(shading)
{
  this->Arrays = relief::streaming::ArraysOf(shading);
  // Where the file of layers takes its colour from the picture, all of it is kept.
  const bool shared = !options.LayersFile.empty() && outputType(options) == VTK_FLOAT;
  if (isGeoTiff(options.Output) && !shared)
  {
    this->Form = formOfOutput(options, relief::raster::LacksData(raster));
  }
  this->Cut(sampleBytes);
  const std::string folder = firstOutput(options) + ".parts";
  using relief::streaming::RunFolder;
  ranks().FirstAhead(
    [&]
    {
      aboutFile(folder,
        [&]
        {
          this->Store = std::make_unique<relief::streaming::TileStore>(
            folder, this->GetKey(), ranks().GetRank() == 0 ? RunFolder::Alone : RunFolder::Joined);
        });
    });
  if (ranks().GetRank() == 0)
  {
    removeUnfinished(this->Given);
  }
}

//------------------------------------------------------------------------------
TileShading::~TileShading() = default;

//------------------------------------------------------------------------------
/// What the largest of the pieces takes.
double TileShading::LargestOf(double sampleBytes) const
{
  const double largest = this->Plan->FindLargest(this->Shading, sampleBytes);
  if (hasError())
  {
    throw Failure(this->Given.Input, takeError());
  }
  return largest;
}

//------------------------------------------------------------------------------
void TileShading::Cut(double sampleBytes)
{
  const int whole[6] = { 0, this->Heights.Columns - 1, 0, this->Heights.Rows - 1, 0, 0 };
  this->Shading->SetHeightMemoryLimit(VTK_DOUBLE_MAX);
  this->Plan = std::make_unique<relief::streaming::PiecePlan>(
    this->Shading, whole, memoryOf(this->Given), sampleBytes);
  if (hasError())
  {
    throw Failure(this->Given.Input, takeError());
  }
  if (!this->Plan->Fits())
  {
    this->LeaveOut(sampleBytes);
  }
}

//------------------------------------------------------------------------------
/// Even the least pieces do not fit: of their heights some are left out, or the run is refused.
void TileShading::LeaveOut(double sampleBytes)
{
  const relief::streaming::PiecePlan& plan = *this->Plan;
  double largest = this->LargestOf(sampleBytes);
  const double wanted = plan.MemoryFor(largest);
  if (this->Given.BoundsBeyondMemory)
  {
    const double room = plan.GetRoom() - 2.0 * sampleBytes * plan.GetColumns() * plan.GetRows();
    this->Shading->SetHeightMemoryLimit(std::max(std::floor(room / 1024.0), 0.0));
    this->Shading->SetBeyondMemoryToBounds();
    this->Wanted = wanted;
    largest = this->LargestOf(sampleBytes);
    if (largest <= plan.GetRoom())
    {
      return;
    }
  }
  throw Failure("--memory",
    "the least piece, " + std::to_string(plan.GetColumns()) + " x " +
      std::to_string(plan.GetRows()) + " samples, depends on heights that take more" +
      (this->Given.BoundsBeyondMemory ? ", of which none can be left out" : "") +
      "; give at least " + inMebibytes(plan.MemoryFor(largest)) +
      (this->Given.BoundsBeyondMemory ? "" : ", or --beyond-memory bounds"));
}

//------------------------------------------------------------------------------
const std::vector<TileShading::Extent>& TileShading::GetPieces() const
{
  return this->Plan->GetPieces();
}

//------------------------------------------------------------------------------
std::string TileShading::GetKey() const
{
  auto* heights = TiledHeights::SafeDownCast(this->Heights.Heights->GetPointData()->GetScalars());
  auto& file = static_cast<TiledRaster&>(heights->GetSupply());
  std::string arrays;
  for (const std::string& array : this->Arrays)
  {
    arrays += " " + array;
  }
  const std::string state = file.GetState() + " all " + std::to_string(heights->Survey().hash);
  return keyOfRun(this->Given, state, this->Shading) + "arrays:" + arrays +
    (this->Form && !this->Form->ByValue
        ? " of " + std::to_string(this->Form->GetComponents()) + " components"
        : "") +
    "\npieces: " + std::to_string(this->Plan->GetColumns()) + " x " +
    std::to_string(this->Plan->GetRows()) + "\n" +
    (this->Wanted > 0.0 ? "heights by bounds: beyond " +
          std::to_string(static_cast<long long>(this->Shading->GetHeightMemoryLimit())) + " KiB\n"
                        : "");
}

//------------------------------------------------------------------------------
std::vector<TileShading::Extent> TileShading::Missing() const
{
  std::vector<Extent> missing;
  std::copy_if(this->GetPieces().begin(), this->GetPieces().end(), std::back_inserter(missing),
    [this](const Extent& piece) { return !this->Store->Has(piece.data()); });
  return missing;
}

//------------------------------------------------------------------------------
void TileShading::ShadeShare(const RunPart& part, ShadingReport& report)
{
  std::vector<Extent> missing;
  ranks().Together([&] { missing = this->Missing(); });
  ranks().Together(
    [&]
    {
      const std::function<void(vtkImageData*)> save = [this](vtkImageData* piece)
      { aboutFile(this->Store->GetFolder(), [&] { this->Store->Save(piece); }); };
      const std::vector<Extent> share =
        relief::streaming::ShareOf(this->Shading, missing, ranks().GetRank(), ranks().GetCount());
      // What was there before counts as done.
      const auto left =
        static_cast<double>(missing.size()) / static_cast<double>(this->GetPieces().size());
      const double each = left / static_cast<double>(std::max<std::size_t>(share.size(), 1));
      double at = 1.0 - left;
      Taker taker(save);
      for (const Extent& piece : share)
      {
        this->Shading->SetProgressShiftScale(part.Begin + part.Length * at, part.Length * each);
        taker.Give(this->ShadePiece(piece, report));
        at += each;
      }
      taker.Finish();
    });
}

//------------------------------------------------------------------------------
/// A piece as it is kept: grey pictures take a quarter of what the filter makes of them. What it
/// has of heights that are known by their bounds only is kept with it, for who writes them all.
vtkSmartPointer<vtkImageData> TileShading::ShadePiece(
  const Extent& extent, ShadingReport& report) const
{
  vtkReliefStatistics* statistics = this->Shading->GetStatistics();
  vtkSmartPointer<vtkImageData> piece;
  try
  {
    piece = shadePart(this->Shading, this->Given.Input, extent.data(), report);
  }
  catch (const Failure&)
  {
    const double taken = statistics->GetToleranceTaken();
    if (!(this->Wanted > 0.0) || taken <= this->Given.Scene->GetTolerance())
    {
      throw;
    }
    const std::string memory = "give --memory " + inMebibytes(this->Wanted);
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(4);
    text << "of the piece " << extent[0] << "-" << extent[1] << "_" << extent[2] << "-"
         << extent[3];
    if (std::isinf(taken))
    {
      text << " layers or fixed steps, which know no tolerance, depend on heights beyond; "
           << memory;
    }
    else
    {
      text << " illuminations are uncertain by " << taken << "; " << memory << ", or --tolerance "
           << 1.001 * taken; // whatever is rounded
    }
    throw Failure("--beyond-memory", text.str());
  }
  if (this->Form)
  {
    piece = packPicture(piece, *this->Form);
  }
  piece->GetFieldData()->Initialize();
  if (statistics->GetRegionsLeftOut() > 0)
  {
    vtkNew<vtkDoubleArray> note;
    note->SetName(relief::streaming::TileStore::Note);
    note->InsertNextValue(statistics->GetToleranceTaken());
    piece->GetFieldData()->AddArray(note);
  }
  return piece;
}

//------------------------------------------------------------------------------
/// A piece from the disk. One that is damaged is shaded again.
vtkSmartPointer<vtkImageData> TileShading::Load(
  const Extent& piece, const std::vector<std::string>& arrays, ShadingReport& report) const
{
  vtkSmartPointer<vtkImageData> loaded;
  try
  {
    loaded = this->Store->Load(piece.data(), arrays);
  }
  catch (const relief::streaming::TileDamaged& damage)
  {
    if (!this->Given.Quiet)
    {
      say("warning: " + std::string(damage.what()) + "; it is shaded again");
    }
  }
  if (!loaded)
  {
    loaded = this->ShadePiece(piece, report);
    this->Store->Save(loaded);
  }
  if (vtkDataArray* note = loaded->GetFieldData()->GetArray(relief::streaming::TileStore::Note))
  {
    ++report.PiecesByBounds;
    report.ToleranceTaken = std::max(report.ToleranceTaken, note->GetTuple1(0));
  }
  return loaded;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> TileShading::LoadLayer(
  const int extent[6], const std::string& name) const
{
  Extent piece;
  std::copy_n(extent, 6, piece.begin());
  ShadingReport report; // of what is damaged
  vtkSmartPointer<vtkImageData> loaded;
  aboutFile(this->Store->GetFolder(), [&] { loaded = this->Load(piece, { name }, report); });
  return loaded;
}

//------------------------------------------------------------------------------
void TileShading::HandOver(
  bool upward, ShadingReport& report, const std::function<void(vtkImageData*)>& take) const
{
  const int bands = this->Plan->GetNumberOfBands();
  for (int k = 0; k < bands; ++k)
  {
    stopIfInterrupted();
    take(this->Plan->LoadBand(upward ? k : bands - 1 - k, this->Arrays,
      [&](const Extent& piece) { return this->Load(piece, this->Arrays, report); }));
    showProgress(showsBar(this->Given), "writing", (k + 1.0) / bands);
  }
}

//------------------------------------------------------------------------------
void TileShading::Finish()
{
  aboutFile(this->Store->GetFolder(), [this] { this->Store->Remove(); });
}

}

// SPDX-License-Identifier: BSD-3-Clause
#include "TileShading.h"

#include "Failure.h"
#include "MessageLog.h"
#include "Options.h"
#include "Outputs.h"
#include "PictureChoice.h"
#include "PictureOutput.h"
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
#include <cstring>
#include <iterator>
#include <limits>
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

constexpr double MiB = 1024.0 * 1024.0;
/// What is known of all heights takes, for a sample.
constexpr double BoundsBytes = 0.007;
/// Of the memory that a run may take, what pieces and these bounds may.
constexpr double MemoryShare = 0.7;

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
    : options.VerifiedSamples > 0     ? "--verify"
    : !options.AccuracyReport.empty() ? "--accuracy-report"
    : !options.LayersFile.empty()     ? "--layers FILE.exr"
                                      : "";
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
  if (!windows || (samples * bytes <= memoryOf(options) && countRanks() < 2))
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
  this->Arrays = { "Shading" };
  const std::pair<bool, const char*> layers[] = { { shading->GetGenerateIllumination(),
                                                    "Illumination" },
    { shading->GetGenerateThickness(), "Thickness" }, { shading->GetGenerateShadow(), "Shadow" },
    { shading->GetGenerateNormals(), "Normals" }, { shading->GetGenerateBase(), "Base" },
    { shading->GetGenerateDiffuse(), "Diffuse" }, { shading->GetGenerateScatter(), "Scatter" },
    { shading->GetGenerateSpecular(), "Specular" } };
  for (const auto& [on, name] : layers)
  {
    if (on)
    {
      this->Arrays.emplace_back(name);
    }
  }
  if (isGeoTiff(options.Output))
  {
    this->Form = formOfOutput(options, relief::raster::LacksData(raster));
  }
  this->Cut(sampleBytes);
  const std::string folder =
    (options.Output.empty() ? options.ShadowMask : options.Output) + ".parts";
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
}

//------------------------------------------------------------------------------
TileShading::~TileShading() = default;

//------------------------------------------------------------------------------
std::vector<TileShading::Extent> TileShading::PiecesOf(int columns, int rows) const
{
  std::vector<Extent> pieces;
  for (int j = 0; j < this->Heights.Rows; j += rows)
  {
    for (int i = 0; i < this->Heights.Columns; i += columns)
    {
      pieces.push_back({ i, std::min(i + columns, this->Heights.Columns) - 1, j,
        std::min(j + rows, this->Heights.Rows) - 1, 0, 0 });
    }
  }
  return pieces;
}

//------------------------------------------------------------------------------
/// What is in memory while a piece is shaded and the one before is saved.
double TileShading::BytesOf(const Extent& piece, double sampleBytes) const
{
  const double samples = (piece[1] - piece[0] + 1.0) * (piece[3] - piece[2] + 1.0);
  return 1024.0 * this->Shading->EstimateMemory(piece.data()) + 2.0 * sampleBytes * samples;
}

//------------------------------------------------------------------------------
/// What a run may take must be for pieces that take so many bytes.
double TileShading::MemoryFor(double bytes) const
{
  return (bytes + BoundsBytes * this->Heights.Columns * this->Heights.Rows) / MemoryShare;
}

//------------------------------------------------------------------------------
/// Bands as high as fit; where the lowest does not, its pieces are narrower.
void TileShading::Cut(double sampleBytes)
{
  constexpr int region = relief::RasterBounds::RegionSize;
  // Runs of few pieces lose more when they are stopped, and are shared out badly.
  constexpr int usualPieces = 64;
  const int most = region * std::clamp(this->Heights.Rows / usualPieces / region, 1, 16);
  const int width = (this->Heights.Columns + region - 1) / region * region;
  // The rest is for the program itself, the bounds of all heights, and what files are read through.
  const double samples = 1.0 * this->Heights.Columns * this->Heights.Rows;
  const double memory = MemoryShare * memoryOf(this->Given) - BoundsBytes * samples;
  this->Columns = width;
  this->Rows = most;
  this->Shading->SetHeightMemoryLimit(VTK_DOUBLE_MAX);
  for (;;)
  {
    this->Pieces = this->PiecesOf(this->Columns, this->Rows);
    if (this->LargestOf(sampleBytes, memory) <= memory)
    {
      return;
    }
    if (this->Rows > region)
    {
      this->Rows /= 2;
    }
    else if (this->Columns > 4 * region)
    {
      this->Columns = (this->Columns / 2 + region - 1) / region * region;
    }
    else
    {
      break;
    }
  }
  this->LeaveOut(memory, sampleBytes);
}

//------------------------------------------------------------------------------
/// What the largest of the pieces takes, or the first that takes more than is enough to know.
double TileShading::LargestOf(double sampleBytes, double enough) const
{
  double largest = 0.0;
  for (std::size_t k = 0; k < this->Pieces.size() && largest <= enough; ++k)
  {
    largest = std::max(largest, this->BytesOf(this->Pieces[k], sampleBytes));
  }
  if (hasError())
  {
    throw Failure(this->Given.Input, takeError());
  }
  return largest;
}

//------------------------------------------------------------------------------
/// Even the least pieces do not fit: of their heights some are left out, or the run is refused.
void TileShading::LeaveOut(double memory, double sampleBytes)
{
  constexpr double any = std::numeric_limits<double>::infinity();
  double largest = this->LargestOf(sampleBytes, any);
  const double wanted = this->MemoryFor(largest);
  if (this->Given.BoundsBeyondMemory)
  {
    const double room = memory - 2.0 * sampleBytes * this->Columns * this->Rows;
    this->Shading->SetHeightMemoryLimit(std::max(std::floor(room / 1024.0), 0.0));
    this->Shading->SetBeyondMemoryToBounds();
    this->Wanted = wanted;
    largest = this->LargestOf(sampleBytes, any);
    if (largest <= memory)
    {
      return;
    }
  }
  throw Failure("--memory",
    "the least piece, " + std::to_string(this->Columns) + " x " + std::to_string(this->Rows) +
      " samples, depends on heights that take more" +
      (this->Given.BoundsBeyondMemory ? ", of which none can be left out" : "") +
      "; give at least " + inMebibytes(this->MemoryFor(largest)));
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
  return keyOfRun(this->Given, file.GetState(), this->Shading) + "arrays:" + arrays +
    (this->Form && !this->Form->ByValue
        ? " of " + std::to_string(this->Form->GetComponents()) + " components"
        : "") +
    "\npieces: " + std::to_string(this->Columns) + " x " + std::to_string(this->Rows) + "\n" +
    (this->Wanted > 0.0 ? "heights by bounds: beyond " +
          std::to_string(static_cast<long long>(this->Shading->GetHeightMemoryLimit())) + " KiB\n"
                        : "");
}

//------------------------------------------------------------------------------
std::vector<TileShading::Extent> TileShading::Missing() const
{
  std::vector<Extent> missing;
  std::copy_if(this->Pieces.begin(), this->Pieces.end(), std::back_inserter(missing),
    [this](const Extent& piece) { return !this->Store->Has(piece.data()); });
  return missing;
}

//------------------------------------------------------------------------------
/// Those of this process: neighbours, which have heights in common, of about as much work as the
/// others'.
std::vector<TileShading::Extent> TileShading::ShareOf(const std::vector<Extent>& pieces) const
{
  const int count = ranks().GetCount();
  if (count < 2)
  {
    return pieces;
  }
  std::vector<double> ends; // of their work, one after another
  double sum = 0.0;
  for (const Extent& piece : pieces)
  {
    sum += this->Shading->EstimateWork(piece.data());
    ends.push_back(sum);
  }
  std::vector<Extent> share;
  double begin = 0.0;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const double middle = 0.5 * (begin + ends[k]);
    begin = ends[k];
    if (std::min(static_cast<int>(middle / sum * count), count - 1) == ranks().GetRank())
    {
      share.push_back(pieces[k]);
    }
  }
  return share;
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
      const std::vector<Extent> share = this->ShareOf(missing);
      // What was there before counts as done.
      const auto left =
        static_cast<double>(missing.size()) / static_cast<double>(this->Pieces.size());
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
vtkSmartPointer<vtkImageData> TileShading::Load(const Extent& piece, ShadingReport& report) const
{
  vtkSmartPointer<vtkImageData> loaded;
  try
  {
    loaded = this->Store->Load(piece.data(), this->Arrays);
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
/// A band of all columns, put together of its pieces.
vtkSmartPointer<vtkImageData> TileShading::LoadBand(int firstRow, ShadingReport& report) const
{
  auto band = vtkSmartPointer<vtkImageData>::New();
  for (const Extent& extent : this->Pieces)
  {
    if (extent[2] != firstRow)
    {
      continue;
    }
    const vtkSmartPointer<vtkImageData> piece = this->Load(extent, report);
    if (this->Columns >= this->Heights.Columns)
    {
      return piece;
    }
    if (band->GetNumberOfPoints() == 0)
    {
      this->MakeRoom(piece, band);
    }
    for (const std::string& name : this->Arrays)
    {
      vtkDataArray* from = piece->GetPointData()->GetArray(name.c_str());
      vtkDataArray* to = band->GetPointData()->GetArray(name.c_str());
      const int components = from->GetNumberOfComponents();
      const vtkIdType width = extent[1] - extent[0] + 1;
      const std::size_t bytes =
        static_cast<std::size_t>(width) * components * from->GetDataTypeSize();
      for (vtkIdType j = 0; j <= extent[3] - extent[2]; ++j)
      {
        std::memcpy(to->GetVoidPointer((j * this->Heights.Columns + extent[0]) * components),
          from->GetVoidPointer(j * width * components), bytes);
      }
    }
  }
  return band;
}

//------------------------------------------------------------------------------
/// Makes a band of arrays as a piece has them.
void TileShading::MakeRoom(vtkImageData* piece, vtkImageData* band) const
{
  const int* extent = piece->GetExtent();
  band->SetExtent(0, this->Heights.Columns - 1, extent[2], extent[3], 0, 0);
  for (const std::string& name : this->Arrays)
  {
    vtkDataArray* values = piece->GetPointData()->GetArray(name.c_str());
    const auto all = vtkSmartPointer<vtkDataArray>::Take(values->NewInstance());
    all->SetName(name.c_str());
    all->SetNumberOfComponents(values->GetNumberOfComponents());
    all->SetNumberOfTuples(band->GetNumberOfPoints());
    band->GetPointData()->AddArray(all);
  }
  band->GetPointData()->SetActiveScalars(this->Arrays.front().c_str());
}

//------------------------------------------------------------------------------
ShadingReport TileShading::Shade(
  bool upward, const RunPart& part, const std::function<void(vtkImageData*)>& take)
{
  ShadingReport report;
  this->ShadeShare({ part.Begin, 0.9 * part.Length }, report);
  const int bands = (this->Heights.Rows + this->Rows - 1) / this->Rows;
  for (int k = 0; k < bands; ++k)
  {
    stopIfInterrupted();
    take(this->LoadBand((upward ? k : bands - 1 - k) * this->Rows, report));
    showProgress(showsBar(this->Given), "writing", (k + 1.0) / bands);
  }
  return report;
}

//------------------------------------------------------------------------------
void TileShading::Finish()
{
  aboutFile(this->Store->GetFolder(), [this] { this->Store->Remove(); });
}

}

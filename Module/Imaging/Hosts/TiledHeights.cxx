// SPDX-License-Identifier: BSD-3-Clause
#include "TiledHeights.h"

#include "HeightFit.h"
#include "HeightHash.h"
#include "HeightInputs.h"
#include "HeightReader.h"
#include "HeightRows.h"
#include "vtkReliefThreads.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkScalarsToColors.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

namespace relief::hosts
{
namespace
{
constexpr int RegionSize = RasterBounds::RegionSize;
constexpr double Unit[2] = { 1.0, 1.0 };

//------------------------------------------------------------------------------
/// Least and greatest height of a row in double, before any scale. `lengths` are the same row,
/// scaled and above the datum, which for float may be none.
template <class T>
void AddRow(const HeightSource<T>& heights, int j, const float* lengths, double datum,
  std::vector<double>& row, double ends[2])
{
  if (std::is_same_v<T, float> && heights.scale == 1.0 && datum == 0.0)
  {
    float lo = std::numeric_limits<float>::infinity();
    float hi = -lo;
    AddToRange(lengths, heights.columns, lo, hi);
    ends[0] = std::min<double>(ends[0], lo);
    ends[1] = std::max<double>(ends[1], hi);
    return;
  }
  HeightSource<T> plain = heights;
  plain.scale = 1.0;
  row.resize(static_cast<std::size_t>(heights.columns));
  HeightReader<T>(plain).Read(j, 0.0, row.data());
  for (const double height : row)
  {
    ends[0] = height < ends[0] ? height : ends[0];
    ends[1] = height > ends[1] ? height : ends[1];
  }
}

//------------------------------------------------------------------------------
std::string LimitMessage(double bytes, const TiledHeights::Limit& limit)
{
  const auto kibibytes = [](double number)
  { return std::to_string(static_cast<long long>(number)); };
  return "the extent depends on heights that take " + kibibytes(std::ceil(bytes / 1024.0)) +
    " KiB, HeightMemoryLimit is " + kibibytes(limit.bytes / 1024.0) + "; raise it, ask for less" +
    (limit.leavesOut ? "" : ", or SetBeyondMemoryToBounds()");
}

//------------------------------------------------------------------------------
/// Rows of a raster, the last few that were asked for.
class RowCache
{
public:
  explicit RowCache(HeightSupply& supply)
    : Supply(supply)
  {
  }

  bool Read(int i, int j, double& height)
  {
    auto row = this->Rows.find(j);
    if (row == this->Rows.end())
    {
      if (this->Rows.size() >= Most)
      {
        this->Rows.clear();
      }
      row = this->Rows.emplace(j, std::vector<double>()).first;
      const HeightSupply::Part part = this->Supply.Read({ 0, this->Supply.GetColumns(), j, j + 1 });
      WithHeightSource(InputsOf(part, 1.0), Unit,
        [&](const auto& heights)
        {
          row->second.resize(static_cast<std::size_t>(heights.columns));
          HeightReader(heights).Read(0, 0.0, row->second.data());
        });
    }
    height = row->second[static_cast<std::size_t>(i)];
    return height == height;
  }

private:
  static constexpr std::size_t Most = 8;
  HeightSupply& Supply;
  std::map<int, std::vector<double>> Rows;
};
}

vtkStandardNewMacro(TiledHeights);

//------------------------------------------------------------------------------
HeightInputs InputsOf(const HeightSupply::Part& part, double scale)
{
  HeightInputs inputs;
  inputs.image = part.heights;
  inputs.scalars = part.heights->GetPointData()->GetScalars();
  inputs.mask = part.mask;
  inputs.maskScalars = part.mask ? part.mask->GetPointData()->GetScalars() : nullptr;
  inputs.scale = scale;
  inputs.useNoData = part.useNoData;
  inputs.noData = part.noData;
  return inputs;
}

//------------------------------------------------------------------------------
TiledHeights::TiledHeights() = default;
TiledHeights::~TiledHeights() = default;

//------------------------------------------------------------------------------
void TiledHeights::SetSupply(std::shared_ptr<HeightSupply> supply)
{
  this->Supply = std::move(supply);
  this->Found.reset();
  this->Sparse.reset();
  this->Prepared.reset();
  this->Regions.reset();
  this->Copy.clear();
  this->Size = vtkIdType(this->Supply->GetColumns()) * this->Supply->GetRows();
  this->MaxId = this->Size - 1;
  this->Modified();
}

//------------------------------------------------------------------------------
std::unique_ptr<HeightSurvey> TiledHeights::MakeSurvey(double scale, double datum) const
{
  // Some rows on each thread at a time, then all of these in their order.
  const int columns = this->Supply->GetColumns();
  const int rows = this->Supply->GetRows();
  constexpr double enough = 2.0 * 1024.0 * 1024.0; // samples
  const int chunk = std::max(8, static_cast<int>(enough / columns));
  const int threads = std::max(vtkSMPTools::GetEstimatedNumberOfThreads(), 1);
  const int group = std::min(chunk * threads, rows);
  std::vector<float> lengths(static_cast<std::size_t>(group) * columns);
  std::vector<std::uint64_t> hashes(static_cast<std::size_t>(rows));
  std::mutex mutex;
  auto survey = std::make_unique<HeightSurvey>();
  survey->scale = scale;
  survey->datum = datum;
  survey->bounds.Begin(columns, rows);
  for (int first = 0; first < rows; first += group)
  {
    const int end = std::min(first + group, rows);
    vtkReliefFor(0, (end - first + chunk - 1) / chunk, 1,
      [&](vtkIdType from, vtkIdType to)
      {
        const int j0 = first + static_cast<int>(from) * chunk;
        const int j1 = std::min(first + static_cast<int>(to) * chunk, end);
        const HeightSupply::Part part = this->Supply->Read({ 0, columns, j0, j1 });
        std::vector<double> row;
        constexpr double none = std::numeric_limits<double>::infinity();
        double ends[2] = { none, -none };
        WithHeightSource(InputsOf(part, scale), Unit,
          [&](const auto& heights)
          {
            const HeightReader reader(heights);
            for (int j = j0; j < j1; ++j)
            {
              float* to = lengths.data() + static_cast<std::size_t>(j - first) * columns;
              reader.Read(j - j0, datum, to);
              AddRow(heights, j - j0, to, datum, row, ends);
              hashes[static_cast<std::size_t>(j)] = HashRow(heights, j - j0);
            }
          });
        const std::lock_guard<std::mutex> lock(mutex);
        survey->least = std::min(survey->least, ends[0]);
        survey->greatest = std::max(survey->greatest, ends[1]);
      });
    survey->bounds.AddRows(lengths.data(), columns, end - first);
    this->Supply->Advance(static_cast<double>(end) / rows);
  }
  survey->hash = HashOfRows(hashes);
  return survey;
}

//------------------------------------------------------------------------------
const HeightSurvey& TiledHeights::Survey(double scale)
{
  if (this->Found && this->Found->scale == scale)
  {
    return *this->Found;
  }
  auto found = std::make_unique<HeightSurvey>();
  if (!this->Supply->FindSurvey(scale, *found))
  {
    found = this->MakeSurvey(scale, 0.0);
    // As HeightField does it.
    const HeightSupply::Part sample = this->Supply->Read({ 0, 1, 0, 1 });
    const RasterBounds& bounds = found->bounds;
    const bool floats = sample.heights->GetScalarType() == VTK_FLOAT;
    if (HeightField::FindDatum(bounds.GetBottom(), bounds.GetTop(), floats) != 0.0)
    {
      const auto [lo, hi] = std::minmax({ found->least * scale, found->greatest * scale });
      found = this->MakeSurvey(scale, HeightField::FindDatum(lo, hi, false));
    }
    this->Supply->KeepSurvey(*found);
  }
  this->Regions.reset();
  this->Sparse.reset();
  this->Prepared.reset();
  this->Found = std::move(found);
  return *this->Found;
}

//------------------------------------------------------------------------------
double TiledHeights::FitScale(const double spacing[2])
{
  RowCache rows(*this->Supply);
  const SampledHeights samples{ this->Supply->GetColumns(), this->Supply->GetRows(), spacing[0],
    spacing[1], [&rows](int i, int j, double& height) { return rows.Read(i, j, height); } };
  return FitHeightScale(
    samples, [](int count, const std::function<void(int, int)>& body) { body(0, count); });
}

//------------------------------------------------------------------------------
std::string TiledHeights::Prepare(double scale, const double spacing[2], bool padded)
{
  if (this->Prepared && this->Prepared->scale == scale && this->Prepared->padded == padded &&
    std::equal(spacing, spacing + 2, this->Prepared->spacing))
  {
    return std::string();
  }
  const HeightSurvey& survey = this->Survey(scale);
  this->Regions.reset();
  this->Prepared.reset();
  this->Sparse = std::make_unique<SparseHeights>();
  const std::string wrong =
    this->Sparse->Reserve(survey.bounds, spacing[0], spacing[1], survey.datum, padded);
  if (wrong.empty())
  {
    this->Prepared = Preparation{ scale, { spacing[0], spacing[1] }, padded };
  }
  return wrong;
}

//------------------------------------------------------------------------------
const TileRegions& TiledHeights::RegionsFor(const Scene& scene, std::uint64_t version)
{
  if (!this->Regions || this->RegionsVersion != version)
  {
    this->Regions = std::make_unique<TileRegions>(*this->Sparse, scene);
    this->RegionsVersion = version;
  }
  return *this->Regions;
}

//------------------------------------------------------------------------------
void TiledHeights::Fill(const RegionSet& regions)
{
  const double scale = this->Prepared->scale;
  const double datum = this->Found->datum;
  // Virtual rasters that resample their sources round otherwise in other windows.
  const double most = std::max(
    std::abs(scale * this->Found->least - datum), std::abs(scale * this->Found->greatest - datum));
  const float step = std::numeric_limits<float>::epsilon() * static_cast<float>(most);
  const float rounding = std::isfinite(step) ? 16.0f * step : 0.0f;
  this->Sparse->Fill(
    regions,
    [&](int i0, int i1, int j0, int j1, float* lengths, std::ptrdiff_t pitch)
    {
      const HeightSupply::Part part = this->Supply->Read({ i0, i1, j0, j1 });
      WithHeightSource(InputsOf(part, scale), Unit,
        [&](const auto& heights)
        {
          const HeightReader reader(heights);
          for (int j = 0; j < j1 - j0; ++j)
          {
            reader.Read(j, datum, lengths + j * pitch);
          }
        });
      const int count = (i1 - i0 + RegionSize - 1) / RegionSize;
      if (!this->Found->bounds.Agree(
            i0 / RegionSize, j0 / RegionSize, count, lengths, pitch, rounding))
      {
        throw std::runtime_error("its heights are not those of their bounds: they have changed "
                                 "(remove its .bounds.tif and begin anew), or a virtual raster "
                                 "resamples them part by part (make a plain raster of it)");
      }
    },
    ForRows);
}

//------------------------------------------------------------------------------
/// What any of some windows depends on, by the regions of the scene at hand.
TileRegions::Found TiledHeights::FindAll(const std::vector<HeightSupply::Window>& windows) const
{
  const RegionSet& filled = this->Sparse->GetFilled();
  const RegionSet none(filled.GetColumns(), filled.GetRows());
  TileRegions::Found found{ none, none, none };
  for (const HeightSupply::Window& window : windows)
  {
    const TileRegions::Found one = this->Regions->Find(window.i0, window.i1, window.j0, window.j1);
    found.read.Add(one.read);
    found.level.Add(one.level);
    found.needed.Add(one.needed);
  }
  return found;
}

//------------------------------------------------------------------------------
/// Heights and what bounds them; and of every row that is no whole page, the rest, which is no more
/// than what lies between.
double TiledHeights::BytesOf(const TileRegions::Found& found) const
{
  constexpr double perRegion = 9.0 * RegionSize * RegionSize;
  constexpr double perInterval = 1.5 * RegionSize * 4096.0;
  RegionSet all = found.read;
  all.Add(found.level);
  double bytes = 0.0;
  int row = -1;
  int end = 0; // of the last run
  for (const RegionSet::Interval& run : all.GetIntervals())
  {
    const double between =
      row == run.row ? std::min(perInterval, perRegion * (run.begin - end)) : perInterval;
    bytes += perRegion * (run.end - run.begin) + between;
    row = run.row;
    end = run.end;
  }
  return bytes;
}

//------------------------------------------------------------------------------
double TiledHeights::BytesOfColors(const HeightSupply::Window& window) const
{
  const double own = 1.0 * (window.i1 - window.i0) * (window.j1 - window.j0);
  return this->Table ? (8.0 + this->Supply->GetBytesPerSample()) * own : 0.0;
}

//------------------------------------------------------------------------------
/// Takes away what does not fit into so many bytes: first what would be level, of which nothing is
/// lost, then the farthest of what would be read. Leaves what is needed, whether that fits or not.
void TiledHeights::LeaveOut(
  const std::vector<HeightSupply::Window>& windows, double bytes, TileRegions::Found& found) const
{
  struct Candidate
  {
    int distance;
    int j, i;
    bool operator<(const Candidate& other) const
    {
      return std::tie(this->distance, this->j, this->i) <
        std::tie(other.distance, other.j, other.i);
    }
  };
  const RegionSet none(found.read.GetColumns(), found.read.GetRows());
  auto list = [&](const RegionSet& regions)
  {
    std::vector<Candidate> all;
    for (const RegionSet::Interval& run : regions.GetIntervals())
    {
      for (int i = run.begin; i < run.end; ++i)
      {
        if (found.needed.Has(i, run.row))
        {
          continue;
        }
        int distance = std::numeric_limits<int>::max();
        for (const HeightSupply::Window& window : windows)
        {
          const int aside = std::max(window.i0 / RegionSize - i, i - (window.i1 - 1) / RegionSize);
          const int along =
            std::max(window.j0 / RegionSize - run.row, run.row - (window.j1 - 1) / RegionSize);
          distance = std::min(distance, std::max(aside, along));
        }
        all.push_back({ distance, run.row, i });
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const std::vector<Candidate> read = list(found.read);
  const std::vector<Candidate> level = list(found.level);
  auto take = [&](std::size_t count)
  {
    TileRegions::Found taken{ found.needed, none, found.needed };
    for (std::size_t k = 0; k < count; ++k)
    {
      const Candidate& one = k < read.size() ? read[k] : level[k - read.size()];
      (k < read.size() ? taken.read : taken.level).Add(one.i, one.i, one.j, one.j);
    }
    return taken;
  };
  // As many of the nearest as fit.
  std::size_t fits = 0;
  std::size_t more = read.size() + level.size() + 1;
  while (fits + 1 < more)
  {
    const std::size_t middle = (fits + more) / 2;
    (this->BytesOf(take(middle)) <= bytes ? fits : more) = middle;
  }
  found = take(fits);
}

//------------------------------------------------------------------------------
/// The regions of windows that depend on nothing but what is filled.
RegionSet TiledHeights::FindWhole(
  const std::vector<HeightSupply::Window>& windows, const TileRegions::Found& filled) const
{
  RegionSet whole(filled.read.GetColumns(), filled.read.GetRows());
  RegionSet partly = whole; // of one of the windows that a region may have parts of
  auto holds = [](const RegionSet& all, const RegionSet& some)
  {
    RegionSet both = all;
    both.Add(some);
    return both.Count() == all.Count();
  };
  RegionSet any = filled.read;
  any.Add(filled.level);
  for (const HeightSupply::Window& window : windows)
  {
    for (int j = window.j0 / RegionSize; j <= (window.j1 - 1) / RegionSize; ++j)
    {
      for (int i = window.i0 / RegionSize; i <= (window.i1 - 1) / RegionSize; ++i)
      {
        const TileRegions::Found found = this->Regions->Find(std::max(i * RegionSize, window.i0),
          std::min((i + 1) * RegionSize, window.i1), std::max(j * RegionSize, window.j0),
          std::min((j + 1) * RegionSize, window.j1));
        const bool there = holds(filled.read, found.read) && holds(any, found.level);
        (there ? whole : partly).Add(i, i, j, j);
      }
    }
  }
  for (const RegionSet::Interval& run : partly.GetIntervals())
  {
    for (int i = run.begin; i < run.end; ++i)
    {
      whole.Remove(i, run.row);
    }
  }
  return whole;
}

//------------------------------------------------------------------------------
const HeightOutline* TiledHeights::Provide(const Scene& scene, std::uint64_t version,
  const std::vector<HeightSupply::Window>& windows, const Limit& limit)
{
  this->RegionsFor(scene, version);
  TileRegions::Found found = this->FindAll(windows);
  double colors = 0.0;
  for (const HeightSupply::Window& window : windows)
  {
    colors += this->BytesOfColors(window);
  }
  this->Outline.reset();
  this->LeftOut = 0;
  const double bytes = this->BytesOf(found) + colors;
  if (bytes > limit.bytes)
  {
    const std::size_t all = found.read.Count();
    if (limit.leavesOut)
    {
      this->LeaveOut(windows, limit.bytes - colors, found);
    }
    const double least = this->BytesOf(found) + colors;
    if (least > limit.bytes)
    {
      throw std::runtime_error(LimitMessage(least, limit));
    }
    this->LeftOut = all - found.read.Count();
    this->Outline.emplace(*this->Sparse, this->FindWhole(windows, found));
  }
  RegionSet kept = found.read;
  kept.Add(found.level);
  this->Sparse->Forget(kept);
  this->Fill(this->Sparse->FindMissing(found.read));
  this->Sparse->FillLevel(found.level, ForRows);
  this->Sparse->Complete(ForRows);
  if (this->Table)
  {
    this->Colors.Forget(0, this->Colors.size());
    for (const HeightSupply::Window& window : windows)
    {
      this->Color(window);
    }
  }
  return this->Outline ? &*this->Outline : nullptr;
}

//------------------------------------------------------------------------------
TiledHeights::Needs TiledHeights::Estimate(
  const Scene& scene, std::uint64_t version, const HeightSupply::Window& window, const Limit& limit)
{
  this->RegionsFor(scene, version);
  TileRegions::Found found = this->FindAll({ window });
  const double colors = this->BytesOfColors(window);
  Needs needs;
  needs.samples =
    1.0 * RegionSize * RegionSize * static_cast<double>(found.read.Count() + found.level.Count());
  needs.bytes = this->BytesOf(found) + colors;
  if (limit.leavesOut && needs.bytes > limit.bytes)
  {
    this->LeaveOut({ window }, limit.bytes - colors, found);
    needs.bytes = this->BytesOf(found) + colors;
  }
  return needs;
}

//------------------------------------------------------------------------------
const unsigned char* TiledHeights::UseTable(vtkScalarsToColors* table)
{
  this->Table = table;
  const std::size_t bytes = table ? 4 * static_cast<std::size_t>(this->Size) : 0;
  if (this->Colors.size() != bytes && !this->Colors.Reserve(bytes))
  {
    throw std::bad_alloc();
  }
  return this->Colors.data();
}

//------------------------------------------------------------------------------
/// On one thread, for tables promise no more.
void TiledHeights::Color(const HeightSupply::Window& window)
{
  const HeightSupply::Part part = this->Supply->Read(window);
  const auto colors = vtkSmartPointer<vtkUnsignedCharArray>::Take(this->Table->MapScalars(
    part.heights->GetPointData()->GetScalars(), VTK_COLOR_MODE_MAP_SCALARS, 0, VTK_RGBA));
  const std::size_t width = static_cast<std::size_t>(window.i1 - window.i0);
  const auto columns = static_cast<std::size_t>(this->Supply->GetColumns());
  const unsigned char* row = colors->GetPointer(0);
  for (int j = window.j0; j < window.j1; ++j, row += 4 * width)
  {
    std::copy_n(row, 4 * width, this->Colors.data() + 4 * (j * columns + window.i0));
  }
}

//------------------------------------------------------------------------------
float TiledHeights::GetValue(vtkIdType at) const
{
  float value = std::numeric_limits<float>::quiet_NaN();
  try
  {
    const int i = static_cast<int>(at % this->Supply->GetColumns());
    const int j = static_cast<int>(at / this->Supply->GetColumns());
    const HeightSupply::Part part = this->Supply->Read({ i, i + 1, j, j + 1 });
    WithHeightSource(InputsOf(part, 1.0), Unit,
      [&value](const auto& heights) { HeightReader(heights).Read(0, 0.0, &value); });
  }
  catch (const std::exception&)
  {
    return value;
  }
  return value;
}

//------------------------------------------------------------------------------
/// A copy of all heights, for whoever takes them from one piece of memory; NaN from where they
/// cannot be read on.
void* TiledHeights::GetVoidPointer(vtkIdType at)
{
  const int columns = this->Supply->GetColumns();
  const int rows = this->Supply->GetRows();
  if (this->Copy.empty())
  {
    this->Copy.assign(
      static_cast<std::size_t>(this->Size), std::numeric_limits<float>::quiet_NaN());
    try
    {
      for (int j0 = 0; j0 < rows; j0 += RegionSize)
      {
        const int j1 = std::min(j0 + RegionSize, rows);
        const HeightSupply::Part part = this->Supply->Read({ 0, columns, j0, j1 });
        WithHeightSource(InputsOf(part, 1.0), Unit,
          [&](const auto& heights)
          {
            const HeightReader reader(heights);
            for (int j = j0; j < j1; ++j)
            {
              reader.Read(j - j0, 0.0, this->Copy.data() + static_cast<std::size_t>(j) * columns);
            }
          });
      }
    }
    catch (const std::exception& error)
    {
      vtkErrorMacro(<< error.what() << ".");
    }
  }
  return this->Copy.data() + at;
}

//------------------------------------------------------------------------------
TiledHeights* FindTiled(const HeightInputs& inputs)
{
  return TiledHeights::SafeDownCast(inputs.scalars);
}
}

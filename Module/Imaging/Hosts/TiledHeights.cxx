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
#include <exception>
#include <map>
#include <mutex>
#include <new>
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
    },
    ForRows);
}

//------------------------------------------------------------------------------
void TiledHeights::Provide(
  const Scene& scene, std::uint64_t version, const std::vector<HeightSupply::Window>& windows)
{
  const TileRegions& regions = this->RegionsFor(scene, version);
  const RegionSet& filled = this->Sparse->GetFilled();
  TileRegions::Found found{ RegionSet(filled.GetColumns(), filled.GetRows()),
    RegionSet(filled.GetColumns(), filled.GetRows()) };
  for (const HeightSupply::Window& window : windows)
  {
    const TileRegions::Found one = regions.Find(window.i0, window.i1, window.j0, window.j1);
    found.read.Add(one.read);
    found.level.Add(one.level);
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
}

//------------------------------------------------------------------------------
TiledHeights::Needs TiledHeights::Estimate(
  const Scene& scene, std::uint64_t version, const HeightSupply::Window& window)
{
  const TileRegions::Found found =
    this->RegionsFor(scene, version).Find(window.i0, window.i1, window.j0, window.j1);
  RegionSet all = found.read;
  all.Add(found.level);
  // Heights and what bounds them; and of every row that is no whole page, the rest.
  constexpr double perSample = 9.0;
  constexpr double perInterval = 1.5 * RegionSize * 4096.0;
  Needs needs;
  for (const RegionSet::Interval& run : all.GetIntervals())
  {
    const double samples = 1.0 * (run.end - run.begin) * RegionSize * RegionSize;
    needs.samples += samples;
    needs.bytes += perSample * samples + perInterval;
  }
  const double own = 1.0 * (window.i1 - window.i0) * (window.j1 - window.j0);
  needs.bytes += this->Table ? (8.0 + this->Supply->GetBytesPerSample()) * own : 0.0;
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

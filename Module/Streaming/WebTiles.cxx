// SPDX-License-Identifier: BSD-3-Clause
#include "WebTiles.h"

#include "CodeTable.h"
#include "Gdal.h"
#include "ReliefModel.h"
#include "TemporaryFile.h"
#include "WarpedPicture.h"

#include "vtkErrorCode.h"
#include "vtkReliefThreads.h"
#include "vtkSMPTools.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <mutex>
#include <regex>
#include <sstream>
#include <vector>

namespace fs = std::filesystem;

namespace relief::streaming
{
namespace
{
using raster::DatasetPointer;
using raster::FindDriver;
using raster::GdalErrors;

constexpr const char* PictureFile = "shaded.tif";
constexpr const char* DescriptionFile = "tiles.json";

//------------------------------------------------------------------------------
io::Failure Refusal(const fs::path& file, const std::string& reason)
{
  return { vtkErrorCode::CannotOpenFileError,
    io::Shortened(file.string(), io::LongestName) + ": " + reason };
}

bool IsNumber(const std::string& name)
{
  return !name.empty() &&
    std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

fs::path FileOf(const fs::path& folder, int zoom, std::int64_t column, std::int64_t row)
{
  return folder / std::to_string(zoom) / std::to_string(column) / (std::to_string(row) + ".png");
}

bool IsThere(const fs::path& file)
{
  std::error_code ignored;
  return fs::exists(file, ignored);
}

//------------------------------------------------------------------------------
/// A file that appears whole. Throws a Failure that names it.
void WriteFile(const fs::path& file, const void* bytes, std::size_t size)
{
  try
  {
    io::TemporaryFile written(file.string());
    written.Write(bytes, size);
    const int error = written.Finish();
    if (error != 0)
    {
      throw io::Failure(vtkErrorCode::OutOfDiskSpaceError,
        std::string("cannot be written: ") + std::strerror(error));
    }
    written.Keep();
  }
  catch (const io::Failure& failure)
  {
    throw io::Failure(failure.Code, Refusal(file, failure.what()).what());
  }
}

//------------------------------------------------------------------------------
/// A tile's samples: red, green, blue and alpha, row by row from the north.
using Samples = std::vector<unsigned char>;

bool IsEmpty(const Samples& samples)
{
  for (std::size_t k = 3; k < samples.size(); k += 4)
  {
    if (samples[k] != 0)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void WriteTile(const fs::path& file, int size, Samples& samples)
{
  const GdalErrors errors;
  const CPLConfigOptionSetter noSideFiles("GDAL_PAM_ENABLED", "NO", false);
  const DatasetPointer memory(FindDriver("MEM")->Create("", size, size, 4, GDT_Byte, nullptr));
  bool made = memory != nullptr &&
    memory->RasterIO(GF_Write, 0, 0, size, size, samples.data(), size, size, GDT_Byte, 4, nullptr,
      4, static_cast<GSpacing>(4) * size, 1, nullptr) == CE_None &&
    memory->GetRasterBand(4)->SetColorInterpretation(GCI_AlphaBand) == CE_None;
  // GDAL does not tell whether the last bytes found room on the disk, so the disk is not its own.
  const std::string name = "/vsimem/" + file.string();
  made = made &&
    DatasetPointer(FindDriver("PNG")->CreateCopy(
      name.c_str(), memory.get(), FALSE, nullptr, nullptr, nullptr)) != nullptr;
  vsi_l_offset length = 0;
  const std::unique_ptr<GByte, void (*)(void*)> bytes(
    made ? VSIGetMemFileBuffer(name.c_str(), &length, TRUE) : nullptr, VSIFree);
  if (!bytes || GdalErrors::Any())
  {
    throw Refusal(file, "cannot be written: " + GdalErrors::Take("GDAL makes no PNG"));
  }
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  WriteFile(file, bytes.get(), static_cast<std::size_t>(length));
}

//------------------------------------------------------------------------------
/// Reads a tile that was written. Returns false where none was: there is no data.
bool ReadTile(const fs::path& file, int size, Samples& samples)
{
  if (!IsThere(file))
  {
    return false;
  }
  const GdalErrors errors;
  const char* const drivers[] = { "PNG", nullptr };
  const char* const noFilesBeside[] = { nullptr };
  const DatasetPointer tile(GDALDataset::Open(file.string().c_str(),
    GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, drivers, nullptr, noFilesBeside));
  if (!tile || tile->GetRasterCount() != 4 || tile->GetRasterXSize() != size ||
    tile->GetRasterYSize() != size ||
    tile->RasterIO(GF_Read, 0, 0, size, size, samples.data(), size, size, GDT_Byte, 4, nullptr, 4,
      static_cast<GSpacing>(4) * size, 1, nullptr) != CE_None ||
    GdalErrors::Any())
  {
    throw Refusal(file,
      "cannot be read: " + GdalErrors::Take("it is no tile of this run", file.string()) +
        "; remove it, and it is made again");
  }
  return true;
}

//------------------------------------------------------------------------------
/// Light that is stored as 8-bit codes.
const float* LightOfCodes()
{
  static const std::vector<float> light = []
  {
    std::vector<float> values(256);
    for (int code = 0; code < 256; ++code)
    {
      values[static_cast<std::size_t>(code)] = static_cast<float>(f64::reliefDecode(code / 255.0));
    }
    return values;
  }();
  return light.data();
}

//------------------------------------------------------------------------------
/// Puts a tile, half as large, into a quarter of another: of each four samples the mean light,
/// where there are data.
void Reduce(const Samples& tile, int size, int right, int down, Samples& larger)
{
  const float* light = LightOfCodes();
  const CodeTable& codes = CodeTable::Get();
  const int half = size / 2;
  const auto at = [size](int column, int row)
  {
    return 4 *
      (static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
        static_cast<std::size_t>(column));
  };
  for (int j = 0; j < half; ++j)
  {
    for (int i = 0; i < half; ++i)
    {
      const std::size_t four[] = { at(2 * i, 2 * j), at(2 * i + 1, 2 * j), at(2 * i, 2 * j + 1),
        at(2 * i + 1, 2 * j + 1) };
      int alpha = 0;
      float sum[3] = { 0.0f, 0.0f, 0.0f };
      for (const std::size_t sample : four)
      {
        const int weight = tile[sample + 3];
        alpha += weight;
        for (std::size_t k = 0; k < 3; ++k)
        {
          sum[k] += static_cast<float>(weight) * light[tile[sample + k]];
        }
      }
      unsigned char* mean = &larger[at(i + right * half, j + down * half)];
      mean[3] = static_cast<unsigned char>((alpha + 2) / 4);
      for (int k = 0; k < 3; ++k)
      {
        mean[k] = mean[3] > 0 ? codes(sum[k] / static_cast<float>(alpha)) : 0;
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Goes through tiles on all threads, and tells how many are done.
class TileLoop
{
public:
  /// What a thread does with tiles side by side in a row.
  using Work = std::function<void(std::int64_t column, std::int64_t row, int columns)>;

  TileLoop(const io::StepWatcher& watcher, double all)
    : Watcher(watcher)
    , All(all)
  {
  }

  /// All tiles of some spans, up to so many of a row at a time, in groups that begin at a multiple
  /// of that from the first column. Each thread begins its work once. What one of them throws comes
  /// out when the others have come to an end.
  void Run(const std::vector<TileSpan>& spans, std::int64_t first, int width,
    const std::function<Work()>& begin);

private:
  void Done(int tiles)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Count += tiles;
    io::Advance(this->Watcher, this->Count / this->All);
  }

  const io::StepWatcher& Watcher;
  const double All;
  double Count = 0.0;
  std::mutex Mutex;
};

//------------------------------------------------------------------------------
void TileLoop::Run(const std::vector<TileSpan>& spans, std::int64_t first, int width,
  const std::function<Work()>& begin)
{
  for (const TileSpan& span : spans)
  {
    const std::int64_t firstGroup = (span.Columns[0] - first) / width;
    const std::int64_t groups = (span.Columns[1] - first) / width - firstGroup + 1;
    const std::int64_t all = groups * (span.Rows[1] - span.Rows[0] + 1);
    std::atomic<std::int64_t> next{ 0 };
    const auto goThrough = [&]
    {
      std::int64_t at = next++;
      const Work work = at < all ? begin() : Work();
      for (; at < all; at = next++)
      {
        const std::int64_t group = first + (firstGroup + at % groups) * width;
        const std::int64_t from = std::max(group, span.Columns[0]);
        const int columns =
          static_cast<int>(std::min(group + width - 1, span.Columns[1]) - from) + 1;
        work(from, span.Rows[0] + at / groups, columns);
        this->Done(columns);
      }
    };
    vtkReliefFor(0, std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()), 1,
      [&](vtkIdType from, vtkIdType to)
      {
        for (; from < to; ++from)
        {
          try
          {
            goThrough();
          }
          catch (...)
          {
            next = all; // the others end as well
            throw;
          }
        }
      });
  }
}

//------------------------------------------------------------------------------
/// The tiles of the greatest zoom that are missing.
TileLoop::Work WarpInto(const fs::path& folder, const std::string& picture, const TilePlan& plan)
{
  const auto warped = std::make_shared<WarpedPicture>(picture, plan);
  const int zoom = plan.Zoom[1];
  const int size = plan.Size;
  return [=](std::int64_t column, std::int64_t row, int columns)
  {
    bool missing = false;
    for (int k = 0; k < columns; ++k)
    {
      missing = missing || !IsThere(FileOf(folder, zoom, column + k, row));
    }
    if (!missing)
    {
      return;
    }
    const std::size_t bytes = 4 * static_cast<std::size_t>(size);
    Samples all(bytes * static_cast<std::size_t>(size * columns));
    warped->Read(column * size, row * size, columns * size, size, all.data());
    Samples tile(bytes * static_cast<std::size_t>(size));
    for (int k = 0; k < columns; ++k)
    {
      for (int j = 0; j < size; ++j)
      {
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>((j * columns + k) * bytes), bytes,
          tile.begin() + static_cast<std::ptrdiff_t>(j * bytes));
      }
      const fs::path file = FileOf(folder, zoom, column + k, row);
      if (!IsThere(file) && !IsEmpty(tile))
      {
        WriteTile(file, size, tile);
      }
    }
  };
}

//------------------------------------------------------------------------------
/// Those of another zoom, of the next one's.
TileLoop::Work ReduceInto(const fs::path& folder, int zoom, int size)
{
  return [=](std::int64_t column, std::int64_t row, int)
  {
    const fs::path file = FileOf(folder, zoom, column, row);
    if (IsThere(file))
    {
      return;
    }
    const std::size_t bytes = 4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    Samples tile(bytes);
    Samples part(bytes);
    for (const int down : { 0, 1 })
    {
      for (const int right : { 0, 1 })
      {
        if (ReadTile(FileOf(folder, zoom + 1, 2 * column + right, 2 * row + down), size, part))
        {
          Reduce(part, size, right, down, tile);
        }
      }
    }
    if (!IsEmpty(tile))
    {
      WriteTile(file, size, tile);
    }
  };
}

//------------------------------------------------------------------------------
double CountOf(const TilePlan& plan)
{
  double count = 0.0;
  for (int zoom = plan.Zoom[0]; zoom <= plan.Zoom[1]; ++zoom)
  {
    for (const TileSpan& span : plan.At(zoom))
    {
      count += static_cast<double>(span.Columns[1] - span.Columns[0] + 1) *
        static_cast<double>(span.Rows[1] - span.Rows[0] + 1);
    }
  }
  return count;
}

//------------------------------------------------------------------------------
/// TileJSON 3.0; addresses are as seen from the file.
std::string Description(const TilePlan& plan)
{
  std::array<double, 4> bounds = plan.Bounds;
  if (bounds[0] > bounds[2]) // round 180 degrees, which it has no words for
  {
    bounds[0] = -180.0;
    bounds[2] = 180.0;
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(8) << "{\n  \"tilejson\": \"3.0.0\",\n"
       << "  \"tiles\": [\"{z}/{x}/{y}.png\"],\n  \"scheme\": \"xyz\",\n"
       << "  \"bounds\": [" << bounds[0] << ", " << bounds[1] << ", " << bounds[2] << ", "
       << bounds[3] << "],\n  \"minzoom\": " << plan.Zoom[0] << ",\n  \"maxzoom\": " << plan.Zoom[1]
       << ",\n  \"tileSize\": " << plan.Size << "\n}\n";
  return text.str();
}
}

//------------------------------------------------------------------------------
WebTiles::WebTiles(const std::string& folder, const std::string& key)
  : Folder(folder, key)
{
  this->RemoveUnfinished();
}

//------------------------------------------------------------------------------
bool WebTiles::AreDone() const
{
  return IsThere(this->Folder.Path() / DescriptionFile);
}

//------------------------------------------------------------------------------
std::string WebTiles::GetPicture() const
{
  return (this->Folder.Path() / PictureFile).string();
}

//------------------------------------------------------------------------------
bool WebTiles::HasPicture() const
{
  return IsThere(this->GetPicture());
}

//------------------------------------------------------------------------------
TilePlan WebTiles::Plan(int size, const std::optional<std::array<int, 2>>& zoom) const
{
  raster::GeoReference reference;
  int samples[2];
  {
    const GdalErrors errors;
    const DatasetPointer picture(
      GDALDataset::Open(this->GetPicture().c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
    if (!picture)
    {
      throw Refusal(this->GetPicture(),
        "cannot be read: " + GdalErrors::Take("it is no TIFF", this->GetPicture()));
    }
    samples[0] = picture->GetRasterXSize();
    samples[1] = picture->GetRasterYSize();
    reference.Present = picture->GetGeoTransform(reference.Transform.data()) == CE_None;
    char* text = nullptr;
    const char* const format[] = { "FORMAT=WKT2_2018", nullptr };
    const OGRSpatialReference* crs = picture->GetSpatialRef();
    if (crs && crs->exportToWkt(&text, format) == OGRERR_NONE)
    {
      reference.Crs = text;
    }
    CPLFree(text);
  }
  return PlanTiles(reference, samples, size, zoom);
}

//------------------------------------------------------------------------------
void WebTiles::Make(const TilePlan& plan, const io::StepWatcher& watcher)
{
  const fs::path& folder = this->Folder.Path();
  const std::string picture = this->GetPicture();
  const int first = plan.Zoom[1];
  TileLoop loop(watcher, CountOf(plan));
  const std::int64_t firstColumn = plan.Around().Columns[0];
  loop.Run(plan.At(first), firstColumn, WarpedPicture::BlockColumns / plan.Size,
    [&] { return WarpInto(folder, picture, plan); });
  for (int zoom = first - 1; zoom >= plan.Zoom[0]; --zoom)
  {
    const std::vector<TileSpan> spans = plan.At(zoom);
    loop.Run(spans, 0, 1, [&] { return ReduceInto(folder, zoom, plan.Size); });
  }
  const std::string description = Description(plan);
  WriteFile(folder / DescriptionFile, description.data(), description.size());
  std::error_code ignored;
  fs::remove(picture, ignored);
}

//------------------------------------------------------------------------------
bool WebTiles::HasTiles() const
{
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(this->Folder.Path(), ignored))
  {
    if (IsNumber(entry.path().filename().string()))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void WebTiles::Forget()
{
  if (!this->HasTiles() && !this->HasPicture() && !this->AreDone())
  {
    this->Folder.Remove();
  }
}

//------------------------------------------------------------------------------
void WebTiles::RemoveUnfinished() const
{
  const auto removeIn =
    [](const fs::path& folder, const std::function<bool(const std::string&)>& ours)
  {
    std::error_code ignored;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
    {
      if (ours(RunFolder::UnfinishedOf(entry.path().filename().string())))
      {
        files.push_back(entry.path());
      }
    }
    for (const fs::path& file : files)
    {
      fs::remove(file, ignored);
    }
  };
  removeIn(this->Folder.Path(),
    [](const std::string& name)
    { return name == RunFolder::KeyName || name == PictureFile || name == DescriptionFile; });
  const auto foldersIn = [](const fs::path& folder)
  {
    std::vector<fs::path> folders;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
    {
      if (IsNumber(entry.path().filename().string()) && entry.is_directory(ignored))
      {
        folders.push_back(entry.path());
      }
    }
    return folders;
  };
  for (const fs::path& zoom :
    this->AreDone() ? std::vector<fs::path>() : foldersIn(this->Folder.Path()))
  {
    for (const fs::path& column : foldersIn(zoom))
    {
      removeIn(column,
        [](const std::string& name)
        {
          return !name.empty() && IsNumber(fs::path(name).stem().string()) &&
            fs::path(name).extension() == ".png";
        });
    }
  }
}
}

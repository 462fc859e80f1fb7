// SPDX-License-Identifier: BSD-3-Clause
#include "TiledRaster.h"

#include "EsriGrid.h"
#include "Gdal.h"
#include "ShortestText.h"
#include "SurveyFile.h"
#include "TiledHeights.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <utility>

namespace relief::raster
{
/// An open file for the time that a window is read.
class TiledRaster::Lease
{
public:
  explicit Lease(TiledRaster& raster)
    : Raster(raster)
  {
    {
      const std::lock_guard<std::mutex> lock(raster.Mutex);
      if (!raster.Free.empty())
      {
        this->File = std::move(raster.Free.back());
        raster.Free.pop_back();
      }
    }
    if (!this->File)
    {
      this->File = raster.Open();
    }
    const RasterHeader& header = this->File->GetHeader();
    if (header.Columns != raster.Header.Columns || header.Rows != raster.Header.Rows)
    {
      throw io::Failure(vtkErrorCode::FileFormatError, "it has changed since its header was read");
    }
  }
  ~Lease()
  {
    const std::lock_guard<std::mutex> lock(this->Raster.Mutex);
    this->Raster.Free.push_back(std::move(this->File));
  }
  Lease(const Lease&) = delete;
  void operator=(const Lease&) = delete;

  RasterFile& operator*() const { return *this->File; }

private:
  TiledRaster& Raster;
  std::unique_ptr<RasterFile> File;
};

//------------------------------------------------------------------------------
TiledRaster::TiledRaster(const std::string& name, const ReadOptions& options, const Opener& open)
  : Name(name)
  , Options(options)
  , Open(open)
{
  std::unique_ptr<RasterFile> file = open();
  if (!file || !file->HasWindows())
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "it would not fit into memory, and its format is read as a whole; gdal_translate makes a "
      "GeoTIFF of it");
  }
  this->Header = file->GetHeader();
  CheckSpacing(this->Header);
  this->SetScaling(this->Header.Scale, this->Header.Offset);
  this->Free.push_back(std::move(file));
}

//------------------------------------------------------------------------------
TiledRaster::~TiledRaster() = default;

//------------------------------------------------------------------------------
void TiledRaster::LimitDecoding(double bytes)
{
  GDALSetCacheMax64(std::min(static_cast<GIntBig>(bytes), GDALGetCacheMax64()));
}

//------------------------------------------------------------------------------
void TiledRaster::SetMask(std::unique_ptr<TiledRaster> mask)
{
  if (mask->GetColumns() != this->GetColumns() || mask->GetRows() != this->GetRows())
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      std::to_string(mask->GetColumns()) + " x " + std::to_string(mask->GetRows()) +
        " samples; expected " + std::to_string(this->GetColumns()) + " x " +
        std::to_string(this->GetRows()) + " as the heights have");
  }
  this->Mask = std::move(mask);
  this->State.clear();
}

//------------------------------------------------------------------------------
const std::string& TiledRaster::GetState()
{
  if (this->State.empty())
  {
    std::vector<std::string> files = FilesOf(this->Name);
    if (files.empty() && IsEsriGrid(this->Name))
    {
      files = FilesOfEsriGrid(this->Name); // GDAL does not read all of those
    }
    this->State = StateOfFiles(files);
    this->InFiles = !this->State.empty();
    const ReadOptions& options = this->Options;
    if (options.Encoding != HeightEncoding::None)
    {
      this->State +=
        options.Encoding == HeightEncoding::Terrarium ? " of terrarium" : " of terrain-rgb";
    }
    this->State += " band " + std::to_string(options.Band) + " no data " +
      (options.NoDataFromFile ? "of the file"
          : options.NoData    ? TextOf(*options.NoData)
                              : "none");
    this->State += " scaled by " + TextOf(this->Scaling[0]) + " and " + TextOf(this->Scaling[1]) +
      " rows " + HashOfProbes(*this);
    if (this->Mask)
    {
      this->State += " mask " + this->Mask->GetState();
      this->InFiles = this->InFiles && this->Mask->InFiles;
    }
  }
  return this->State;
}

//------------------------------------------------------------------------------
int TiledRaster::GetBytesPerSample() const
{
  return vtkDataArray::GetDataTypeSize(this->Header.ScalarType) + (this->Header.Masked ? 1 : 0) +
    (this->Mask ? this->Mask->GetBytesPerSample() : 0);
}

//------------------------------------------------------------------------------
hosts::HeightSupply::Part TiledRaster::Read(const Window& window)
{
  Part part;
  {
    const Lease file(*this);
    Raster raster =
      ReadStored(*file, this->Options, { window.i0, window.i1, window.j0, window.j1 });
    this->NoteEnds(window, raster);
    raster.Scale = this->Scaling[0];
    raster.Offset = this->Scaling[1];
    ApplyScale(raster);
    part.heights = raster.Heights;
    part.mask = raster.Mask;
    part.useNoData = raster.NoData.has_value();
    part.noData = raster.NoData.value_or(0.0);
  }
  if (this->Mask)
  {
    this->ApplyMask(window, part);
  }
  return part;
}

//------------------------------------------------------------------------------
/// Takes note of what tells undeclared no data, while a pass goes over the rows. It may be made
/// once more.
void TiledRaster::NoteEnds(const Window& window, const Raster& part)
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Noted.empty() || window.i1 - window.i0 < this->Header.Columns ||
      this->Noted[static_cast<std::size_t>(window.j0)])
    {
      return;
    }
    std::fill(this->Noted.begin() + window.j0, this->Noted.begin() + window.j1, true);
  }
  const ValueEnds ends = EndsOfRows(part, window.j0, this->Header.Rows);
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Ends.Add(ends);
}

//------------------------------------------------------------------------------
void TiledRaster::ApplyMask(const Window& window, Part& part)
{
  const Part other = this->Mask->Read(window);
  auto mask = vtkSmartPointer<vtkImageData>::New();
  mask->CopyStructure(part.heights);
  mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* values = static_cast<unsigned char*>(mask->GetScalarPointer());
  std::fill_n(values, mask->GetNumberOfPoints(), static_cast<unsigned char>(255));
  for (vtkImageData* image : { part.mask.Get(), other.heights.Get(), other.mask.Get() })
  {
    vtkDataArray* shown = image ? image->GetPointData()->GetScalars() : nullptr;
    const bool marked = image == other.heights && other.useNoData;
    for (vtkIdType i = 0; shown && i < shown->GetNumberOfTuples(); ++i)
    {
      const double value = shown->GetComponent(i, 0);
      const bool hides = !(value == value) || value == 0.0 || (marked && value == other.noData);
      values[i] = hides ? 0 : values[i];
    }
  }
  part.mask = mask;
}

//------------------------------------------------------------------------------
void TiledRaster::Advance(double share)
{
  io::Advance(this->Watcher, share);
}

//------------------------------------------------------------------------------
bool TiledRaster::FindSurvey(double scale, hosts::HeightSurvey& survey)
{
  const std::string& state = this->GetState();
  if (this->InFiles && LoadSurvey(this->Name, state, *this, scale, survey, this->Undeclared))
  {
    return true;
  }
  // The pass that is made now tells, unless one with another scale has. Who says that there is none
  // has been told.
  if (this->Options.NoDataFromFile || this->Options.NoData)
  {
    this->Noted.assign(static_cast<std::size_t>(this->Header.Rows), false);
    this->Ends = ValueEnds();
  }
  return false;
}

//------------------------------------------------------------------------------
void TiledRaster::KeepSurvey(const hosts::HeightSurvey& survey)
{
  this->Undeclared = this->Noted.empty() ? "" : TellUndeclared(this->Ends, this->Header);
  this->Noted.clear();
  const std::string& state = this->GetState();
  if (this->InFiles)
  {
    SaveSurvey(this->Name, state, survey, this->Undeclared);
  }
}

//------------------------------------------------------------------------------
Raster ReadTiled(const std::shared_ptr<TiledRaster>& file, double scale)
{
  vtkNew<hosts::TiledHeights> heights;
  heights->SetSupply(file);
  const hosts::HeightSurvey& survey = heights->Survey(scale);
  Raster raster;
  static_cast<RasterHeader&>(raster) = file->GetHeader();
  // What is read is heights already.
  raster.Scale = 1.0;
  raster.Offset = 0.0;
  raster.NoData.reset();
  raster.Masked = false;
  const auto samples = static_cast<std::uint64_t>(raster.Columns) * raster.Rows;
  raster.HasNaN = survey.bounds.GetNumberWithData() < samples;
  raster.Ends = { survey.least, survey.greatest };
  if (!file->GetUndeclared().empty())
  {
    raster.Warnings.push_back({ file->GetUndeclared(), Warning::NoData });
  }
  raster.Heights = vtkSmartPointer<vtkImageData>::New();
  raster.Heights->SetDimensions(raster.Columns, raster.Rows, 1);
  raster.Heights->GetPointData()->SetScalars(heights);
  return raster;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefRasterReader.h"

#include "HeightEncoding.h"
#include "MapPlace.h"
#include "OtherContent.h"
#include "RasterFieldData.h"
#include "RasterFile.h"
#include "TiledRaster.h"
#include "UndeclaredNoData.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace relief::raster;
using relief::io::Failure;
using relief::io::Guard;
using relief::io::LongestName;
using relief::io::Shortened;
using vtksys::SystemTools;

vtkStandardNewMacro(vtkReliefRasterReader);

/// What the header said, while the file can be read.
struct vtkReliefRasterReader::Internals
{
  explicit Internals(vtkReliefRasterReader* self)
    : Self(self)
  {
  }

  void Check(const RasterHeader& found) const;
  void Describe(RasterHeader told, vtkImageData* heights) const;
  bool GoOn(double share) const;
  void ReadPart(RasterFile& file, const RasterFile::Window& part, vtkImageData* const outputs[2]);
  void ReadTiles(const std::string& name, vtkImageData* output) const;

  vtkReliefRasterReader* Self;
  bool Readable = false;
  RasterHeader Read;
};

namespace
{
//------------------------------------------------------------------------------
// GDAL's own names of data sets need be no files: "NETCDF:a.nc:z", "/vsizip/a.zip/a.tif".
void CheckFile(const std::string& name)
{
  if (name.empty())
  {
    throw Failure(vtkErrorCode::NoFileNameError, "no file name is set");
  }
  if (SystemTools::PathExists(name) && !SystemTools::TestFileAccess(name, vtksys::TEST_FILE_READ))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError, "there is no permission to read it");
  }
}

//------------------------------------------------------------------------------
std::unique_ptr<RasterFile> OpenBand(const std::string& name, const ReadOptions& options)
{
  CheckFile(name);
  std::unique_ptr<RasterFile> file = OpenRaster(name, options);
  const bool exists = SystemTools::PathExists(name);
  if (!file && !exists)
  {
    throw Failure(vtkErrorCode::FileNotFoundError, "the file does not exist");
  }
  if (!file && SystemTools::FileLength(name) == 0)
  {
    throw Failure(vtkErrorCode::PrematureEndOfFileError, "the file is empty");
  }
  if (!file)
  {
    RefuseOtherContent(name);
    file = OpenPicture(name, options);
  }
  if (!file)
  {
    throw Failure(
      vtkErrorCode::UnrecognizedFileTypeError, "no format that is read has its content");
  }
  return file;
}

//------------------------------------------------------------------------------
std::unique_ptr<RasterFile> Open(const std::string& name, const ReadOptions& options)
{
  std::unique_ptr<RasterFile> file =
    OpenEncoded(options, [&name](const ReadOptions& band) { return OpenBand(name, band); });
  CheckSpacing(file->GetHeader());
  return file;
}

//------------------------------------------------------------------------------
bool IsFloating(int type)
{
  return type == VTK_FLOAT || type == VTK_DOUBLE;
}

//------------------------------------------------------------------------------
std::string Advice(Warning::Choice remedy)
{
  switch (remedy)
  {
    case Warning::NoData:
      return "; see NoDataValue";
    case Warning::HeightScale:
      return "; see HeightScale of vtkReliefScene";
    default:
      return "";
  }
}

//------------------------------------------------------------------------------
void Tell(vtkObject* reader, const std::string& name, const std::vector<Warning>& warnings)
{
  for (const Warning& warning : warnings)
  {
    vtkWarningWithObjectMacro(reader,
      "\"" << Shortened(name, LongestName) << "\": " << warning.Text << Advice(warning.Remedy)
           << ".");
  }
}

//------------------------------------------------------------------------------
/// The type of numbers that has a NaN and holds all values of another one.
int FloatingType(int type)
{
  return type == VTK_FLOAT || vtkDataArray::GetDataTypeSize(type) < 4 ? VTK_FLOAT : VTK_DOUBLE;
}
}

//------------------------------------------------------------------------------
vtkReliefRasterReader::vtkReliefRasterReader()
  : NoDataValue(std::numeric_limits<double>::quiet_NaN())
  , FileNoDataValue(std::numeric_limits<double>::quiet_NaN())
  , Place{}
  , MemoryLimit(relief::io::PhysicalMemory())
  , Header(std::make_unique<Internals>(this))
{
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkReliefRasterReader::~vtkReliefRasterReader() = default;

//------------------------------------------------------------------------------
void vtkReliefRasterReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Band: " << this->Band << "\n";
  os << indent << "Encoding: " << this->Encoding << "\n";
  os << indent << "Degrees: " << (this->Degrees ? "On\n" : "Off\n");
  os << indent << "HeightsInMeters: " << (this->HeightsInMeters ? "On\n" : "Off\n");
  os << indent << "NoDataToNaN: " << (this->NoDataToNaN ? "On\n" : "Off\n");
  os << indent << "ReadAsNeeded: " << (this->ReadAsNeeded ? "On\n" : "Off\n");
  os << indent << "NoDataFromFile: " << (this->NoDataFromFile ? "On\n" : "Off\n");
  os << indent << "NoDataValue: " << this->NoDataValue << "\n";
  os << indent << "FileNoDataValue: " << this->FileNoDataValue << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << " KiB\n";
}

//------------------------------------------------------------------------------
void vtkReliefRasterReader::SetNoDataValue(double value)
{
  if (this->NoDataValue != value && !(std::isnan(this->NoDataValue) && std::isnan(value)))
  {
    this->NoDataValue = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
static ReadOptions OptionsOf(vtkReliefRasterReader* reader)
{
  ReadOptions options;
  options.Band = reader->GetBand();
  options.Encoding = static_cast<HeightEncoding>(reader->GetEncoding());
  options.Degrees = reader->GetDegrees();
  options.NoDataFromFile = reader->GetNoDataFromFile();
  if (!std::isnan(reader->GetNoDataValue()))
  {
    options.NoData = reader->GetNoDataValue();
  }
  return options;
}

//------------------------------------------------------------------------------
double* vtkReliefRasterReader::GetPlace()
{
  std::fill_n(this->Place, 3, std::numeric_limits<double>::quiet_NaN());
  this->UpdateInformation();
  if (!this->Header->Readable)
  {
    return this->Place; // It has been reported
  }
  MapPlace place;
  std::string reason;
  const unsigned long code = Guard([&] { place = PlaceOfCenter(this->Header->Read); }, reason);
  if (code != vtkErrorCode::NoError)
  {
    const std::string name = this->FileName ? this->FileName : "";
    vtkErrorMacro("GetPlace of \"" << Shortened(name, LongestName) << "\": " << reason << ".");
    return this->Place;
  }
  this->Place[0] = place.Longitude;
  this->Place[1] = place.Latitude;
  this->Place[2] = place.Convergence;
  return this->Place;
}

//------------------------------------------------------------------------------
int vtkReliefRasterReader::CanReadFile(const char* fileName)
{
  std::string reason;
  const ReadOptions options = OptionsOf(this);
  const unsigned long code = Guard([&] { Open(fileName ? fileName : "", options); }, reason);
  return code == vtkErrorCode::NoError ? 2 : 0;
}

//------------------------------------------------------------------------------
const char* vtkReliefRasterReader::GetFileExtensions()
{
#ifdef RELIEFRASTER_USE_GDAL
  return ".tif .tiff .asc .vrt .img .dem .hgt .bil .flt .dt0 .dt1 .dt2 .nc .grd .png .jp2";
#else
  return ".asc .png .tif .tiff .bmp .pgm .jpg .jpeg";
#endif
}

//------------------------------------------------------------------------------
int vtkReliefRasterReader::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  RasterHeader header;
  std::string reason;
  const std::string name = this->FileName ? this->FileName : "";
  // Assigned, not set: SetErrorCode would mark the reader as modified.
  this->ErrorCode = Guard([&] { header = Open(name, OptionsOf(this))->GetHeader(); }, reason);
  this->Header->Readable = this->ErrorCode == vtkErrorCode::NoError;
  if (!this->Header->Readable)
  {
    vtkErrorMacro("Cannot read \"" << Shortened(name, LongestName) << "\": " << reason << ".");
    header.Columns = 0;
    header.Rows = 0;
    header.ScalarType = VTK_FLOAT;
  }
  else if (LooksLikeDegrees(header))
  {
    vtkWarningMacro("The coordinates of \"" << Shortened(name, LongestName)
                                            << "\" look like degrees, but it names no coordinate "
                                               "reference system; DegreesOn takes them as such.");
  }
  Tell(this, name, header.Warnings);
  header.Warnings.clear();
  if (!this->NoDataFromFile)
  {
    header.NoData = OptionsOf(this).NoData;
  }
  this->FileNoDataValue = header.NoData.value_or(std::numeric_limits<double>::quiet_NaN());
  if (this->HeightsInMeters)
  {
    header.Scale *= header.HeightUnit;
    header.Offset *= header.HeightUnit;
  }
  this->Header->Read = header;

  int type = header.ScalarType;
  if (IsScaled(header) || this->ReadAsNeeded)
  {
    type = VTK_FLOAT;
  }
  else if (this->NoDataToNaN && !IsFloating(type) && (header.NoData || header.Masked))
  {
    type = FloatingType(type);
  }
  const bool placed = header.Reference.Present;
  const double spacing[3] = { placed ? header.Spacing[0] : this->DataSpacing[0],
    placed ? header.Spacing[1] : this->DataSpacing[1], placed ? 1.0 : this->DataSpacing[2] };
  const int extent[6] = { 0, header.Columns - 1, 0, header.Rows - 1, 0,
    this->Header->Readable ? 0 : -1 };
  std::copy_n(extent, 6, this->DataExtent);
  this->DataScalarType = type;
  this->NumberOfScalarComponents = 1;
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* info = outputVector->GetInformationObject(port);
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(vtkDataObject::SPACING(), spacing, 3);
    info->Set(vtkDataObject::ORIGIN(), this->DataOrigin, 3);
    info->Set(vtkDataObject::DIRECTION(), DirectionMatrix(header.Direction).data(), 9);
    info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
    vtkDataObject::SetPointDataActiveScalarInfo(info, port == 0 ? type : VTK_UNSIGNED_CHAR, 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
/// What is asked for. Of the other port, which nobody may have asked, the pipeline says the whole.
static RasterFile::Window PartOf(
  vtkInformation* request, vtkInformationVector* outputs, const int whole[6])
{
  const int port = request->Has(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT())
    ? std::max(request->Get(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT()), 0)
    : 0;
  const int* asked =
    outputs->GetInformationObject(port)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT());
  if (!asked || asked[0] > asked[1] || asked[2] > asked[3])
  {
    return { whole[0], whole[1] + 1, whole[2], whole[3] + 1 };
  }
  return { std::max(asked[0], whole[0]), std::min(asked[1], whole[1]) + 1,
    std::max(asked[2], whole[2]), std::min(asked[3], whole[3]) + 1 };
}

//------------------------------------------------------------------------------
void vtkReliefRasterReader::Internals::Check(const RasterHeader& found) const
{
  if (found.Columns != this->Read.Columns || found.Rows != this->Read.Rows ||
    found.ScalarType != this->Read.ScalarType || found.Masked != this->Read.Masked)
  {
    throw Failure(vtkErrorCode::FileFormatError, "it has changed since its header was read");
  }
}

//------------------------------------------------------------------------------
/// Where the heights come from, for whoever reads the field data.
void vtkReliefRasterReader::Internals::Describe(RasterHeader told, vtkImageData* heights) const
{
  told.NoData = this->Read.NoData;
  AddFieldData(told, this->Self->DataOrigin, heights->GetFieldData());
}

//------------------------------------------------------------------------------
bool vtkReliefRasterReader::Internals::GoOn(double share) const
{
  this->Self->UpdateProgress(share);
  return !this->Self->GetAbortExecute();
}

//------------------------------------------------------------------------------
void vtkReliefRasterReader::Internals::ReadPart(
  RasterFile& file, const RasterFile::Window& part, vtkImageData* const outputs[2])
{
  // The mask takes memory, and the heights once more where they change their type or are scaled.
  const ReadOptions options = OptionsOf(this->Self);
  const int columns = part.i1 - part.i0;
  const int rows = part.j1 - part.j0;
  const bool whole =
    !file.HasWindows() || (columns == this->Read.Columns && rows == this->Read.Rows);
  const int type = this->Self->DataScalarType;
  MemoryBudget budget(1024.0 * static_cast<double>(this->Self->MemoryLimit), "MemoryLimit");
  const bool changed = type != this->Read.ScalarType || IsScaled(this->Read);
  const double besides = changed ? vtkDataArray::GetDataTypeSize(type) : 0.0;
  const MemoryPlan plan{ budget, 1.0, 1.0 + besides };
  if (!whole)
  {
    plan.Claim(columns, rows, vtkDataArray::GetDataTypeSize(this->Read.ScalarType));
  }

  // Read, and told apart what has no data.
  Raster raster = whole ? file.Read(plan, [this](double share) { return this->GoOn(share); })
                        : file.ReadWindow(part);
  raster.NoData = this->Read.NoData;
  raster.Scale = this->Read.Scale;
  raster.Offset = this->Read.Offset;
  MarkNoData(raster);
  raster.Warnings.clear();
  if (whole && (options.NoDataFromFile || options.NoData))
  {
    WarnOfUndeclaredNoData(raster); // who says that there is none has been told
  }
  Tell(this->Self, this->Self->FileName, raster.Warnings);
  const vtkSmartPointer<vtkImageData> mask = MaskOfHeights(raster);
  ApplyScale(raster);
  if (IsFloating(type))
  {
    MarkMasked(raster, mask, type);
  }
  raster.Heights->GetPointData()->GetScalars()->SetName("Heights");
  outputs[0]->ShallowCopy(raster.Heights);
  outputs[1]->ShallowCopy(mask);
  for (int port = 0; port < 2 && !whole; ++port)
  {
    outputs[port]->SetExtent(part.i0, part.i1 - 1, part.j0, part.j1 - 1, 0, 0);
  }
  this->Describe(file.GetHeader(), outputs[0]);
}

//------------------------------------------------------------------------------
void vtkReliefRasterReader::Internals::ReadTiles(
  const std::string& name, vtkImageData* output) const
{
#ifdef RELIEFRASTER_USE_GDAL
  const ReadOptions options = OptionsOf(this->Self);
  const auto file =
    std::make_shared<TiledRaster>(name, options, [name, options] { return Open(name, options); });
  this->Check(file->GetHeader());
  file->SetScaling(this->Read.Scale, this->Read.Offset);
  // Only while this goes on: the file outlives this object.
  file->SetWatcher([this](double share) { return this->GoOn(share); });
  const Raster raster = ReadTiled(file, 1.0);
  file->SetWatcher(relief::io::StepWatcher());
  if (!file->GetUndeclared().empty())
  {
    Tell(this->Self, name, { { file->GetUndeclared(), Warning::NoData } });
  }
  raster.Heights->GetPointData()->GetScalars()->SetName("Heights");
  output->ShallowCopy(raster.Heights);
  this->Describe(file->GetHeader(), output);
#else
  (void)name;
  (void)output;
  throw Failure(vtkErrorCode::FileFormatError,
    "ReadAsNeeded is on, for which this library would have to be built with GDAL");
#endif
}

//------------------------------------------------------------------------------
int vtkReliefRasterReader::RequestData(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  vtkImageData* outputs[2] = { vtkImageData::GetData(outputVector, 0),
    vtkImageData::GetData(outputVector, 1) };
  for (vtkImageData* output : outputs)
  {
    output->Initialize();
  }
  if (!this->Header->Readable)
  {
    return 1; // It has been reported
  }
  std::string reason;
  const std::string name = this->FileName ? this->FileName : "";
  this->ErrorCode = Guard(
    [&]
    {
      if (this->ReadAsNeeded)
      {
        this->Header->ReadTiles(name, outputs[0]);
        return;
      }
      const std::unique_ptr<RasterFile> file = Open(name, OptionsOf(this));
      this->Header->Check(file->GetHeader());
      this->Header->ReadPart(*file, PartOf(request, outputVector, this->DataExtent), outputs);
    },
    reason);

  for (int port = 0; port < 2; ++port)
  {
    if (this->ErrorCode != vtkErrorCode::NoError)
    {
      outputs[port]->Initialize();
      continue;
    }
    vtkInformation* info = outputVector->GetInformationObject(port);
    outputs[port]->SetSpacing(info->Get(vtkDataObject::SPACING()));
    outputs[port]->SetOrigin(info->Get(vtkDataObject::ORIGIN()));
    outputs[port]->SetDirectionMatrix(info->Get(vtkDataObject::DIRECTION()));
  }
  if (!reason.empty())
  {
    this->Header->Readable = false;
    vtkErrorMacro("Cannot read \"" << Shortened(name, LongestName) << "\": " << reason << ".");
  }
  return 1;
}

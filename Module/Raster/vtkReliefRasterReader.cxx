// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefRasterReader.h"

#include "HeightEncoding.h"
#include "MapPlace.h"
#include "OtherContent.h"
#include "RasterFieldData.h"
#include "RasterFile.h"
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
  , Header(std::make_unique<Internals>())
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
  if (IsScaled(header))
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
    vtkDataObject::SetPointDataActiveScalarInfo(info, port == 0 ? type : VTK_UNSIGNED_CHAR, 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkReliefRasterReader::RequestData(vtkInformation* vtkNotUsed(request),
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
      const ReadOptions options = OptionsOf(this);
      const std::unique_ptr<RasterFile> file = Open(name, options);
      const RasterHeader& expected = this->Header->Read;
      const RasterHeader& found = file->GetHeader();
      if (found.Columns != expected.Columns || found.Rows != expected.Rows ||
        found.ScalarType != expected.ScalarType || found.Masked != expected.Masked)
      {
        throw Failure(vtkErrorCode::FileFormatError, "it has changed since its header was read");
      }
      const auto goOn = [this](double share)
      {
        this->UpdateProgress(share);
        return !this->GetAbortExecute();
      };
      MemoryBudget budget(1024.0 * static_cast<double>(this->MemoryLimit), "MemoryLimit");
      // The mask, and the heights once more where they change their type or are scaled.
      const bool changed = this->DataScalarType != expected.ScalarType || IsScaled(expected);
      const double besides = changed ? vtkDataArray::GetDataTypeSize(this->DataScalarType) : 0.0;
      Raster raster = file->Read({ budget, 1.0, 1.0 + besides }, goOn);
      raster.NoData = expected.NoData;
      raster.Scale = expected.Scale;
      raster.Offset = expected.Offset;
      MarkNoData(raster);
      raster.Warnings.clear();
      if (options.NoDataFromFile || options.NoData)
      {
        WarnOfUndeclaredNoData(raster); // who says that there is none has been told
      }
      Tell(this, name, raster.Warnings);
      const vtkSmartPointer<vtkImageData> mask = MaskOfHeights(raster);
      ApplyScale(raster);
      if (IsFloating(this->DataScalarType))
      {
        MarkMasked(raster, mask, this->DataScalarType);
      }
      raster.Heights->GetPointData()->GetScalars()->SetName("Heights");
      outputs[0]->ShallowCopy(raster.Heights);
      outputs[1]->ShallowCopy(mask);
      RasterHeader told = file->GetHeader();
      told.NoData = expected.NoData;
      AddFieldData(told, this->DataOrigin, outputs[0]->GetFieldData());
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

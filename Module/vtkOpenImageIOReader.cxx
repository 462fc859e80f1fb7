// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenImageIOReader.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFilteringInformationKeyManager.h" // The reader registered below needs the keys
#include "vtkImageData.h"
#include "vtkImageReader2Factory.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "ImageFileAccess.h"
#include "ImageFileAttributes.h"
#include "ImageFileChecks.h"

#include <vtksys/SystemTools.hxx>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <memory>
#include <set>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkOpenImageIOReader);

namespace
{
using OIIO::TypeDesc;
using relief::io::Aborted;
using relief::io::AddAttributes;
using relief::io::CheckHeader;
using relief::io::Failure;
using relief::io::Guard;
using relief::io::OneLine;
using relief::io::VTKType;

// How the columns x and rows y of the file become the columns i and rows j of the image: swapped
// for the orientations of a camera held upright, then each mirrored or not.
struct Mapping
{
  Mapping(int orientation, int fileWidth, int fileHeight)
    : Swap(orientation >= 5 && orientation <= 8)
    , MirrorI(orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7)
    , MirrorJ(!(orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8))
    , Width(this->Swap ? fileHeight : fileWidth)
    , Height(this->Swap ? fileWidth : fileHeight)
  {
  }
  void ToImage(int x, int y, int& i, int& j) const
  {
    const int a = this->Swap ? y : x;
    const int b = this->Swap ? x : y;
    i = this->MirrorI ? this->Width - 1 - a : a;
    j = this->MirrorJ ? this->Height - 1 - b : b;
  }
  int FileRow(int i, int j) const
  {
    const int a = this->MirrorI ? this->Width - 1 - i : i;
    const int b = this->MirrorJ ? this->Height - 1 - j : j;
    return this->Swap ? a : b;
  }

  bool Swap;
  bool MirrorI;
  bool MirrorJ;
  int Width;
  int Height;
};

// An open file, at the picture that was asked for.
struct Picture
{
  Picture(const char* fileName, int subimage, int mipLevel, vtkTypeInt64 memoryLimit);

  std::unique_ptr<OIIO::ImageInput> Input;
  OIIO::ImageSpec Spec;
  int ScalarType = VTK_VOID;
  int Orientation = 1;
};

Picture::Picture(const char* fileName, int subimage, int mipLevel, vtkTypeInt64 memoryLimit)
{
  using vtksys::SystemTools;
  if (!fileName || !*fileName)
  {
    throw Failure(vtkErrorCode::NoFileNameError, "no file name is set");
  }
  // OpenImageIO tells these cases by texts that differ from format to format, or not at all.
  if (!SystemTools::FileExists(fileName))
  {
    throw Failure(vtkErrorCode::FileNotFoundError, "the file does not exist");
  }
  if (SystemTools::FileIsDirectory(fileName))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError, "it is a directory");
  }
  if (!SystemTools::TestFileAccess(fileName, vtksys::TEST_FILE_READ))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError, "there is no permission to read it");
  }
  if (SystemTools::FileLength(fileName) == 0)
  {
    throw Failure(vtkErrorCode::PrematureEndOfFileError, "the file is empty");
  }

  CheckHeader(fileName, memoryLimit);

  // Colours stored beside an alpha that does not multiply them are to stay so.
  OIIO::ImageSpec configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);
  this->Input = OIIO::ImageInput::open(fileName, &configuration);
  if (!this->Input)
  {
    throw Failure(vtkErrorCode::UnrecognizedFileTypeError, OneLine(OIIO::geterror()));
  }
  if (!this->Input->seek_subimage(subimage, mipLevel))
  {
    this->Input->geterror(); // An error that nobody fetched would be printed
    throw Failure(vtkErrorCode::FileFormatError,
      "it has no subimage " + std::to_string(subimage) + " at MIP level " +
        std::to_string(mipLevel));
  }
  this->Spec = this->Input->spec();
  const OIIO::ImageSpec& spec = this->Spec;
  if (spec.deep)
  {
    throw Failure(vtkErrorCode::FileFormatError, "it holds deep samples; flat pictures are read");
  }
  if (spec.depth > 1)
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "it holds a volume of " + std::to_string(spec.depth) + " slices; flat pictures are read");
  }
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "its header gives " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
        " pixels of " + std::to_string(spec.nchannels) + " channels");
  }
  this->ScalarType = VTKType(spec.format);
  if (this->ScalarType == VTK_VOID)
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "its pixels have the type " + std::string(spec.format.c_str()) + ", which is not read");
  }
  this->Orientation = spec.get_int_attribute("Orientation", 1);
  // GIF gives a number behind its last channel.
  if (spec.alpha_channel >= spec.nchannels)
  {
    const auto& names = spec.channelnames;
    const auto alpha = std::find(names.begin(), names.end(), "A") - names.begin();
    this->Spec.alpha_channel = alpha < spec.nchannels ? static_cast<int>(alpha) : -1;
  }
}

// The channel that becomes a point array of its own; -1 for none.
int SeparateChannel(const OIIO::ImageSpec& spec, bool alphaAsMask)
{
  return alphaAsMask && spec.nchannels > 1 ? spec.alpha_channel : -1;
}

// How a picture's rows are read: in bands of about 4 MiB, large enough for OpenImageIO to decode in
// parallel, small beside the image. They begin at whole tiles, and at whole compressed blocks of
// the usual heights.
struct Bands
{
  explicit Bands(const OIIO::ImageSpec& spec)
    : Tiled(spec.tile_width > 0)
    , Format(spec.format.basetype == TypeDesc::HALF ? TypeDesc(TypeDesc::FLOAT) : spec.format)
    , RowBytes(static_cast<size_t>(spec.width) * spec.nchannels * this->Format.size())
    , Granule(std::min(this->Tiled ? std::max(spec.tile_height, 1) : 64, spec.height))
    , Rows(spec.height)
  {
    const size_t granules = std::max<size_t>(1, (4 << 20) / this->RowBytes / this->Granule);
    if (granules < static_cast<size_t>((spec.height + this->Granule - 1) / this->Granule))
    {
      this->Rows = static_cast<int>(granules) * this->Granule;
    }
  }

  bool Tiled;
  TypeDesc Format;
  size_t RowBytes;
  int Granule;
  int Rows; // of a band
};

void RefuseBeyond(vtkTypeInt64 limit, const Picture& picture)
{
  const OIIO::ImageSpec& spec = picture.Spec;
  // In floating point, for the product of four absurd numbers overflows integers.
  const double pixelBytes =
    static_cast<double>(spec.nchannels) * vtkDataArray::GetDataTypeSize(picture.ScalarType);
  const double rowBytes = pixelBytes * spec.width;
  // The mask adds a byte. A band is read, and decoded from tiles that may be larger.
  const double outputs = (pixelBytes + 1.0) * spec.width * spec.height;
  const double band = std::max(std::min(rowBytes * spec.height, 4.0 * 1024.0 * 1024.0),
    rowBytes * std::min(spec.tile_width > 0 ? spec.tile_height : 64, spec.height));
  const double tile = pixelBytes * spec.tile_width * spec.tile_height;
  const double needed = (outputs + band + tile) / 1024.0;
  if (limit > 0 && needed > static_cast<double>(limit))
  {
    std::ostringstream text;
    text << "its header gives " << spec.width << " x " << spec.height << " pixels of "
         << spec.nchannels << " channels";
    if (spec.tile_width > 0)
    {
      text << " in tiles of " << spec.tile_width << " x " << spec.tile_height;
    }
    text << ", which need " << std::fixed << std::setprecision(0) << std::ceil(needed)
         << " KiB of memory; MemoryLimit is " << limit << " KiB";
    throw Failure(vtkErrorCode::FileFormatError, text.str());
  }
}

// Where the pixels go. Each output has the part of the image that was asked of it.
struct Targets
{
  int ImageExtent[6];
  int MaskExtent[6];
  void* Scalars = nullptr;
  void* Alpha = nullptr;
  unsigned char* Mask = nullptr;
};

bool IsEmpty(const int extent[6])
{
  return extent[1] < extent[0] || extent[3] < extent[2] || extent[5] < extent[4];
}

// The number of a sample in an array of that extent; -1 outside.
vtkIdType SampleIndex(const int extent[6], int i, int j)
{
  if (i < extent[0] || i > extent[1] || j < extent[2] || j > extent[3])
  {
    return -1;
  }
  return static_cast<vtkIdType>(j - extent[2]) * (extent[1] - extent[0] + 1) + (i - extent[0]);
}

template <typename T>
void PlaceRows(const T* rows, int yBegin, int yEnd, const OIIO::ImageSpec& spec,
  const Mapping& mapping, const Targets& targets)
{
  const int separate = targets.Alpha ? spec.alpha_channel : -1;
  const int components = spec.nchannels - (separate >= 0 ? 1 : 0);
  const T* pixel = rows;
  for (int y = yBegin; y < yEnd; ++y)
  {
    for (int x = 0; x < spec.width; ++x, pixel += spec.nchannels)
    {
      int i;
      int j;
      mapping.ToImage(x, y, i, j);
      const vtkIdType sample = SampleIndex(targets.ImageExtent, i, j);
      if (sample >= 0)
      {
        T* scalars = static_cast<T*>(targets.Scalars) + sample * components;
        for (int c = 0; c < spec.nchannels; ++c)
        {
          if (c != separate)
          {
            *scalars++ = pixel[c];
          }
        }
        if (separate >= 0)
        {
          static_cast<T*>(targets.Alpha)[sample] = pixel[separate];
        }
      }
      const vtkIdType masked = SampleIndex(targets.MaskExtent, i, j);
      if (masked >= 0)
      {
        // Written so that an alpha that is not a number hides the sample.
        const bool visible = spec.alpha_channel < 0 || pixel[spec.alpha_channel] > T(0);
        targets.Mask[masked] = visible ? 255 : 0;
      }
    }
  }
}

// Reads the rows that the targets need, band by band.
void ReadPixels(vtkAlgorithm* self, Picture& picture, int subimage, int mipLevel,
  const Mapping& mapping, const Targets& targets)
{
  const OIIO::ImageSpec& spec = picture.Spec;
  int yBegin = spec.height;
  int yEnd = 0;
  for (const int* extent : { targets.ImageExtent, targets.MaskExtent })
  {
    if (!IsEmpty(extent))
    {
      const int first = mapping.FileRow(extent[0], extent[2]);
      const int last = mapping.FileRow(extent[1], extent[3]);
      yBegin = std::min({ yBegin, first, last });
      yEnd = std::max({ yEnd, first + 1, last + 1 });
    }
  }

  const Bands bands(spec);
  yBegin = yBegin / bands.Granule * bands.Granule;
  std::vector<unsigned char> band(bands.RowBytes * bands.Rows);
  for (int y = yBegin; y < yEnd; y += bands.Rows)
  {
    if (self->GetAbortExecute())
    {
      throw Aborted();
    }
    // Tiles are read whole, to the image's last row.
    const int end = std::min(y + bands.Rows, bands.Tiled ? spec.height : yEnd);
    const bool read = bands.Tiled
      ? picture.Input->read_tiles(subimage, mipLevel, spec.x, spec.x + spec.width, spec.y + y,
          spec.y + end, spec.z, spec.z + 1, 0, spec.nchannels, bands.Format, band.data())
      : picture.Input->read_scanlines(subimage, mipLevel, spec.y + y, spec.y + end, spec.z, 0,
          spec.nchannels, bands.Format, band.data());
    const std::string text = picture.Input->geterror();
    // JPEG fills in grey for what is missing and only notes it, as TIFF does where it decodes
    // strips in parallel; their other notes are harmless.
    const bool noted = text.find("remature end") != std::string::npos ||
      text.find("ead error") != std::string::npos || text.find("failed") != std::string::npos;
    if (!read || noted)
    {
      throw Failure(vtkErrorCode::PrematureEndOfFileError,
        "its pixels end early or are damaged: " + OneLine(text));
    }
    if (!text.empty())
    {
      vtkWarningWithObjectMacro(
        self, "Reading \"" << picture.Input->format_name() << "\": " << OneLine(text) << ".");
    }
    switch (picture.ScalarType)
    {
      vtkTemplateMacro(
        PlaceRows(reinterpret_cast<const VTK_TT*>(band.data()), y, end, spec, mapping, targets));
    }
    self->UpdateProgress(std::min(1.0, static_cast<double>(end - yBegin) / (yEnd - yBegin)));
  }
  if (self->GetAbortExecute())
  {
    throw Aborted();
  }
}

// The part of the image that output `port` is to have. An output that nobody is connected to and
// nobody asked for goes along with the one that was asked for, so that GetOutput finds it filled.
void RequestedExtent(
  vtkInformation* request, vtkInformationVector* outputs, int port, int extent[6])
{
  const int asked = std::max(0, request->Get(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT()));
  vtkInformation* info = outputs->GetInformationObject(port);
  const bool connected =
    info->Has(vtkExecutive::CONSUMERS()) && vtkExecutive::CONSUMERS()->Length(info) > 0;
  vtkInformation* source = connected ? info : outputs->GetInformationObject(asked);
  source->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
}

// VTK asks the readers in the order in which they were registered, its own first.
struct Registration
{
  Registration()
  {
    vtkNew<vtkOpenImageIOReader> reader;
    vtkImageReader2Factory::RegisterReader(reader);
  }
};
const Registration registration;
}

//------------------------------------------------------------------------------
vtkOpenImageIOReader::vtkOpenImageIOReader()
  : MemoryLimit(relief::io::PhysicalMemory())
{
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkOpenImageIOReader::~vtkOpenImageIOReader() = default;

//------------------------------------------------------------------------------
void vtkOpenImageIOReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Subimage: " << this->Subimage << "\n";
  os << indent << "MipLevel: " << this->MipLevel << "\n";
  os << indent << "AlphaAsMask: " << (this->AlphaAsMask ? "On\n" : "Off\n");
  os << indent << "MemoryLimit: " << this->MemoryLimit << " KiB\n";
}

//------------------------------------------------------------------------------
int vtkOpenImageIOReader::CanReadFile(const char* fileName)
{
  std::string reason;
  return Guard([&] { Picture(fileName, 0, 0, this->MemoryLimit); }, reason) == vtkErrorCode::NoError
    ? 2
    : 0;
}

//------------------------------------------------------------------------------
const char* vtkOpenImageIOReader::GetFileExtensions()
{
  static const std::string extensions = []
  {
    std::string result;
    std::set<std::string> readable;
    const std::string formats = OIIO::get_string_attribute("input_format_list");
    std::istringstream list(formats);
    for (std::string format; std::getline(list, format, ',');)
    {
      readable.insert(format);
    }
    // "null" is no file format: it makes up pixels for OpenImageIO's own tests.
    readable.erase("null");
    for (const auto& entry : OIIO::get_extension_map())
    {
      if (readable.count(entry.first))
      {
        for (const std::string& extension : entry.second)
        {
          result += (result.empty() ? "." : " .") + extension;
        }
      }
    }
    return result;
  }();
  return extensions.c_str();
}

//------------------------------------------------------------------------------
int vtkOpenImageIOReader::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  // An empty extent stands until the header has been read. Success is returned whatever comes: the
  // pipeline would add an error of its own that says nothing more.
  const int empty[6] = { 0, -1, 0, -1, 0, -1 };
  std::copy_n(empty, 6, this->DataExtent);
  std::string reason;
  // Assigned, not set: SetErrorCode would mark the reader as modified.
  this->ErrorCode = Guard(
    [&]
    {
      const Picture picture(this->FileName, this->Subimage, this->MipLevel, this->MemoryLimit);
      RefuseBeyond(this->MemoryLimit, picture);
      const OIIO::ImageSpec& spec = picture.Spec;
      const Mapping mapping(picture.Orientation, spec.width, spec.height);
      const int extent[6] = { 0, mapping.Width - 1, 0, mapping.Height - 1, 0, 0 };
      std::copy_n(extent, 6, this->DataExtent);
      this->DataScalarType = picture.ScalarType;
      this->NumberOfScalarComponents =
        spec.nchannels - (SeparateChannel(spec, this->AlphaAsMask) >= 0 ? 1 : 0);
    },
    reason);
  this->Readable = this->ErrorCode == vtkErrorCode::NoError;
  if (!this->Readable)
  {
    vtkErrorMacro(
      "Cannot read \"" << (this->FileName ? this->FileName : "") << "\": " << reason << ".");
  }

  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* info = outputVector->GetInformationObject(port);
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->DataExtent, 6);
    info->Set(vtkDataObject::SPACING(), this->DataSpacing, 3);
    info->Set(vtkDataObject::ORIGIN(), this->DataOrigin, 3);
    info->Set(vtkDataObject::DIRECTION(), this->DataDirection, 9);
    info->Set(CAN_PRODUCE_SUB_EXTENT(), 1);
    vtkDataObject::SetPointDataActiveScalarInfo(info,
      port == 0 ? this->DataScalarType : VTK_UNSIGNED_CHAR,
      port == 0 ? this->NumberOfScalarComponents : 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkOpenImageIOReader::RequestData(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  vtkImageData* image = vtkImageData::GetData(outputVector, 0);
  vtkImageData* mask = vtkImageData::GetData(outputVector, 1);
  image->Initialize();
  mask->Initialize();
  if (!this->Readable)
  {
    return 1; // It has been reported
  }

  std::string reason;
  this->ErrorCode = Guard(
    [&]
    {
      Picture picture(this->FileName, this->Subimage, this->MipLevel, this->MemoryLimit);
      const OIIO::ImageSpec& spec = picture.Spec;
      const Mapping mapping(picture.Orientation, spec.width, spec.height);
      const bool separate = SeparateChannel(spec, this->AlphaAsMask) >= 0;
      if (mapping.Width != this->DataExtent[1] + 1 || mapping.Height != this->DataExtent[3] + 1 ||
        picture.ScalarType != this->DataScalarType ||
        spec.nchannels - (separate ? 1 : 0) != this->NumberOfScalarComponents)
      {
        throw Failure(vtkErrorCode::FileFormatError, "it has changed since its header was read");
      }

      Targets targets;
      RequestedExtent(request, outputVector, 0, targets.ImageExtent);
      RequestedExtent(request, outputVector, 1, targets.MaskExtent);
      if (!IsEmpty(targets.ImageExtent))
      {
        image->SetExtent(targets.ImageExtent);
        image->AllocateScalars(this->DataScalarType, this->NumberOfScalarComponents);
        targets.Scalars = image->GetPointData()->GetScalars()->GetVoidPointer(0);
        if (separate)
        {
          vtkSmartPointer<vtkDataArray> alpha;
          alpha.TakeReference(vtkDataArray::CreateDataArray(this->DataScalarType));
          alpha->SetName("Alpha");
          alpha->SetNumberOfTuples(image->GetNumberOfPoints());
          image->GetPointData()->AddArray(alpha);
          targets.Alpha = alpha->GetVoidPointer(0);
        }
      }
      if (!IsEmpty(targets.MaskExtent))
      {
        mask->SetExtent(targets.MaskExtent);
        mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
        mask->GetPointData()->GetScalars()->SetName("Mask");
        targets.Mask = static_cast<unsigned char*>(mask->GetScalarPointer());
      }
      AddAttributes(spec, image->GetFieldData());
      ReadPixels(this, picture, this->Subimage, this->MipLevel, mapping, targets);
    },
    reason);

  if (this->ErrorCode != vtkErrorCode::NoError)
  {
    image->Initialize();
    mask->Initialize();
  }
  if (!reason.empty())
  {
    this->Readable = false;
    vtkErrorMacro("Cannot read \"" << this->FileName << "\": " << reason << ".");
  }
  return 1;
}

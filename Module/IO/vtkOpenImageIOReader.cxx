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

#include "ImageFileAttributes.h"
#include "OpenedPicture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <memory>
#include <set>
#include <sstream>
#include <type_traits>
#include <vector>

vtkStandardNewMacro(vtkOpenImageIOReader);

namespace
{
using OIIO::TypeDesc;
using relief::io::Aborted;
using relief::io::AddAttributes;
using relief::io::Failure;
using relief::io::Guard;
using relief::io::OneLine;
using relief::io::Picture;
using relief::io::Request;

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

Request MakeRequest(vtkOpenImageIOReader* reader)
{
  const auto text = [](const char* given) { return std::string(given ? given : ""); };
  Request request;
  request.FileName = text(reader->GetFileName());
  request.Subimage = reader->GetSubimage();
  request.SubimageName = text(reader->GetSubimageName());
  request.ChannelName = text(reader->GetChannelName());
  request.MipLevel = reader->GetMipLevel();
  request.AlphaAsMask = reader->GetAlphaAsMask() != 0;
  request.StraightAlpha = reader->GetStraightAlpha() != 0;
  request.MemoryLimit = reader->GetMemoryLimit();
  return request;
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

// Divides the colours of floating point pixels.
template <typename T>
void Divide(T* pixel, int channel, double divisor, std::true_type)
{
  pixel[channel] = static_cast<T>(pixel[channel] / divisor);
}

// Those of integers, of which 1 is the largest.
template <typename T>
void Divide(T* pixel, int channel, double divisor, std::false_type)
{
  const auto largest = static_cast<double>(std::numeric_limits<T>::max());
  pixel[channel] = static_cast<T>(std::min(largest, std::floor(pixel[channel] / divisor + 0.5)));
}

// Makes the colours those that the file means.
template <typename T>
void MakeStraight(T* pixels, size_t count, const Picture& picture)
{
  using IsFloating = std::is_floating_point<T>;
  const OIIO::ImageSpec& spec = picture.Spec;
  const double one = IsFloating::value ? 1.0 : static_cast<double>(std::numeric_limits<T>::max());
  const bool exposed = picture.Exposure != std::array<double, 3>{ 1.0, 1.0, 1.0 };
  for (T* pixel = pixels; pixel != pixels + count * spec.nchannels; pixel += spec.nchannels)
  {
    for (int c = 0; exposed && c < std::min(spec.nchannels, 3); ++c)
    {
      Divide(pixel, c, picture.Exposure[c], IsFloating());
    }
    const double alpha = picture.DividedByAlpha ? pixel[spec.alpha_channel] / one : 1.0;
    for (int c = 0; alpha > 0.0 && alpha < 1.0 && c < spec.nchannels; ++c)
    {
      if (c != spec.alpha_channel && c != spec.z_channel)
      {
        Divide(pixel, c, alpha, IsFloating());
      }
    }
  }
}

template <typename T>
void PlaceRows(T* rows, int yBegin, int yEnd, const Picture& picture, const Mapping& mapping,
  const Targets& targets)
{
  const OIIO::ImageSpec& spec = picture.Spec;
  const int separate = targets.Alpha ? spec.alpha_channel : -1;
  const int components = picture.Components();
  MakeStraight(rows, static_cast<size_t>(yEnd - yBegin) * spec.width, picture);
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
          if (picture.Channel >= 0 ? c == picture.Channel : c != separate)
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
void ReadPixels(vtkAlgorithm* self, Picture& picture, int mipLevel, const Mapping& mapping,
  const Targets& targets)
{
  const int subimage = picture.Subimage;
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
        PlaceRows(reinterpret_cast<VTK_TT*>(band.data()), y, end, picture, mapping, targets));
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

struct Registration
{
  Registration() { vtkOpenImageIOReader::RegisterWithFactory(); }
};
const Registration registration;
}

//------------------------------------------------------------------------------
// VTK asks the readers in the order in which they were registered, its own first.
void vtkOpenImageIOReader::RegisterWithFactory()
{
  static const bool registered = []
  {
    vtkNew<vtkOpenImageIOReader> reader;
    vtkImageReader2Factory::RegisterReader(reader);
    return true;
  }();
  static_cast<void>(registered);
}

//------------------------------------------------------------------------------
vtkOpenImageIOReader::vtkOpenImageIOReader()
  : MemoryLimit(relief::io::PhysicalMemory())
{
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkOpenImageIOReader::~vtkOpenImageIOReader()
{
  this->SetSubimageName(nullptr);
  this->SetChannelName(nullptr);
}

//------------------------------------------------------------------------------
void vtkOpenImageIOReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Subimage: " << this->Subimage << "\n";
  os << indent << "SubimageName: " << (this->SubimageName ? this->SubimageName : "(none)") << "\n";
  os << indent << "ChannelName: " << (this->ChannelName ? this->ChannelName : "(none)") << "\n";
  os << indent << "StraightAlpha: " << (this->StraightAlpha ? "On\n" : "Off\n");
  os << indent << "MipLevel: " << this->MipLevel << "\n";
  os << indent << "AlphaAsMask: " << (this->AlphaAsMask ? "On\n" : "Off\n");
  os << indent << "MemoryLimit: " << this->MemoryLimit << " KiB\n";
}

//------------------------------------------------------------------------------
int vtkOpenImageIOReader::CanReadFile(const char* fileName)
{
  std::string reason;
  Request request = MakeRequest(this);
  request.FileName = fileName ? fileName : "";
  request.Subimage = 0;
  request.SubimageName.clear();
  request.ChannelName.clear();
  request.MipLevel = 0;
  return Guard([&] { Picture picture(request); }, reason) == vtkErrorCode::NoError ? 2 : 0;
}

//------------------------------------------------------------------------------
int vtkOpenImageIOReader::GetNumberOfFileChannels()
{
  return static_cast<int>(this->FileChannels.size());
}

//------------------------------------------------------------------------------
std::string vtkOpenImageIOReader::GetFileChannelName(int channel)
{
  const bool known = channel >= 0 && channel < this->GetNumberOfFileChannels();
  return known ? this->FileChannels[channel] : std::string();
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
void vtkOpenImageIOReader::Report()
{
  const std::string name = this->FileName ? this->FileName : "";
  vtkErrorMacro("Cannot read \"" << relief::io::Shortened(name, relief::io::LongestName)
                                 << "\": " << relief::io::Brief(this->ErrorReason) << ".");
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
      this->FileChannels.clear();
      const Picture picture(MakeRequest(this));
      this->FileChannels = picture.Spec.channelnames;
      RefuseBeyond(this->MemoryLimit, picture);
      const OIIO::ImageSpec& spec = picture.Spec;
      const Mapping mapping(picture.Orientation, spec.width, spec.height);
      const int extent[6] = { 0, mapping.Width - 1, 0, mapping.Height - 1, 0, 0 };
      std::copy_n(extent, 6, this->DataExtent);
      this->DataScalarType = picture.ScalarType;
      this->NumberOfScalarComponents = picture.Components();
    },
    reason);
  this->Readable = this->ErrorCode == vtkErrorCode::NoError;
  this->ErrorReason = reason;
  if (!this->Readable)
  {
    this->Report();
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
      Picture picture(MakeRequest(this));
      const OIIO::ImageSpec& spec = picture.Spec;
      const Mapping mapping(picture.Orientation, spec.width, spec.height);
      const bool separate = picture.Separate >= 0;
      if (mapping.Width != this->DataExtent[1] + 1 || mapping.Height != this->DataExtent[3] + 1 ||
        picture.ScalarType != this->DataScalarType ||
        picture.Components() != this->NumberOfScalarComponents)
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
      ReadPixels(this, picture, this->MipLevel, mapping, targets);
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
    this->ErrorReason = reason;
    this->Report();
  }
  return 1;
}

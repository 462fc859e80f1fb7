// SPDX-License-Identifier: BSD-3-Clause
#include "LayerFile.h"

#include "SceneMetadata.h"
#include "TemporaryFile.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfTiledOutputFile.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

namespace relief::io
{
namespace
{
const std::size_t LongestChannel = 255; // OpenEXR cuts off what is longer

/// One component of an array as the file has it.
struct Channel
{
  std::string Name;
  vtkDataArray* Array;
  int Component;
  Imf::PixelType Type;

  std::size_t ValueBytes() const { return this->Type == Imf::HALF ? 2 : 4; }
};

//------------------------------------------------------------------------------
/// What the components of a layer are called.
std::string Suffixes(vtkPointData* data, vtkDataArray* array)
{
  const int components = array->GetNumberOfComponents();
  const std::string name = array->GetName() ? array->GetName() : "";
  if (components == 1)
  {
    return name == "Thickness" ? "Z" : "Y";
  }
  const bool direction =
    name == "Normals" || array == data->GetNormals() || array == data->GetVectors();
  return components == 3 && direction ? "XYZ" : std::string("RGBA").substr(0, components);
}

//------------------------------------------------------------------------------
void CheckArray(vtkImageData* image, vtkAbstractArray* array, const std::string& what)
{
  const int components = array->GetNumberOfComponents();
  const bool real = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  std::ostringstream text;
  if (!real || components == 2 || components > 4 || components < 1)
  {
    text << what << " " << components << " component" << (components == 1 ? "" : "s") << " of type "
         << array->GetDataTypeAsString() << "; 1, 3 or 4 of float or double are expected";
    if (array == image->GetPointData()->GetScalars() && !real)
    {
      text << ", linear colour as from vtkImageReliefShading with SetOutputScalarTypeToFloat";
    }
    throw Failure(vtkErrorCode::FileFormatError, text.str());
  }
  if (array->GetNumberOfTuples() < image->GetNumberOfPoints())
  {
    text << what << " " << array->GetNumberOfTuples() << " values for "
         << image->GetNumberOfPoints() << " points";
    throw Failure(vtkErrorCode::UnknownError, text.str());
  }
}

//------------------------------------------------------------------------------
void AddChannels(bool half, vtkDataArray* array, const std::string& prefix,
  const std::string& suffixes, std::vector<Channel>& channels)
{
  half = half && suffixes.size() > 1;
  for (std::size_t c = 0; c < suffixes.size(); ++c)
  {
    channels.push_back(
      { prefix + suffixes[c], array, static_cast<int>(c), half ? Imf::HALF : Imf::FLOAT });
    if (channels.back().Name.size() > LongestChannel)
    {
      throw Failure(vtkErrorCode::FileFormatError,
        "the layer's name \"" + prefix.substr(0, 40) + "...\" is longer than OpenEXR's " +
          std::to_string(LongestChannel) + " characters");
    }
  }
}

//------------------------------------------------------------------------------
std::vector<Channel> FindChannels(vtkImageData* image, bool half)
{
  std::vector<Channel> channels;
  vtkPointData* data = image->GetPointData();
  vtkDataArray* scalars = data->GetScalars();
  CheckArray(image, scalars, "the scalars have");
  const int components = scalars->GetNumberOfComponents();
  AddChannels(
    half, scalars, "", components == 1 ? "Y" : std::string("RGBA").substr(0, components), channels);
  for (int a = 0; a < data->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* array = data->GetAbstractArray(a);
    const std::string name = array->GetName() ? array->GetName() : "";
    if (array == scalars || name == vtkDataSetAttributes::GhostArrayName())
    {
      continue;
    }
    if (name.empty())
    {
      throw Failure(vtkErrorCode::FileFormatError,
        "point array " + std::to_string(a) + " has no name, which its layer needs");
    }
    CheckArray(image, array, "the point array \"" + name + "\" has");
    auto* layer = vtkDataArray::SafeDownCast(array);
    AddChannels(half, layer, name + ".", Suffixes(data, layer), channels);
  }
  return channels;
}

//------------------------------------------------------------------------------
Imf::Header MakeHeader(
  vtkImageData* place, const std::vector<Channel>& channels, const LayerForm& form)
{
  static const Imf::Compression compressions[] = { Imf::NO_COMPRESSION, Imf::ZIPS_COMPRESSION,
    Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::DWAA_COMPRESSION };
  int dimensions[3];
  place->GetDimensions(dimensions);
  Imf::Header header(dimensions[0], dimensions[1]);
  header.compression() = compressions[form.Compression];
  if (header.compression() == Imf::DWAA_COMPRESSION)
  {
    header.dwaCompressionLevel() = static_cast<float>(form.DWALevel);
  }
  if (form.TileSize > 0)
  {
    header.setTileDescription(Imf::TileDescription(form.TileSize, form.TileSize, Imf::ONE_LEVEL));
  }
  for (const Channel& channel : channels)
  {
    header.channels().insert(channel.Name, Imf::Channel(channel.Type));
  }
  Imf::addChromaticities(header, Imf::Chromaticities()); // their default is Rec. 709
  const std::string wrong = AddMetadata(place, form.Scene, header);
  if (!wrong.empty())
  {
    throw Failure(vtkErrorCode::UnknownError, wrong);
  }
  for (const auto& attribute : form.Attributes)
  {
    header.insert(attribute.first, Imf::StringAttribute(attribute.second));
  }
  return header;
}

//------------------------------------------------------------------------------
/// OpenEXR's way into the temporary file.
class Stream : public Imf::OStream
{
public:
  explicit Stream(TemporaryFile& file)
    : Imf::OStream(file.Name().c_str())
    , File(file)
  {
  }

  void write(const char text[], int count) override
  {
    if (this->File.Write(text, static_cast<std::size_t>(count)) != static_cast<std::size_t>(count))
    {
      throw Iex::IoExc("the file cannot be written");
    }
  }
  uint64_t tellp() override { return static_cast<uint64_t>(this->File.Tell()); }
  void seekp(uint64_t position) override
  {
    if (!this->File.Seek(static_cast<int64_t>(position)))
    {
      throw Iex::IoExc("the file cannot be written");
    }
  }

private:
  TemporaryFile& File;
};

//------------------------------------------------------------------------------
/// Turns values into the file's; finite ones stay finite.
template <typename File>
class Conversion
{
public:
  explicit Conversion(double noData)
    : NoData(static_cast<File>(static_cast<float>(noData)))
  {
  }

  File operator()(double value)
  {
    const double largest = std::numeric_limits<File>::max();
    if (std::isnan(value))
    {
      return this->NoData;
    }
    if (std::abs(value) > largest && !std::isinf(value))
    {
      ++this->Clamped;
      value = std::copysign(largest, value);
    }
    return static_cast<File>(static_cast<float>(value));
  }

  vtkIdType Clamped = 0;

private:
  File NoData;
};

template <typename Value, typename File>
vtkIdType CopyRow(const Value* values, int count, int stride, double noData, char* row)
{
  Conversion<File> convert(noData);
  auto* out = reinterpret_cast<File*>(row);
  for (int i = 0; i < count; ++i)
  {
    out[i] = convert(values[static_cast<std::size_t>(i) * stride]);
  }
  return convert.Clamped;
}

template <typename Value>
vtkIdType CopyRow(const Channel& channel, std::size_t first, int count, double noData, char* row)
{
  const int stride = channel.Array->GetNumberOfComponents();
  const Value* values = static_cast<const Value*>(channel.Array->GetVoidPointer(0)) +
    first * stride + channel.Component;
  return channel.Type == Imf::HALF ? CopyRow<Value, half>(values, count, stride, noData, row)
                                   : CopyRow<Value, float>(values, count, stride, noData, row);
}

//------------------------------------------------------------------------------
/// The bytes of a row in memory: channel after channel, each where its numbers are aligned.
std::size_t PlaneBytes(const Channel& channel, int columns)
{
  constexpr std::size_t aligned = sizeof(float);
  const std::size_t bytes = channel.ValueBytes() * static_cast<std::size_t>(columns);
  return (bytes + aligned - 1) / aligned * aligned;
}

bool IsAlike(const Channel& a, const Channel& b)
{
  return a.Name == b.Name && a.Type == b.Type;
}
}

//------------------------------------------------------------------------------
struct LayerFile::Internals
{
  Internals(const std::string& file, bool staged, vtkImageData* place, const LayerForm& form)
    : Place(place)
    , Form(form)
    , File(file, staged)
    , Way(this->File)
  {
    int size[3];
    place->GetDimensions(size);
    this->Columns = size[0];
    this->Rows = size[1];
  }

  void Begin(const std::vector<Channel>& channels);
  void Try(const std::function<void()>& step);
  void Take(const std::vector<Channel>& channels, std::size_t first);
  void WriteWaiting();

  vtkSmartPointer<vtkImageData> Place;
  LayerForm Form;
  TemporaryFile File; // it goes last
  Stream Way;
  std::unique_ptr<Imf::OutputFile> Lines; // one of these two
  std::unique_ptr<Imf::TiledOutputFile> Tiles;
  std::vector<Channel> Channels; // as the first rows have them
  int Columns = 0;
  int Rows = 0;
  std::size_t RowBytes = 0;
  int AtOnce = 1; // rows that are handed on together: whole tiles or blocks
  int Done = 0;   // rows that have been
  int Waiting = 0;
  std::vector<char> Rest; // of those that wait
  vtkIdType Clamped = 0;
};

//------------------------------------------------------------------------------
/// Runs a step of OpenEXR's.
void LayerFile::Internals::Try(const std::function<void()>& step)
{
  std::string reason;
  try
  {
    step();
    return;
  }
  catch (const Iex::BaseExc& exception)
  {
    reason = this->File.Reword(exception.what());
  }
  this->Lines.reset();
  this->Tiles.reset();
  if (const int error = this->File.Finish())
  {
    throw Failure(
      vtkErrorCode::OutOfDiskSpaceError, std::string("writing failed: ") + std::strerror(error));
  }
  throw Failure(vtkErrorCode::FileFormatError, reason);
}

//------------------------------------------------------------------------------
void LayerFile::Internals::Begin(const std::vector<Channel>& channels)
{
  const Imf::Header header = MakeHeader(this->Place, channels, this->Form);
  // Compression takes far longer than writing. Zero is what nobody has asked for.
  if (Imf::globalThreadCount() == 0)
  {
    Imf::setGlobalThreadCount(vtkSMPTools::GetEstimatedNumberOfThreads());
  }
  this->Try(
    [&]
    {
      if (this->Form.TileSize > 0)
      {
        this->Tiles = std::make_unique<Imf::TiledOutputFile>(this->Way, header);
      }
      else
      {
        this->Lines = std::make_unique<Imf::OutputFile>(this->Way, header);
      }
    });
  this->Channels = channels;
  for (const Channel& channel : channels)
  {
    this->RowBytes += PlaneBytes(channel, this->Columns);
  }
  // About 16 MiB of whole blocks or tiles, so that threads have several to compress.
  constexpr std::size_t enough = std::size_t(16) << 20;
  constexpr int largestBlock = 32; // of all compressions that can be chosen
  const int granule = this->Form.TileSize > 0 ? this->Form.TileSize : largestBlock;
  const std::size_t granules = std::max<std::size_t>(1, enough / this->RowBytes / granule);
  this->AtOnce = static_cast<int>(std::min<std::size_t>(granules * granule, this->Rows));
  this->Rest.resize(this->RowBytes * this->AtOnce);
}

//------------------------------------------------------------------------------
/// Adds a row to those that wait, as the file has it; `first` is its first sample in the arrays.
void LayerFile::Internals::Take(const std::vector<Channel>& channels, std::size_t first)
{
  char* plane = this->Rest.data() + this->RowBytes * this->Waiting;
  for (const Channel& channel : channels)
  {
    this->Clamped += channel.Array->GetDataType() == VTK_FLOAT
      ? CopyRow<float>(channel, first, this->Columns, this->Form.NoData, plane)
      : CopyRow<double>(channel, first, this->Columns, this->Form.NoData, plane);
    plane += PlaneBytes(channel, this->Columns);
  }
  ++this->Waiting;
}

//------------------------------------------------------------------------------
/// Hands on the rows that wait, which are as many as go together or the last ones.
void LayerFile::Internals::WriteWaiting()
{
  Imf::FrameBuffer rows;
  char* plane = this->Rest.data();
  for (const Channel& channel : this->Channels)
  {
    rows.insert(channel.Name,
      Imf::Slice::Make(channel.Type, plane, Imath::V2i(0, this->Done), this->Columns, this->Waiting,
        channel.ValueBytes(), this->RowBytes));
    plane += PlaneBytes(channel, this->Columns);
  }
  this->Try(
    [&]
    {
      if (this->Tiles)
      {
        const int size = this->Form.TileSize;
        this->Tiles->setFrameBuffer(rows);
        this->Tiles->writeTiles(0, this->Tiles->numXTiles() - 1, this->Done / size,
          (this->Done + this->Waiting - 1) / size);
      }
      else
      {
        this->Lines->setFrameBuffer(rows);
        this->Lines->writePixels(this->Waiting);
      }
    });
  this->Done += this->Waiting;
  this->Waiting = 0;
}

//------------------------------------------------------------------------------
LayerFile::LayerFile(
  const std::string& file, bool staged, vtkImageData* place, const LayerForm& form)
  : Internal(std::make_unique<Internals>(file, staged, place, form))
{
}

//------------------------------------------------------------------------------
LayerFile::~LayerFile() = default;

//------------------------------------------------------------------------------
void LayerFile::Write(vtkImageData* part, const StepWatcher& watcher)
{
  Internals& self = *this->Internal;
  const std::vector<Channel> channels = FindChannels(part, self.Form.Half);
  if (self.Channels.empty())
  {
    self.Begin(channels);
  }
  int size[3];
  part->GetDimensions(size);
  if (size[0] != self.Columns || self.Done + self.Waiting + size[1] > self.Rows ||
    !std::equal(
      channels.begin(), channels.end(), self.Channels.begin(), self.Channels.end(), IsAlike))
  {
    throw Failure(vtkErrorCode::UnknownError, "rows that do not go on those before are written");
  }
  Advance(watcher, static_cast<double>(self.Done) / self.Rows);
  for (int k = 0; k < size[1]; ++k)
  {
    // The file begins with the top row, the image with the bottom one.
    self.Take(channels, static_cast<std::size_t>(size[1] - 1 - k) * self.Columns);
    if (self.Waiting == self.AtOnce || self.Done + self.Waiting == self.Rows)
    {
      self.WriteWaiting();
      Advance(watcher, static_cast<double>(self.Done) / self.Rows);
    }
  }
}

//------------------------------------------------------------------------------
void LayerFile::Finish()
{
  Internals& self = *this->Internal;
  if (self.Done < self.Rows)
  {
    throw Failure(vtkErrorCode::UnknownError,
      "only " + std::to_string(self.Done + self.Waiting) + " of " + std::to_string(self.Rows) +
        " rows were written");
  }
  // OpenEXR writes its table of offsets as it closes, and keeps to itself if that fails.
  self.Lines.reset();
  self.Tiles.reset();
  if (const int error = self.File.Finish())
  {
    throw Failure(
      vtkErrorCode::OutOfDiskSpaceError, std::string("writing failed: ") + std::strerror(error));
  }
  self.File.Keep();
}

//------------------------------------------------------------------------------
vtkIdType LayerFile::GetNumberOfClamped() const
{
  return this->Internal->Clamped;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRLayerWriter.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefScene.h"
#include "vtkReliefSetters.h"
#include "vtkSMPTools.h"

#include "ImageFileAccess.h"
#include "SceneMetadata.h"
#include "TemporaryFile.h"

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
#include <cstring>
#include <functional>
#include <limits>
#include <set>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkOpenEXRLayerWriter);

void vtkOpenEXRLayerWriter::SetDWACompressionLevel(double value)
{
  relief::SetNumber(this, this->DWACompressionLevel, value, value >= 0.0,
    "a finite number of at least 0", "DWACompressionLevel");
}

namespace
{
using relief::io::Aborted;
using relief::io::CheckImage;
using relief::io::Failure;
using relief::io::OneLine;
using relief::io::TemporaryFile;

const size_t LongestName = 255; // OpenEXR cuts off what is longer

/// One component of an array as the file has it.
struct Channel
{
  std::string Name;
  vtkDataArray* Array;
  int Component;
  Imf::PixelType Type;
};

struct Job
{
  vtkOpenEXRLayerWriter* Writer;
  vtkImageData* Image;
  std::string FileName;
  const std::map<std::string, std::string>& Attributes;
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
void AddChannels(const Job& job, vtkDataArray* array, const std::string& prefix,
  const std::string& suffixes, std::vector<Channel>& channels)
{
  const bool half =
    job.Writer->GetPixelType() == vtkOpenEXRLayerWriter::Half && suffixes.size() > 1;
  for (size_t c = 0; c < suffixes.size(); ++c)
  {
    channels.push_back(
      { prefix + suffixes[c], array, static_cast<int>(c), half ? Imf::HALF : Imf::FLOAT });
    if (channels.back().Name.size() > LongestName)
    {
      throw Failure(vtkErrorCode::FileFormatError,
        "the layer's name \"" + prefix.substr(0, 40) + "...\" is longer than OpenEXR's " +
          std::to_string(LongestName) + " characters");
    }
  }
}

//------------------------------------------------------------------------------
std::vector<Channel> FindChannels(const Job& job)
{
  std::vector<Channel> channels;
  vtkPointData* data = job.Image->GetPointData();
  vtkDataArray* scalars = data->GetScalars();
  CheckArray(job.Image, scalars, "the scalars have");
  const int components = scalars->GetNumberOfComponents();
  AddChannels(
    job, scalars, "", components == 1 ? "Y" : std::string("RGBA").substr(0, components), channels);
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
    CheckArray(job.Image, array, "the point array \"" + name + "\" has");
    auto* layer = vtkDataArray::SafeDownCast(array);
    AddChannels(job, layer, name + ".", Suffixes(data, layer), channels);
  }
  return channels;
}

//------------------------------------------------------------------------------
Imf::Header MakeHeader(const Job& job, const std::vector<Channel>& channels)
{
  static const Imf::Compression compressions[] = { Imf::NO_COMPRESSION, Imf::ZIPS_COMPRESSION,
    Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::DWAA_COMPRESSION };
  int dimensions[3];
  job.Image->GetDimensions(dimensions);
  Imf::Header header(dimensions[0], dimensions[1]);
  header.compression() = compressions[job.Writer->GetCompression()];
  if (header.compression() == Imf::DWAA_COMPRESSION)
  {
    header.dwaCompressionLevel() = static_cast<float>(job.Writer->GetDWACompressionLevel());
  }
  if (job.Writer->GetTiled())
  {
    const int size = job.Writer->GetTileSize();
    header.setTileDescription(Imf::TileDescription(size, size, Imf::ONE_LEVEL));
  }
  for (const Channel& channel : channels)
  {
    header.channels().insert(channel.Name, Imf::Channel(channel.Type));
  }
  Imf::addChromaticities(header, Imf::Chromaticities()); // their default is Rec. 709
  const std::string wrong = relief::io::AddMetadata(job.Image, job.Writer->GetScene(), header);
  if (!wrong.empty())
  {
    throw Failure(vtkErrorCode::UnknownError, wrong);
  }
  for (const auto& attribute : job.Attributes)
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
    if (this->File.Write(text, static_cast<size_t>(count)) != static_cast<size_t>(count))
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
    out[i] = convert(values[static_cast<size_t>(i) * stride]);
  }
  return convert.Clamped;
}

template <typename Value>
vtkIdType CopyRow(const Channel& channel, size_t first, int count, double noData, char* row)
{
  const int stride = channel.Array->GetNumberOfComponents();
  const Value* values = static_cast<const Value*>(channel.Array->GetVoidPointer(0)) +
    first * stride + channel.Component;
  return channel.Type == Imf::HALF ? CopyRow<Value, half>(values, count, stride, noData, row)
                                   : CopyRow<Value, float>(values, count, stride, noData, row);
}

//------------------------------------------------------------------------------
/// Gives rows [begin, end) of the file to OpenEXR.
using WriteBand = std::function<void(const Imf::FrameBuffer& rows, int begin, int end)>;

/// Hands the rows on in bands. Returns how many values were too large for the file's type.
vtkIdType WriteBands(
  const Job& job, const std::vector<Channel>& channels, int granule, const WriteBand& writeBand)
{
  int dimensions[3];
  job.Image->GetDimensions(dimensions);
  const int width = dimensions[0];
  const int height = dimensions[1];
  const double noData = job.Writer->GetNoDataValue();
  size_t rowBytes = 0;
  for (const Channel& channel : channels)
  {
    rowBytes += static_cast<size_t>(width) * (channel.Type == Imf::HALF ? 2 : 4);
  }
  // About 16 MiB of whole blocks or tiles, so that threads have several to compress.
  const size_t granules = std::max<size_t>(1, (size_t(16) << 20) / rowBytes / granule);
  const int bandRows = static_cast<int>(std::min<size_t>(granules * granule, height));
  std::vector<char> band(rowBytes * bandRows);
  vtkIdType clamped = 0;
  for (int begin = 0; begin < height; begin += bandRows)
  {
    if (job.Writer->GetAbortExecute())
    {
      throw Aborted();
    }
    const int end = std::min(begin + bandRows, height);
    Imf::FrameBuffer rows;
    char* plane = band.data();
    for (const Channel& channel : channels)
    {
      const size_t valueBytes = channel.Type == Imf::HALF ? 2 : 4;
      const size_t stride = valueBytes * width;
      for (int y = begin; y < end; ++y)
      {
        // The file begins with the top row, the image with the bottom one.
        const size_t first = static_cast<size_t>(height - 1 - y) * width;
        char* row = plane + stride * (y - begin);
        clamped += channel.Array->GetDataType() == VTK_FLOAT
          ? CopyRow<float>(channel, first, width, noData, row)
          : CopyRow<double>(channel, first, width, noData, row);
      }
      rows.insert(channel.Name,
        Imf::Slice::Make(
          channel.Type, plane, Imath::V2i(0, begin), width, end - begin, valueBytes, stride));
      plane += stride * (end - begin);
    }
    writeBand(rows, begin, end);
    job.Writer->UpdateProgress(static_cast<double>(end) / height);
  }
  if (job.Writer->GetAbortExecute())
  {
    throw Aborted();
  }
  return clamped;
}

//------------------------------------------------------------------------------
vtkIdType WriteWith(Imf::OStream& stream, const Imf::Header& header, const Job& job,
  const std::vector<Channel>& channels)
{
  if (job.Writer->GetTiled())
  {
    Imf::TiledOutputFile output(stream, header);
    const int size = job.Writer->GetTileSize();
    return WriteBands(job, channels, size,
      [&](const Imf::FrameBuffer& rows, int begin, int end)
      {
        output.setFrameBuffer(rows);
        output.writeTiles(0, output.numXTiles() - 1, begin / size, (end - 1) / size);
      });
  }
  Imf::OutputFile output(stream, header);
  const int largestBlock = 32; // of all compressions that can be chosen
  return WriteBands(job, channels, largestBlock,
    [&](const Imf::FrameBuffer& rows, int begin, int end)
    {
      output.setFrameBuffer(rows);
      output.writePixels(end - begin);
    });
}

//------------------------------------------------------------------------------
vtkIdType WriteWholeFile(const Job& job)
{
  CheckImage(job.FileName, job.Image);
  const std::vector<Channel> channels = FindChannels(job);
  const Imf::Header header = MakeHeader(job, channels);
  // Compression takes far longer than writing. Zero is what nobody has asked for.
  if (Imf::globalThreadCount() == 0)
  {
    Imf::setGlobalThreadCount(vtkSMPTools::GetEstimatedNumberOfThreads());
  }
  TemporaryFile file(job.FileName, job.Writer->GetStaging());
  Stream stream(file);
  vtkIdType clamped = 0;
  std::string reason;
  try
  {
    clamped = WriteWith(stream, header, job, channels);
  }
  catch (const Iex::BaseExc& exception)
  {
    reason = file.Reword(exception.what());
  }
  // OpenEXR writes its table of offsets as it closes, and keeps to itself if that fails.
  if (const int error = file.Finish())
  {
    throw Failure(
      vtkErrorCode::OutOfDiskSpaceError, std::string("writing failed: ") + std::strerror(error));
  }
  if (!reason.empty())
  {
    throw Failure(vtkErrorCode::FileFormatError, reason);
  }
  file.Keep();
  return clamped;
}
}

//------------------------------------------------------------------------------
vtkOpenEXRLayerWriter::vtkOpenEXRLayerWriter() = default;

//------------------------------------------------------------------------------
vtkOpenEXRLayerWriter::~vtkOpenEXRLayerWriter() = default;

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::SetScene(vtkReliefScene* scene)
{
  if (this->Scene != scene)
  {
    this->Scene = scene;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkReliefScene* vtkOpenEXRLayerWriter::GetScene()
{
  return this->Scene;
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::SetNoDataValue(double value)
{
  if (std::isinf(value))
  {
    vtkErrorMacro("SetNoDataValue: " << value << " was given, a finite number or NaN is expected; "
                                     << this->NoDataValue << " is kept.");
    return;
  }
  if (this->NoDataValue != value && !(std::isnan(this->NoDataValue) && std::isnan(value)))
  {
    this->NoDataValue = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::SetAttribute(const std::string& name, const char* text)
{
  // What OpenEXR itself writes or reads the file by; under these names a text would break it.
  static const std::set<std::string> structure = { "channels", "chromaticities", "chunkCount",
    "compression", "dataWindow", "deepImageState", "displayWindow", "dwaCompressionLevel", "envmap",
    "lineOrder", "multiView", "name", "pixelAspectRatio", "preview", "screenWindowCenter",
    "screenWindowWidth", "tiles", "type", "version", "view" };
  if (name.empty() || name.size() > LongestName || structure.count(name) ||
    name.compare(0, 7, "relief:") == 0)
  {
    vtkErrorMacro("SetAttribute: \""
      << name << "\" was given, a name of 1 to " << LongestName
      << " characters is expected that neither begins with \"relief:\" nor describes the file's "
         "structure; nothing is set.");
    return;
  }
  const char* old = this->GetAttribute(name);
  if (!text && old)
  {
    this->Attributes.erase(name);
    this->Modified();
  }
  else if (text && (!old || std::strcmp(text, old) != 0))
  {
    this->Attributes[name] = text;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkOpenEXRLayerWriter::GetAttribute(const std::string& name)
{
  const auto found = this->Attributes.find(name);
  return found == this->Attributes.end() ? nullptr : found->second.c_str();
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::RemoveAllAttributes()
{
  if (!this->Attributes.empty())
  {
    this->Attributes.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMTimeType vtkOpenEXRLayerWriter::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Scene ? std::max(time, this->Scene->GetMTime()) : time;
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  static const char* const compressions[] = { "None", "ZIPS", "ZIP", "PIZ", "DWAA" };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scene:" << (this->Scene ? "\n" : " (none)\n");
  if (this->Scene)
  {
    this->Scene->PrintSelf(os, indent.GetNextIndent());
  }
  os << indent << "PixelType: " << (this->PixelType == Half ? "Half" : "Float") << "\n";
  os << indent << "Compression: " << compressions[this->Compression] << "\n";
  os << indent << "DWACompressionLevel: " << this->DWACompressionLevel << "\n";
  os << indent << "Tiled: " << (this->Tiled ? "On" : "Off") << "\n";
  os << indent << "TileSize: " << this->TileSize << "\n";
  os << indent << "NoDataValue: " << this->NoDataValue << "\n";
  os << indent << "Staging: " << (this->Staging ? "On" : "Off") << "\n";
  os << indent << "Attributes:\n";
  for (const auto& attribute : this->Attributes)
  {
    os << indent.GetNextIndent() << attribute.first << ": " << attribute.second << "\n";
  }
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::Write()
{
  // Stands if the pipeline stops before it comes to this writer.
  this->ErrorCode = vtkErrorCode::UnknownError;
  if (relief::io::HasInput(this, this->FileName))
  {
    this->Modified();
    this->UpdateWholeExtent();
  }
}

//------------------------------------------------------------------------------
int vtkOpenEXRLayerWriter::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* vtkNotUsed(outputVector))
{
  const Job job{ this, vtkImageData::GetData(inputVector[0], 0),
    this->FileName ? this->FileName : "", this->Attributes };
  vtkIdType clamped = 0;
  this->ErrorCode =
    relief::io::GuardWriting(this, job.FileName, [&] { clamped = WriteWholeFile(job); });
  if (clamped > 0)
  {
    vtkWarningMacro(<< clamped << " values are too large for the numbers in \"" << job.FileName
                    << "\" and became the largest that these hold"
                    << (this->PixelType == Half ? ", 65504; SetPixelTypeToFloat holds more."
                                                : "."));
  }
  // Success in any case: the pipeline would add an error of its own that says nothing more.
  return 1;
}

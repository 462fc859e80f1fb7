// SPDX-License-Identifier: BSD-3-Clause
#include "RasterFiles.h"

#include "Failure.h"
#include "HeightEncoding.h"
#include "ImageFormats.h"
#include "MessageLog.h"
#include "OtherContent.h"
#include "ReferencedPicture.h"
#include "Watch.h"

#include "vtkDataArray.h"
#include "vtkImageReader2.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace
{

using namespace reliefshade;
using relief::raster::OptionFailure;

//------------------------------------------------------------------------------
/// Runs a step of a reader of OpenImageIO's. Throws a std::runtime_error.
void runReader(const std::function<void()>& step)
{
  {
    const Silence silence;
    step();
  }
  stopIfInterrupted();
  if (hasError())
  {
    throw std::runtime_error(takeError());
  }
}

//------------------------------------------------------------------------------
/// Reads the header of a file that OpenImageIO knows, for the program to be interrupted. Throws a
/// std::runtime_error.
void readHeader(vtkImageReader2* reader, const std::string& file)
{
  reader->SetFileName(file.c_str());
  watch(reader, false);
  // The program's own message tells what is needed in all.
  imageFormats().SetMemoryLimit(reader, 0);
  runReader([&] { reader->UpdateInformation(); });
}

//------------------------------------------------------------------------------
/// Reads its pixels.
void readPixels(vtkImageReader2* reader, const MemoryPlan& plan)
{
  const int* extent = reader->GetDataExtent();
  const int type = reader->GetDataScalarType();
  const double mask = 1.0;
  const vtkTypeInt64 left = plan.Budget.GetLeft();
  plan.Claim(extent[1] + 1.0, extent[3] + 1.0,
    static_cast<double>(reader->GetNumberOfScalarComponents()) *
        vtkDataArray::GetDataTypeSize(type) +
      mask);
  imageFormats().SetMemoryLimit(reader, left); // for tiles larger than the picture
  runReader([&] { reader->Update(); });
}

//------------------------------------------------------------------------------
/// The part of a channel's name behind its layers, in lower case.
std::string lastName(const std::string& channel)
{
  std::string name = channel.substr(channel.rfind('.') + 1);
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

//------------------------------------------------------------------------------
bool isOneOf(const std::string& name, std::initializer_list<const char*> names)
{
  return std::any_of(names.begin(), names.end(), [&name](const char* n) { return name == n; });
}

bool isColor(const std::string& channel)
{
  return isOneOf(lastName(channel),
    { "r", "g", "b", "a", "y", "ry", "by", "red", "green", "blue", "alpha", "ar", "ag", "ab" });
}

bool isDepth(const std::string& channel)
{
  return isOneOf(lastName(channel), { "z", "depth", "height", "elevation" });
}

//------------------------------------------------------------------------------
/// Which channel of several holds the heights: the one that was asked for or, beside nothing but
/// colours, the one that is called depth. Throws a Failure if that is not clear.
std::string heightChannel(const std::vector<std::string>& channels, int band)
{
  if (band > static_cast<int>(channels.size()))
  {
    throw std::runtime_error(
      "it has no band " + std::to_string(band) + ", only " + std::to_string(channels.size()));
  }
  if (band > 0)
  {
    return channels[band - 1];
  }
  std::vector<std::string> others;
  std::remove_copy_if(channels.begin(), channels.end(), std::back_inserter(others), isColor);
  if (others.size() == 1 && isDepth(others[0]))
  {
    return others[0];
  }
  const auto alphas = std::count_if(channels.begin(), channels.end(),
    [](const std::string& channel) {
      return isOneOf(lastName(channel), { "a", "alpha" });
    });
  const bool named = !others.empty() ||
    std::any_of(channels.begin(), channels.end(),
      [](const std::string& channel) { return channel.find('.') != std::string::npos; });
  if (!named)
  {
    throw relief::raster::ManyComponents(
      relief::raster::ColorNames(static_cast<int>(channels.size() - alphas)));
  }
  // Those that could be heights come first.
  std::copy_if(channels.begin(), channels.end(), std::back_inserter(others), isColor);
  std::string list;
  for (const std::string& channel : others)
  {
    list += (list.empty() ? "" : ", ") + relief::io::Shortened(channel, 32);
    if (list.size() > 60 && &channel != &others.back())
    {
      list += ", ...";
      break;
    }
  }
  throw OptionFailure(OptionFailure::Channel,
    "its channels are " + list + "; expected the choice of the one that holds heights", channels);
}

//------------------------------------------------------------------------------
/// The depth that Blender gives to pixels behind which there is nothing.
constexpr double BlenderBackground = 1e10;

//------------------------------------------------------------------------------
/// Heights from a picture that OpenImageIO knows.
class GrayPicture : public relief::raster::RasterFile
{
public:
  GrayPicture(const std::string& file, const ReadOptions& options)
    : File(file)
    , Options(options)
  {
  }

  Raster Read(const MemoryPlan& plan, const relief::io::StepWatcher& watcher) override;

private:
  std::string File;
  ReadOptions Options;
};

//------------------------------------------------------------------------------
Raster GrayPicture::Read(const MemoryPlan& plan, const relief::io::StepWatcher&)
{
  // Find the channel of the heights.
  const ImageFormats& formats = imageFormats();
  const vtkSmartPointer<vtkImageReader2> reader = formats.NewReader(ImageFormats::Alpha::Mask);
  std::string channel = this->Options.Channel;
  formats.Choose(reader, this->Options.Part, channel);
  readHeader(reader, this->File);
  const std::vector<std::string> channels = formats.ChannelNames(reader);
  const bool several = reader->GetNumberOfScalarComponents() > 1 || this->Options.Band > 1;
  if (channel.empty())
  {
    channel = several ? heightChannel(channels, this->Options.Band) : channels.front();
  }
  if (several && this->Options.Channel.empty())
  {
    formats.Choose(reader, this->Options.Part, channel);
    runReader([&] { reader->UpdateInformation(); });
  }

  readPixels(reader, plan);
  vtkImageData* picture = reader->GetOutput();
  Raster raster;
  raster.Bands = channels;
  raster.Heights = picture;
  if (picture->GetPointData()->GetArray("Alpha"))
  {
    raster.Masked = true;
    raster.Mask = reader->GetOutput(1);
  }
  int size[3];
  raster.Heights->GetDimensions(size);
  raster.Columns = size[0];
  raster.Rows = size[1];
  raster.ScalarType = raster.Heights->GetScalarType();
  if (isDepth(channel) && raster.ScalarType == VTK_FLOAT)
  {
    raster.NoData = BlenderBackground;
  }
  return raster;
}

/// What a mask's file says: 0 in any of these hides a sample.
struct MaskFile
{
  vtkSmartPointer<vtkImageData> Image;
  vtkSmartPointer<vtkImageData> Alpha; // may be null
};

//------------------------------------------------------------------------------
MaskFile readMask(const std::string& file, const ReadOptions& options, MemoryBudget& budget)
{
  try
  {
    const Raster raster = readRaster(file, options, budget);
    return { raster.Heights, raster.Mask };
  }
  catch (const Failure& failure)
  {
    if (failure.Bands.empty())
    {
      throw;
    }
    ReadOptions any = options;
    any.Band = 1;
    const Raster colors = readRaster(file, any, budget);
    if (!colors.Mask)
    {
      throw; // the failure: which of the colours is meant nobody knows
    }
    return { colors.Mask, nullptr };
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> readColors(
  const std::string& file, ImageFormats::Alpha alpha, const MemoryPlan& plan)
{
  vtkSmartPointer<vtkImageReader2> reader;
  aboutFile(file,
    [&]
    {
      reader = imageFormats().NewReader(alpha);
      readHeader(reader, file);
      readPixels(reader, plan);
    });
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
std::unique_ptr<relief::raster::RasterFile> openFile(
  const std::string& file, const ReadOptions& options)
{
  const bool named = !options.Channel.empty() || !options.Part.empty();
  ReadOptions asked = options;
  asked.Band = named ? 1 : options.Band; // which no picture refuses
  std::unique_ptr<relief::raster::RasterFile> source = relief::raster::OpenRaster(file, asked);
  if (named && source && source->GetHeader().Reference.Present)
  {
    throw std::runtime_error(
      "--channel and --part are for pictures without a georeference; --band chooses of this file");
  }
  if (!source)
  {
    relief::raster::RefuseOtherContent(file);
  }
  return named || !source ? std::make_unique<GrayPicture>(file, options) : std::move(source);
}

//------------------------------------------------------------------------------
/// What mends it.
Remedy remedyOf(const OptionFailure& failure)
{
  switch (failure.Option)
  {
    case OptionFailure::Degrees:
      return Remedy::Degrees;
    case OptionFailure::Colors:
      return Remedy::Colors;
    case OptionFailure::Indices:
      return Remedy::Indices;
    case OptionFailure::Channel:
      return Remedy::Channel;
    default:
      return Remedy::Band;
  }
}

//------------------------------------------------------------------------------
bool goOn(double)
{
  return !interrupted();
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
double machineMemory()
{
  return 1024.0 * relief::io::PhysicalMemory();
}

//------------------------------------------------------------------------------
std::unique_ptr<relief::raster::RasterFile> openRaster(
  const std::string& file, const ReadOptions& options)
{
  return relief::raster::OpenEncoded(
    options, [&file](const ReadOptions& band) { return openFile(file, band); });
}

//------------------------------------------------------------------------------
Raster readRaster(const std::string& file, const ReadOptions& options, MemoryBudget& budget,
  double bytesPerSample, std::unique_ptr<relief::raster::RasterFile> opened)
{
  Raster raster;
  const auto read = [&]
  {
    const std::unique_ptr<relief::raster::RasterFile> source =
      opened ? std::move(opened) : openRaster(file, options);
    raster = relief::raster::ReadHeights(*source, options, { budget, 1.0, bytesPerSample }, goOn);
  };
  aboutFile(file,
    [&]
    {
      try
      {
        read();
      }
      catch (const OptionFailure& failure)
      {
        Failure told(
          file, withoutName(oneLine(failure.what()), file), RunFailure, remedyOf(failure));
        told.Bands = failure.Bands;
        throw told;
      }
    });
  return raster;
}

//------------------------------------------------------------------------------
void addMask(const std::string& file, const ReadOptions& options, const std::string& heights,
  MemoryBudget& budget, Raster& raster)
{
  const MaskFile given = readMask(file, options, budget);
  int size[3];
  int expected[3];
  given.Image->GetDimensions(size);
  raster.Heights->GetDimensions(expected);
  if (!std::equal(size, size + 3, expected))
  {
    throw Failure(file,
      std::to_string(size[0]) + " x " + std::to_string(size[1]) + " samples; expected " +
        std::to_string(expected[0]) + " x " + std::to_string(expected[1]) + " as in " + heights);
  }
  vtkNew<vtkImageData> mask;
  mask->CopyStructure(raster.Heights);
  mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* values = static_cast<unsigned char*>(mask->GetScalarPointer());
  std::fill_n(values, raster.Heights->GetNumberOfPoints(), static_cast<unsigned char>(255));
  for (vtkImageData* other : { given.Image.Get(), given.Alpha.Get(), raster.Mask.Get() })
  {
    vtkDataArray* shown = other ? other->GetPointData()->GetScalars() : nullptr;
    for (vtkIdType i = 0; shown && i < shown->GetNumberOfTuples(); ++i)
    {
      const double value = shown->GetComponent(i, 0);
      values[i] = value == value && value != 0.0 ? values[i] : 0;
    }
  }
  raster.Mask = mask;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> readPicture(
  const std::string& file, MemoryBudget& budget, double copies, double bytesPerPixel)
{
  return readColors(file, ImageFormats::Alpha::Stored, { budget, copies, bytesPerPixel });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> readTexture(
  const std::string& file, const Raster& raster, MemoryBudget& budget)
{
  relief::raster::ReferencedPicture picture;
  aboutFile(file,
    [&]
    {
      if (!relief::raster::ReadReferencedPicture(file, budget, goOn, picture))
      {
        relief::raster::RefuseOtherContent(file);
        picture.Image = readColors(file, ImageFormats::Alpha::Straight, { budget });
      }
      relief::raster::PlacePicture(raster, picture);
    });
  return picture.Image;
}

}

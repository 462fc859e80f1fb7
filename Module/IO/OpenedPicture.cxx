// SPDX-License-Identifier: BSD-3-Clause
#include "OpenedPicture.h"

#include "vtkErrorCode.h"

#include "ImageFileChecks.h"
#include "RadianceHeader.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <set>
#include <vector>

namespace relief::io
{
namespace
{
// Whether a channel's name is one of a colour, perhaps behind that of a layer.
bool IsColor(const std::string& name)
{
  const std::string last = name.substr(name.rfind('.') + 1);
  return last.size() == 1 && std::string("RGBA").find(last) != std::string::npos;
}

// Names as a message can list them, those that say more than colours do before the others.
std::string Listed(std::vector<std::string> names)
{
  std::stable_partition(
    names.begin(), names.end(), [](const std::string& name) { return !IsColor(name); });
  const size_t longest = 90;
  std::string list;
  for (const std::string& name : names)
  {
    const std::string next = (list.empty() ? "" : ", ") + Shortened(name, 32);
    if (list.size() + next.size() > longest)
    {
      return list + ", ...";
    }
    list += next;
  }
  return list;
}

// The channel of that name or, if it is the only one, the channel whose name ends with a point and
// that; -1 if there is none.
int FindChannel(const std::vector<std::string>& channels, const std::string& name)
{
  int found = -1;
  int count = 0;
  for (size_t c = 0; c < channels.size(); ++c)
  {
    const std::string& channel = channels[c];
    if (channel == name)
    {
      return static_cast<int>(c);
    }
    const std::string end = "." + name;
    if (channel.size() > end.size() &&
      channel.compare(channel.size() - end.size(), end.size(), end) == 0)
    {
      found = static_cast<int>(c);
      ++count;
    }
  }
  return count == 1 ? found : -1;
}

// Each picture in the file, until one is the right one; false, at the first one, if none is.
template <typename IsRight>
bool SeekSubimage(OIIO::ImageInput& input, IsRight isRight)
{
  for (int k = 0; input.seek_subimage(k, 0); ++k)
  {
    if (isRight(input.spec()))
    {
      return true;
    }
  }
  input.geterror(); // An error that nobody fetched would be printed
  input.seek_subimage(0, 0);
  return false;
}

std::vector<std::string> SubimageNames(OIIO::ImageInput& input)
{
  std::vector<std::string> names;
  SeekSubimage(input,
    [&names](const OIIO::ImageSpec& spec)
    {
      names.emplace_back(spec.get_string_attribute("oiio:subimagename"));
      return false;
    });
  return names;
}

// Goes to the picture that is asked for, by its name or number.
void Seek(OIIO::ImageInput& input, const Request& request)
{
  int subimage = request.Subimage;
  if (!request.SubimageName.empty())
  {
    const std::vector<std::string> names = SubimageNames(input);
    const auto found = std::find(names.begin(), names.end(), request.SubimageName);
    if (found == names.end())
    {
      const bool named =
        std::any_of(names.begin(), names.end(), [](const auto& name) { return !name.empty(); });
      throw Failure(vtkErrorCode::FileFormatError,
        "it has no part \"" + Shortened(request.SubimageName, 32) + "\", only " +
          (named ? Listed(names) : std::to_string(names.size()) + " without a name"));
    }
    subimage = static_cast<int>(found - names.begin());
  }
  else if (!request.ChannelName.empty() && subimage == 0 && request.MipLevel == 0)
  {
    // Any picture may have the channel.
    const bool found = SeekSubimage(input,
      [&request](const OIIO::ImageSpec& spec)
      { return FindChannel(spec.channelnames, request.ChannelName) >= 0; });
    subimage = found ? input.current_subimage() : 0;
  }
  if (!input.seek_subimage(subimage, request.MipLevel))
  {
    input.geterror();
    throw Failure(vtkErrorCode::FileFormatError,
      "it has no subimage " + std::to_string(subimage) + " (part " + std::to_string(subimage + 1) +
        ") at MIP level " + std::to_string(request.MipLevel));
  }
}

// Whether colours come multiplied by alpha: formats that are always so, and TIFF unless it says
// otherwise.
bool IsPremultiplied(const char* format, const OIIO::ImageSpec& spec)
{
  static const std::set<std::string> formats{ "openexr", "tiff", "iff", "rla" };
  return spec.alpha_channel >= 0 && formats.count(format) != 0 &&
    spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0;
}

// OpenImageIO's text as a part of a sentence that has named the file.
std::string Reworded(std::string text, const std::string& fileName)
{
  if (text.find("could not find a format reader") != std::string::npos)
  {
    return "no format that is read has its content";
  }
  for (const std::string quote : { "\"", "'", "" })
  {
    const std::string name = quote + fileName + quote;
    for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at))
    {
      text.replace(at, name.size(), "it");
      at += 2;
    }
  }
  return OneLine(text);
}

void CheckFile(const std::string& fileName)
{
  using vtksys::SystemTools;
  if (fileName.empty())
  {
    throw Failure(vtkErrorCode::NoFileNameError, "no file name is set");
  }
  // OpenImageIO tells these cases by texts that differ from format to format, or not at all.
  if (!SystemTools::PathExists(fileName))
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
}

}

//------------------------------------------------------------------------------
Picture::Picture(const Request& request)
{
  CheckFile(request.FileName);
  CheckHeader(request.FileName, request.MemoryLimit);
  const bool radiance = IsRadiance(request.FileName);
  const RadianceHeader header = radiance ? ReadRadianceHeader(request.FileName) : RadianceHeader();

  // Colours stored beside an alpha that does not multiply them are to stay so.
  OIIO::ImageSpec configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);
  this->Input = OIIO::ImageInput::open(request.FileName, &configuration);
  if (!this->Input)
  {
    throw Failure(
      vtkErrorCode::UnrecognizedFileTypeError, Reworded(OIIO::geterror(), request.FileName));
  }
  Seek(*this->Input, request);
  this->Subimage = this->Input->current_subimage();
  this->Spec = this->Input->spec();
  this->CheckSpec();
  const OIIO::ImageSpec& spec = this->Spec;
  // OpenImageIO 2.4 confuses two of Radiance's eight orders.
  this->Orientation = radiance ? header.Orientation : spec.get_int_attribute("Orientation", 1);
  if (radiance)
  {
    this->Exposure = header.Exposure;
    this->Spec.attribute("hdr:exposure", 1.0f); // It has been carried out
  }
  if (!request.ChannelName.empty())
  {
    this->Channel = FindChannel(spec.channelnames, request.ChannelName);
    if (this->Channel < 0)
    {
      throw Failure(vtkErrorCode::FileFormatError,
        "it has no channel \"" + Shortened(request.ChannelName, 32) + "\", or several, of " +
          Listed(spec.channelnames));
    }
  }
  const bool separate =
    request.AlphaAsMask && spec.nchannels > 1 && this->Channel != spec.alpha_channel;
  this->Separate = separate ? spec.alpha_channel : -1;
  this->DividedByAlpha =
    request.StraightAlpha && IsPremultiplied(this->Input->format_name(), this->Spec);
}

//------------------------------------------------------------------------------
int Picture::Components() const
{
  return this->Channel >= 0 ? 1 : this->Spec.nchannels - (this->Separate >= 0 ? 1 : 0);
}

//------------------------------------------------------------------------------
// Whether it is one that is read.
void Picture::CheckSpec()
{
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
  // GIF gives a number behind its last channel.
  if (spec.alpha_channel >= spec.nchannels)
  {
    const auto& names = spec.channelnames;
    const auto alpha = std::find(names.begin(), names.end(), "A") - names.begin();
    this->Spec.alpha_channel = alpha < spec.nchannels ? static_cast<int>(alpha) : -1;
  }
}
}

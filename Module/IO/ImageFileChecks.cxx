// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFileChecks.h"

#include "vtkErrorCode.h"

#include "ImageFileAccess.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

namespace relief::io
{
namespace
{
/// A file's bytes from the beginning, and how many are left.
class HeaderStream
{
public:
  explicit HeaderStream(const std::string& fileName)
    : Stream(fileName.c_str(), std::ios::binary)
    , Size(vtksys::SystemTools::FileLength(fileName))
  {
  }

  /// Zeros after the end.
  template <std::size_t Count>
  std::array<unsigned char, Count> Take()
  {
    std::array<unsigned char, Count> bytes{};
    this->Stream.read(reinterpret_cast<char*>(bytes.data()), Count);
    return bytes;
  }

  std::uint32_t TakeLittleEndian()
  {
    const auto b = this->Take<4>();
    return b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
  }

  std::uint32_t TakeBigEndian()
  {
    const auto b = this->Take<4>();
    return b[3] | b[2] << 8 | b[1] << 16 | static_cast<std::uint32_t>(b[0]) << 24;
  }

  /// A text that a zero ends, or the file's end.
  std::string TakeText()
  {
    std::string text;
    std::getline(this->Stream, text, '\0');
    return text;
  }

  /// Throws a Failure where the file does not hold so many bytes more.
  void Skip(std::uint64_t count, const std::string& what)
  {
    const auto at = this->Stream.tellg();
    const std::uint64_t left = at < 0 ? 0 : this->Size - static_cast<std::uint64_t>(at);
    if (count > left)
    {
      throw Failure(vtkErrorCode::PrematureEndOfFileError,
        what + " in its header claims " + std::to_string(count) + " bytes, and " +
          std::to_string(left) + " follow");
    }
    this->Stream.seekg(static_cast<std::streamoff>(count), std::ios::cur);
  }

  bool Good() const { return this->Stream.good(); }

private:
  vtksys::ifstream Stream;
  std::uint64_t Size;
};

/// The size of an OpenEXR attribute's value where its type fixes it, else 0.
std::uint32_t FixedSize(const std::string& type)
{
  static const std::map<std::string, std::uint32_t> sizes = { { "box2f", 16 }, { "box2i", 16 },
    { "chromaticities", 32 }, { "compression", 1 }, { "deepImageState", 1 }, { "double", 8 },
    { "envmap", 1 }, { "float", 4 }, { "int", 4 }, { "keycode", 28 }, { "lineOrder", 1 },
    { "m33d", 72 }, { "m33f", 36 }, { "m44d", 128 }, { "m44f", 64 }, { "rational", 8 },
    { "tiledesc", 9 }, { "timecode", 8 }, { "v2d", 16 }, { "v2f", 8 }, { "v2i", 8 }, { "v3d", 24 },
    { "v3f", 12 }, { "v3i", 12 } };
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

/// A name from a file, which may be anything, as a message can show it.
std::string Quoted(const std::string& name)
{
  const std::size_t longest = 40;
  std::string text = name.substr(0, longest);
  std::replace_if(
    text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return '"' + text + '"';
}

/// Reads past an OpenEXR attribute's value as the library does, and returns how long it was: of
/// some types it takes no notice of the size that the file gives.
std::uint32_t SkipValue(HeaderStream& file, const std::string& type, std::uint32_t size)
{
  const std::string what = "a value of type " + Quoted(type);
  if (type == "chlist")
  {
    std::uint32_t length = 1;
    for (std::string name = file.TakeText(); !name.empty(); name = file.TakeText())
    {
      const std::uint32_t description = 16;
      file.Skip(description, what);
      length += static_cast<std::uint32_t>(name.size()) + 1 + description;
    }
    return length;
  }
  if (type == "preview")
  {
    // Their product, too large for a file in any case, is not to wrap around.
    const std::uint64_t largest = 1 << 24;
    const std::uint64_t width = std::min<std::uint64_t>(file.TakeLittleEndian(), largest);
    const std::uint64_t height = std::min<std::uint64_t>(file.TakeLittleEndian(), largest);
    file.Skip(4 * width * height, what);
    return static_cast<std::uint32_t>(8 + 4 * width * height);
  }
  const std::uint32_t length = FixedSize(type) > 0 ? FixedSize(type) : size;
  file.Skip(length, what);
  return length;
}

/// "OpenEXR File Layout", openexr.com: attributes of name, type, size and value; an empty name ends
/// a header, and an empty header those of the parts.
void CheckOpenEXR(HeaderStream& file)
{
  const std::uint32_t multiPart = 0x1000;
  const bool several = (file.TakeLittleEndian() & multiPart) != 0;
  bool first = true;
  for (std::string name = file.TakeText(); file.Good(); name = file.TakeText())
  {
    if (name.empty() && (first || !several))
    {
      return;
    }
    first = name.empty();
    if (!first)
    {
      const std::string type = file.TakeText();
      const std::uint32_t size = file.TakeLittleEndian();
      const std::uint32_t length = SkipValue(file, type, size);
      if (length != size)
      {
        throw Failure(vtkErrorCode::FileFormatError,
          "the attribute " + Quoted(name) + " in its header claims " + std::to_string(size) +
            " bytes, and has " + std::to_string(length));
      }
    }
  }
}

/// PNG specification, section 5: chunks of length, type, data and check sum.
void CheckPNG(HeaderStream& file)
{
  file.Take<4>();
  while (file.Good())
  {
    const std::uint32_t length = file.TakeBigEndian();
    const auto type = file.Take<4>();
    const std::string name(type.begin(), type.end());
    if (name == "IDAT" || !file.Good())
    {
      return; // pixels that end early are the decoder's to report
    }
    file.Skip(length, "the chunk " + Quoted(name));
    file.Take<4>();
  }
}

/// GIF89a specification, section 18: the decoder makes a canvas of the logical screen.
void CheckGIF(HeaderStream& file, vtkTypeInt64 limit)
{
  file.Take<2>();
  const auto screen = file.Take<4>();
  const int width = screen[0] | screen[1] << 8;
  const int height = screen[2] | screen[3] << 8;
  const vtkTypeInt64 needed = vtkTypeInt64(4) * width * height / 1024;
  if (limit > 0 && needed > limit)
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "its header gives " + std::to_string(width) + " x " + std::to_string(height) +
        " pixels of 4 channels, which need " + std::to_string(needed) +
        " KiB of memory; MemoryLimit is " + std::to_string(limit) + " KiB");
  }
}
}

//------------------------------------------------------------------------------
void CheckHeader(const std::string& fileName, vtkTypeInt64 limit)
{
  HeaderStream file(fileName);
  const auto begin = file.Take<4>();
  const std::string magic(begin.begin(), begin.end());
  if (magic == "\x76\x2f\x31\x01")
  {
    CheckOpenEXR(file);
  }
  else if (magic == "\x89PNG")
  {
    CheckPNG(file);
  }
  else if (magic == "GIF8")
  {
    CheckGIF(file, limit);
  }
}
}

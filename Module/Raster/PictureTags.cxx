// SPDX-License-Identifier: BSD-3-Clause
#include "PictureTags.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <vector>

namespace relief::raster
{
namespace
{
/// Whole numbers in a file, in the order of bytes that it has.
class Numbers
{
public:
  Numbers(const ByteSource& file, bool littleEndian)
    : File(file)
    , LittleEndian(littleEndian)
  {
  }

  /// 0 beyond the end.
  std::uint64_t At(std::uint64_t begin, std::size_t size) const
  {
    const std::string bytes = this->File(begin, size);
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size && bytes.size() == size; ++k)
    {
      const std::size_t next = this->LittleEndian ? size - 1 - k : k;
      value = value << 8 | static_cast<unsigned char>(bytes[next]);
    }
    return value;
  }

private:
  const ByteSource& File;
  bool LittleEndian;
};

//------------------------------------------------------------------------------
// TIFF 6.0, section 2: the order of bytes, the place of the first directory, its entries of tag,
// type, count and value, or the place of several that are longer than the entry has room for.
// BigTIFF has wider numbers.
/// The whole numbers of a tag of the first directory; none if it is not there.
std::vector<std::uint64_t> TiffValues(const ByteSource& file, std::uint64_t base, std::uint64_t tag)
{
  const std::string begin = file(base, 4);
  const bool little = begin.compare(0, 2, "II") == 0;
  const Numbers numbers(file, little);
  const std::uint64_t version = numbers.At(base + 2, 2);
  if (begin.size() < 4 || (!little && begin.compare(0, 2, "MM") != 0) ||
    (version != 42 && version != 43))
  {
    return {};
  }
  const std::size_t wide = version == 43 ? 8 : 4; // of a place
  const std::size_t count = version == 43 ? 8 : 2;
  const std::uint64_t directory = base + numbers.At(base + wide, wide);
  const std::uint64_t most = 4096;
  const std::uint64_t entries = std::min(numbers.At(directory, count), most);
  for (std::uint64_t k = 0; k < entries; ++k)
  {
    const std::uint64_t at = directory + count + k * (4 + 2 * wide);
    if (numbers.At(at, 2) != tag)
    {
      continue;
    }
    const std::size_t size = numbers.At(at + 2, 2) == 4 ? 4 : 2; // LONG or SHORT
    const std::uint64_t values = std::min(numbers.At(at + 4, wide), most);
    std::uint64_t from = at + 4 + wide;
    from = values * size > wide ? base + numbers.At(from, wide) : from;
    std::vector<std::uint64_t> result;
    for (std::uint64_t v = 0; v < values; ++v)
    {
      result.push_back(numbers.At(from + v * size, size));
    }
    return result;
  }
  return {};
}

//------------------------------------------------------------------------------
int OrientationOfTiff(const ByteSource& file, std::uint64_t base)
{
  const std::vector<std::uint64_t> values = TiffValues(file, base, 274);
  const bool known = !values.empty() && values[0] >= 1 && values[0] <= 8;
  return known ? static_cast<int>(values[0]) : 1;
}

//------------------------------------------------------------------------------
/// EXIF is a TIFF without pixels, perhaps behind six bytes.
int OrientationOfExif(const ByteSource& file, std::uint64_t base)
{
  return OrientationOfTiff(file, file(base, 4) == "Exif" ? base + 6 : base);
}

//------------------------------------------------------------------------------
/// Chunks with a name and a size, one behind the other: those of PNG have the size first and a
/// check sum behind, those of RIFF are filled up to even sizes.
int OrientationOfChunks(const ByteSource& file, bool png)
{
  const Numbers numbers(file, !png);
  const std::string wanted = png ? "eXIf" : "EXIF";
  const std::uint64_t most = 1 << 20;
  std::uint64_t at = png ? 8 : 12;
  for (std::uint64_t k = 0; k < most; ++k)
  {
    const std::string name = file(at + (png ? 4 : 0), 4);
    if (name.size() < 4 || name == "IEND")
    {
      return 1;
    }
    if (name == wanted)
    {
      return OrientationOfExif(file, at + 8);
    }
    const std::uint64_t size = numbers.At(at + (png ? 0 : 4), 4);
    at += 8 + size + (png ? 4 : size % 2);
  }
  return 1;
}

//------------------------------------------------------------------------------
/// JPEG: markers with a length, until the pixels begin.
int OrientationOfJpeg(const ByteSource& file)
{
  const Numbers numbers(file, false);
  for (std::uint64_t at = 2;;)
  {
    const std::uint64_t marker = numbers.At(at, 2);
    const std::uint64_t startOfScan = 0xFFDA;
    if (marker < 0xFFC0 || marker == startOfScan)
    {
      return 1;
    }
    if (marker == 0xFFE1 && file(at + 4, 4) == "Exif")
    {
      return OrientationOfExif(file, at + 4);
    }
    at += 2 + std::max<std::uint64_t>(numbers.At(at + 2, 2), 2);
  }
}
}

//------------------------------------------------------------------------------
int FindOrientation(const ByteSource& file)
{
  const std::string begin = file(0, 12);
  if (begin.compare(0, 3, "\xFF\xD8\xFF") == 0)
  {
    return OrientationOfJpeg(file);
  }
  if (begin.compare(0, 4, "\x89PNG") == 0)
  {
    return OrientationOfChunks(file, true);
  }
  if (begin.size() == 12 && begin.compare(0, 4, "RIFF") == 0 && begin.compare(8, 4, "WEBP") == 0)
  {
    return OrientationOfChunks(file, false);
  }
  return OrientationOfTiff(file, 0);
}

//------------------------------------------------------------------------------
bool HasPremultipliedAlpha(const ByteSource& file)
{
  // ExtraSamples: 1 is alpha that the colours are multiplied by, 2 alpha that they are not.
  const std::vector<std::uint64_t> samples = TiffValues(file, 0, 338);
  return std::find(samples.begin(), samples.end(), 1) != samples.end();
}

//------------------------------------------------------------------------------
ByteSource BytesOf(const std::string& file)
{
  const auto stream = std::make_shared<std::ifstream>(file, std::ios::binary);
  return [stream](std::uint64_t begin, std::size_t count)
  {
    std::string bytes(count, '\0');
    stream->clear();
    stream->seekg(static_cast<std::streamoff>(begin));
    stream->read(&bytes[0], static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(stream->gcount()));
    return bytes;
  };
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "PlyFileChecks.h"

#include "FileGuard.h"
#include "Refusals.h"

#include "vtkErrorCode.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace relief::io
{

namespace
{
// At its beginning.
struct PlyFile
{
  std::istream& stream;
  std::uint64_t size;
};

//------------------------------------------------------------------------------
// A type of PLY's numbers.
struct PlyType
{
  const char* name;
  const char* other;
  std::uint64_t bytes;
  bool whole;
  bool negative;
};

// Null for what is no type.
const PlyType* FindPlyType(const std::string& name)
{
  static const PlyType types[] = { { "char", "int8", 1, true, true },
    { "uchar", "uint8", 1, true, false }, { "short", "int16", 2, true, true },
    { "ushort", "uint16", 2, true, false }, { "int", "int32", 4, true, true },
    { "uint", "uint32", 4, true, false }, { "float", "float32", 4, false, true },
    { "double", "float64", 8, false, true } };
  const auto found = std::find_if(std::begin(types), std::end(types),
    [&name](const PlyType& type) { return name == type.name || name == type.other; });
  return found == std::end(types) ? nullptr : found;
}

struct PlyProperty
{
  std::string name;
  const PlyType* length = nullptr; ///< of a list's length; null for a single value
  const PlyType* value = nullptr;

  bool HasPoints() const
  {
    return this->length && (this->name == "vertex_indices" || this->name == "vertex_index");
  }
};

// What of PLY there are so many of.
struct PlyElement
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  const PlyProperty* Find(const char* property) const
  {
    const auto found = std::find_if(this->properties.begin(), this->properties.end(),
      [property](const PlyProperty& one) { return one.name == property; });
    return found == this->properties.end() ? nullptr : &*found;
  }
};

struct PlyHeader
{
  std::string format;
  std::vector<PlyElement> elements;
  std::uint64_t points = 0;
};

//------------------------------------------------------------------------------
PlyProperty ReadPlyProperty(std::istream& words, std::string type)
{
  PlyProperty property;
  if (type == "list")
  {
    words >> type;
    property.length = FindPlyType(type);
    words >> type;
    if (!property.length || !property.length->whole)
    {
      words.setstate(std::ios::failbit);
    }
  }
  property.value = FindPlyType(type);
  words >> property.name;
  if (!property.value || (property.HasPoints() && !property.value->whole))
  {
    words.setstate(std::ios::failbit);
  }
  return property;
}

PlyHeader ReadPlyHeader(PlyFile& file)
{
  std::string line;
  std::getline(file.stream, line);
  if (line.compare(0, 3, "ply") != 0)
  {
    RefuseFormat("it is no PLY file: its first line is not 'ply'");
  }
  PlyHeader header;
  while (std::getline(file.stream, line) && line != "end_header" && line != "end_header\r")
  {
    std::istringstream words(line);
    std::string key;
    std::string type;
    words >> key >> type;
    if (key.empty())
    {
      RefuseFormat("its header has an empty line"); // VTK's reader does not survive that
    }
    const bool passed = key == "comment" || key == "obj_info";
    if (key == "format")
    {
      header.format = type;
    }
    else if (key == "element")
    {
      header.elements.emplace_back();
      header.elements.back().name = type;
      words >> header.elements.back().count;
    }
    else if (key == "property" && !header.elements.empty())
    {
      header.elements.back().properties.push_back(ReadPlyProperty(words, type));
    }
    else if (!passed)
    {
      words.setstate(std::ios::failbit);
    }
    if (!words && !passed)
    {
      RefuseFormat("its header is damaged: '" + Shortened(line) + "'");
    }
  }
  if (!file.stream)
  {
    RefuseEnd("its header ends early, without 'end_header'");
  }
  return header;
}

//------------------------------------------------------------------------------
// Points must have all that VTK's reader takes for granted, and faces a list.
void CheckPlyHeader(PlyHeader& header)
{
  bool faces = false;
  bool points = false;
  for (const PlyElement& element : header.elements)
  {
    if (element.name == "vertex")
    {
      points = element.Find("x") && element.Find("y") && element.Find("z");
      header.points = element.count;
    }
    faces = faces ||
      (element.name == "face" &&
        std::any_of(element.properties.begin(), element.properties.end(),
          [](const PlyProperty& property) { return property.HasPoints(); }));
  }
  if (!points)
  {
    RefuseFormat("its header has no element 'vertex' with x, y and z");
  }
  if (!faces)
  {
    RefuseFormat("it has no polygons: its header has no element 'face' with a list vertex_indices");
  }
  if (header.format != "ascii" && header.format != "binary_little_endian" &&
    header.format != "binary_big_endian")
  {
    RefuseFormat("its header has no known format: '" + Shortened(header.format, 32) + "'");
  }
}

[[noreturn]] void RefusePlyEnd(const PlyElement& element, std::uint64_t there)
{
  RefuseEnd("it ends early: its header tells of " + std::to_string(element.count) + " of '" +
    Shortened(element.name, 32) + "', and there are " + std::to_string(there));
}

void CheckPlyPoint(std::int64_t index, const PlyHeader& header)
{
  if (index < 0 || static_cast<std::uint64_t>(index) >= header.points)
  {
    RefuseFormat("a face names point " + std::to_string(index) + " of " +
      std::to_string(header.points) + ", counted from 0");
  }
}

//------------------------------------------------------------------------------
// Whether a line has as many words as an element takes.
bool HasWords(const std::string& line, const PlyElement& element, const PlyHeader& header)
{
  const char* at = line.c_str();
  const auto passWord = [&at]
  {
    at += std::strspn(at, " \t\r");
    const char* begin = at;
    at += std::strcspn(at, " \t\r");
    return at != begin;
  };
  for (const PlyProperty& property : element.properties)
  {
    std::uint64_t count = 1;
    if (property.length)
    {
      count = std::strtoull(at, nullptr, 10);
      if (!passWord() || count > line.size())
      {
        return false;
      }
    }
    for (std::uint64_t k = 0; k < count; ++k)
    {
      const std::int64_t index = property.HasPoints() ? std::strtoll(at, nullptr, 10) : 0;
      if (!passWord())
      {
        return false;
      }
      if (property.HasPoints())
      {
        CheckPlyPoint(index, header);
      }
    }
  }
  return true;
}

// A line for each of them.
void CheckPlyText(PlyFile& file, const PlyHeader& header)
{
  std::string line;
  for (const PlyElement& element : header.elements)
  {
    for (std::uint64_t i = 0; i < element.count; ++i)
    {
      if (!std::getline(file.stream, line) || !HasWords(line, element, header))
      {
        RefusePlyEnd(element, i);
      }
      // VTK's reader does not survive that.
      if (file.stream.eof())
      {
        RefuseEnd("its last line has no end: a line feed is expected behind it");
      }
    }
  }
}

//------------------------------------------------------------------------------
// A whole number from its bytes.
std::int64_t PlyNumber(const char* bytes, const PlyType& type, bool big)
{
  std::uint64_t number = 0;
  for (std::uint64_t k = 0; k < type.bytes; ++k)
  {
    const char byte = bytes[big ? k : type.bytes - 1 - k];
    number = number << 8 | static_cast<unsigned char>(byte);
  }
  const std::uint64_t half = std::uint64_t{ 1 } << (8 * type.bytes - 1);
  return static_cast<std::int64_t>(number) -
    (type.negative && number >= half ? static_cast<std::int64_t>(2 * half) : 0);
}

// Reads on, and tells whether that many bytes are there.
class PlyBytes
{
public:
  explicit PlyBytes(PlyFile& file)
    : Stream(file.stream)
    , Left(file.size - static_cast<std::uint64_t>(file.stream.tellg()))
  {
  }

  bool Read(std::uint64_t count)
  {
    if (count > this->Left)
    {
      return false;
    }
    this->Bytes.resize(static_cast<std::size_t>(count));
    this->Stream.read(this->Bytes.data(), static_cast<std::streamsize>(count));
    this->Left -= count;
    return true;
  }
  bool Skip(std::uint64_t count, std::uint64_t bytes)
  {
    if (bytes > 0 && count > this->Left / bytes)
    {
      return false;
    }
    this->Stream.seekg(static_cast<std::streamoff>(count * bytes), std::ios::cur);
    this->Left -= count * bytes;
    return true;
  }
  std::uint64_t GetLeft() const { return this->Left; }

  std::vector<char> Bytes;

private:
  std::istream& Stream;
  std::uint64_t Left;
};

// Goes through lists, as long as they say they are.
bool PassPlyElement(PlyBytes& bytes, const PlyElement& element, const PlyHeader& header, bool big)
{
  for (const PlyProperty& property : element.properties)
  {
    std::int64_t count = 1;
    if (property.length)
    {
      if (!bytes.Read(property.length->bytes))
      {
        return false;
      }
      count = PlyNumber(bytes.Bytes.data(), *property.length, big);
    }
    const std::uint64_t size = property.value->bytes;
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes.GetLeft() ||
      !bytes.Read(static_cast<std::uint64_t>(count) * size))
    {
      return false;
    }
    for (std::int64_t k = 0; property.HasPoints() && k < count; ++k)
    {
      CheckPlyPoint(
        PlyNumber(bytes.Bytes.data() + static_cast<std::uint64_t>(k) * size, *property.value, big),
        header);
    }
  }
  return true;
}

void CheckPlyBytes(PlyFile& file, const PlyHeader& header, bool big)
{
  PlyBytes bytes(file);
  for (const PlyElement& element : header.elements)
  {
    std::uint64_t fixed = 0;
    bool lists = false;
    for (const PlyProperty& property : element.properties)
    {
      lists = lists || property.length;
      fixed += property.length ? property.length->bytes : property.value->bytes;
    }
    if (fixed > 0 && element.count > bytes.GetLeft() / fixed)
    {
      RefusePlyEnd(element, bytes.GetLeft() / fixed);
    }
    if (!lists)
    {
      bytes.Skip(element.count, fixed);
      continue;
    }
    for (std::uint64_t i = 0; i < element.count; ++i)
    {
      if (!PassPlyElement(bytes, element, header, big))
      {
        RefusePlyEnd(element, i);
      }
    }
  }
}
}

//------------------------------------------------------------------------------
void CheckPlyFile(std::istream& stream, std::uint64_t size)
{
  PlyFile file{ stream, size };
  PlyHeader header = ReadPlyHeader(file);
  CheckPlyHeader(header);
  if (header.format == "ascii")
  {
    CheckPlyText(file, header);
  }
  else
  {
    CheckPlyBytes(file, header, header.format == "binary_big_endian");
  }
}

}

// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFileChecks.h"

#include "FileGuard.h"
#include "PlyFileChecks.h"

#include "vtkErrorCode.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <locale>
#include <sstream>
#include <string>

namespace relief::io
{

namespace
{
[[noreturn]] void RefuseFormat(const std::string& reason)
{
  throw Failure(vtkErrorCode::FileFormatError, reason);
}

[[noreturn]] void RefuseEnd(const std::string& reason)
{
  throw Failure(vtkErrorCode::PrematureEndOfFileError, reason);
}

// A file that is open, and how long it is.
struct OpenFile
{
  std::ifstream stream;
  std::uint64_t size = 0;

  explicit OpenFile(const std::string& fileName)
    : stream(fileName, std::ios::binary | std::ios::ate)
  {
    if (!this->stream)
    {
      throw Failure(vtkErrorCode::CannotOpenFileError, "it cannot be opened");
    }
    this->size = static_cast<std::uint64_t>(this->stream.tellg());
    this->stream.seekg(0);
    if (this->size == 0)
    {
      RefuseEnd("the file is empty");
    }
  }

  // The first bytes, and no more than there are.
  std::string Begin(std::size_t count)
  {
    std::string bytes(static_cast<std::size_t>(std::min<std::uint64_t>(count, this->size)), '\0');
    this->stream.seekg(0);
    this->stream.read(&bytes[0], static_cast<std::streamsize>(bytes.size()));
    return bytes;
  }
};

// Four bytes, the lowest first.
std::uint32_t Number(const std::string& bytes, std::size_t at)
{
  std::uint32_t number = 0;
  for (std::size_t k = 0; k < 4; ++k)
  {
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
  }
  return number;
}

std::string Bytes(std::uint64_t needed, std::uint64_t there)
{
  return "it ends early: its header tells of " + std::to_string(needed) + " bytes, and it has " +
    std::to_string(there);
}

//------------------------------------------------------------------------------
// Text begins with "solid", as some binary files do, too: those are as long as they say.
void CheckStl(OpenFile& file)
{
  const std::string begin = file.Begin(84);
  const bool text = begin.compare(0, 5, "solid") == 0;
  const std::uint64_t triangles = begin.size() == 84 ? Number(begin, 80) : 0;
  const std::uint64_t needed = 84 + 50 * triangles;
  if (!text && begin.size() < 84)
  {
    RefuseEnd(Bytes(84, file.size));
  }
  if (!text && needed > file.size)
  {
    RefuseEnd(Bytes(needed, file.size));
  }
  if (text && (begin.size() < 84 || needed != file.size))
  {
    file.stream.clear();
    file.stream.seekg(file.size > 4096 ? static_cast<std::streamoff>(file.size - 4096) : 0);
    const std::string rest(
      (std::istreambuf_iterator<char>(file.stream)), std::istreambuf_iterator<char>());
    if (rest.find("endsolid") == std::string::npos)
    {
      RefuseEnd("it ends early: no 'endsolid' ends its text");
    }
  }
}

//------------------------------------------------------------------------------
void CheckGlb(OpenFile& file)
{
  const std::string begin = file.Begin(12);
  if (begin.compare(0, 4, "glTF") != 0)
  {
    RefuseFormat("it is no binary glTF: it does not begin with 'glTF'");
  }
  if (begin.size() < 12 || Number(begin, 8) > file.size)
  {
    RefuseEnd(Bytes(begin.size() < 12 ? 12 : Number(begin, 8), file.size));
  }
  // Its chunks, each with its length and type in front, fill it.
  const std::uint64_t length = Number(begin, 8);
  for (std::uint64_t at = 12; at < length || at == 12;)
  {
    std::string front(8, '\0');
    file.stream.clear();
    file.stream.seekg(static_cast<std::streamoff>(at));
    const bool there = at + 8 <= length && file.stream.read(front.data(), 8);
    at += there ? 8 + Number(front, 0) : 0;
    if (!there || at > length)
    {
      RefuseEnd("it ends early: a chunk of it is not all there");
    }
  }
}

//------------------------------------------------------------------------------
// One number of a corner of a face, from 1, or from the end if below 0.
bool IsThere(long long index, std::uint64_t count)
{
  return index > 0 ? static_cast<std::uint64_t>(index) <= count
                   : index < 0 && static_cast<std::uint64_t>(-index) <= count;
}

[[noreturn]] void RefuseLine(std::uint64_t number, const std::string& reason)
{
  RefuseFormat("line " + std::to_string(number) + ": " + reason);
}

// A line as a message shows it, without what was added to it.
std::string Quoted(const std::string& line)
{
  return "'" + Shortened(line.substr(0, line.find_last_not_of(" \t\r") + 1)) + "'";
}

// One line of a file of OBJ, which may have gone on behind a backslash.
struct ObjLine
{
  std::string Text;
  std::uint64_t Number = 0; // from 1; of the first of its lines
};

constexpr const char* Blanks = " \t\r";

// Corners are numbers of a point, of a point and a texture point, or of a normal as well: 1, 1/2,
// 1//3 or 1/2/3, and all of a face are written in one of these ways. The reader takes no comment
// behind them.
void CheckObjFace(const ObjLine& line, const std::uint64_t counts[3])
{
  static const char* const kinds[3] = { " points", " texture points", " normals" };
  const char* at = line.Text.c_str() + 1;
  int corners = 0;
  int firstWay = 0;
  for (at += std::strspn(at, Blanks); *at != '\0'; at += std::strspn(at, Blanks))
  {
    if (*at == '#')
    {
      RefuseLine(line.Number,
        "a comment behind a face is not read; give it a line of its own: " + Quoted(line.Text));
    }
    bool more = true;
    int way = 0; // a bit for each kind of number
    for (int kind = 0; more && kind < 3; ++kind)
    {
      // strtoll passes over blanks, behind which the next corner begins.
      char* end = const_cast<char*>(at);
      const long long index = std::strchr(Blanks, *at) ? 0 : std::strtoll(at, &end, 10);
      const bool skipped = end == at && kind == 1 && *at == '/';
      if (end != at && !IsThere(index, counts[kind]))
      {
        RefuseLine(line.Number,
          "a face names number " + std::to_string(index) + " of " + std::to_string(counts[kind]) +
            kinds[kind]);
      }
      more = *end == '/';
      const bool ended = *end == '\0' || std::strchr(Blanks, *end);
      if ((end == at && !skipped) || !(more || ended) || (more && kind == 2))
      {
        RefuseLine(line.Number, "a face is no list of numbers: " + Quoted(line.Text));
      }
      way |= skipped ? 0 : 1 << kind;
      at = more ? end + 1 : end;
    }
    firstWay = corners == 0 ? way : firstWay;
    if (way != firstWay)
    {
      RefuseLine(
        line.Number, "the corners of a face are written in different ways: " + Quoted(line.Text));
    }
    ++corners;
  }
  if (corners < 3)
  {
    RefuseLine(line.Number,
      "a face has " + std::to_string(corners) +
        " corners, and needs 3 at least: " + Quoted(line.Text));
  }
}

// Decimal digits with a point and an exponent, where wanted: what every program understands under
// each setting of a language.
bool IsDecimal(const char* begin, const char* end, bool& exponent)
{
  const auto digits = [end](const char* at)
  { return std::find_if(at, end, [](char c) { return c < '0' || c > '9'; }); };
  const char* at = begin + (begin != end && (*begin == '-' || *begin == '+') ? 1 : 0);
  const char* whole = digits(at);
  std::ptrdiff_t count = whole - at;
  at = whole;
  if (at != end && *at == '.')
  {
    const char* part = digits(at + 1);
    count += part - (at + 1);
    at = part;
  }
  exponent = at != end && (*at == 'e' || *at == 'E');
  if (exponent)
  {
    ++at;
    at += at != end && (*at == '-' || *at == '+') ? 1 : 0;
    whole = digits(at);
    count = whole != at ? count : 0;
    at = whole;
  }
  return count > 0 && at == end;
}

// Whether a text is a number that a float can hold, as the reader reads it.
bool IsFloat(const char* begin, const char* end)
{
  bool exponent = false;
  if (!IsDecimal(begin, end, exponent))
  {
    return false;
  }
  constexpr std::ptrdiff_t safe = 38; // so many digits fit without an exponent
  if (!exponent && end - begin <= safe)
  {
    return true;
  }
  std::istringstream text(std::string(begin, end));
  text.imbue(std::locale::classic());
  float value = 0.0f;
  return static_cast<bool>(text >> value);
}

// The numbers of a point, a texture point or a normal; what else there is behind them, such as
// colors, is not read.
void CheckObjNumbers(const ObjLine& line, int kind)
{
  static const char* const expected[3] = { "a point is 'v x y z', with 3 numbers",
    "a texture point is 'vt u v', with 2 numbers", "a normal is 'vn x y z', with 3 numbers" };
  const char* at = line.Text.c_str() + (kind == 0 ? 1 : 2);
  for (int count = 0; count < (kind == 1 ? 2 : 3); ++count)
  {
    at += std::strspn(at, Blanks);
    const char* end = at + std::strcspn(at, Blanks);
    if (!IsFloat(at, end))
    {
      const bool comma = std::find(at, end, ',') != end;
      RefuseLine(line.Number,
        std::string(expected[kind]) + (comma ? " and decimal points, not " : ", not ") +
          Quoted(line.Text));
    }
    at = end;
  }
}

// The next line without blanks in front. Returns whether there is one.
bool NextObjLine(std::istream& stream, ObjLine& line, std::uint64_t& read)
{
  std::string& text = line.Text;
  if (!std::getline(stream, text))
  {
    return false;
  }
  line.Number = ++read;
  // A line goes on behind a backslash.
  std::string next;
  for (std::size_t last = text.find_last_not_of(Blanks);
       last != std::string::npos && text[last] == '\\' && std::getline(stream, next);
       last = text.find_last_not_of(Blanks))
  {
    text.replace(last, std::string::npos, " " + next);
    ++read;
  }
  const std::size_t begin = text.find_first_not_of(" \t");
  text.erase(0, begin == std::string::npos ? text.size() : begin);
  text.resize(text.size() + 3, ' ');
  return true;
}

// Some readers pass over the mark with the word behind it, others complain.
void CheckObjMark(const ObjLine& line)
{
  static const char* const mark = "\xEF\xBB\xBF";
  if (line.Number == 1 && line.Text.compare(0, 3, mark) == 0)
  {
    RefuseLine(1,
      "a byte order mark of UTF-8 is in front of " + Quoted(line.Text.substr(3)) +
        "; save the file without");
  }
}

void CheckObj(OpenFile& file)
{
  std::uint64_t counts[3] = { 0, 0, 0 };
  std::uint64_t read = 0;
  ObjLine line;
  while (NextObjLine(file.stream, line, read))
  {
    const std::string& text = line.Text;
    CheckObjMark(line);
    const char second = text[1];
    const bool blank = second == ' ' || second == '\t';
    const bool third = text[2] == ' ' || text[2] == '\t';
    const int kind = text[0] != 'v' ? -1
      : blank                       ? 0
      : second == 't' && third      ? 1
      : second == 'n' && third      ? 2
                                    : -1;
    if (kind >= 0)
    {
      CheckObjNumbers(line, kind);
      ++counts[kind];
    }
    else if (blank && text[0] == 'f')
    {
      CheckObjFace(line, counts);
    }
  }
  if (counts[0] == 0)
  {
    RefuseFormat("it is no OBJ file: it has no line of a point, 'v x y z'");
  }
}

//------------------------------------------------------------------------------
// Of texts of other formats the readers find out themselves.
void CheckWord(OpenFile& file, const char* word, const char* format)
{
  if (file.Begin(4096).find(word) == std::string::npos)
  {
    RefuseFormat(std::string("it is no ") + format + ": '" + word + "' is not in its beginning");
  }
}
}

//------------------------------------------------------------------------------
void CheckMeshFile(const std::string& fileName, const std::string& extension)
{
  OpenFile file(fileName);
  if (extension == ".stl")
  {
    CheckStl(file);
  }
  else if (extension == ".ply")
  {
    CheckPlyFile(file.stream, file.size);
  }
  else if (extension == ".glb")
  {
    CheckGlb(file);
  }
  else if (extension == ".gltf")
  {
    CheckWord(file, "{", "glTF");
  }
  else if (extension == ".obj")
  {
    CheckObj(file);
  }
  else if (extension == ".vtp")
  {
    CheckWord(file, "VTKFile", "XML file of VTK");
  }
  else if (extension == ".vtk")
  {
    CheckWord(file, "# vtk DataFile", "file of VTK");
  }
}

}

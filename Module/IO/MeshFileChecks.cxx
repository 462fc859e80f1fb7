// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFileChecks.h"

#include "FileGuard.h"
#include "PlyFileChecks.h"

#include "vtkErrorCode.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
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
}

//------------------------------------------------------------------------------
// One number of a corner of a face, from 1, or from the end if below 0.
bool IsThere(long long index, std::uint64_t count)
{
  return index > 0 ? static_cast<std::uint64_t>(index) <= count
                   : index < 0 && static_cast<std::uint64_t>(-index) <= count;
}

// Corners are numbers of a point, of a point and a texture point, or of a normal as well: 1, 1/2,
// 1//3 or 1/2/3. Behind # there is a comment.
void CheckObjFace(const std::string& line, const std::uint64_t counts[3])
{
  static const char* const kinds[3] = { " points", " texture points", " normals" };
  static const char* const blanks = " \t\r";
  const char* at = line.c_str() + 1;
  for (at += std::strspn(at, blanks); *at != '\0' && *at != '#'; at += std::strspn(at, blanks))
  {
    bool more = true;
    for (int kind = 0; more && kind < 3; ++kind)
    {
      char* end = nullptr;
      const long long index = std::strtoll(at, &end, 10);
      const bool skipped = end == at && kind == 1 && *at == '/';
      if (end != at && !IsThere(index, counts[kind]))
      {
        RefuseFormat("a face names number " + std::to_string(index) + " of " +
          std::to_string(counts[kind]) + kinds[kind]);
      }
      more = *end == '/';
      const bool ended = *end == '\0' || std::strchr(blanks, *end);
      if ((end == at && !skipped) || !(more || ended) || (more && kind == 2))
      {
        RefuseFormat("a face is no list of numbers: '" + Shortened(line) + "'");
      }
      at = more ? end + 1 : end;
    }
  }
}

void CheckObj(OpenFile& file)
{
  std::uint64_t counts[3] = { 0, 0, 0 };
  std::string line;
  bool known = false;
  while (std::getline(file.stream, line))
  {
    // A line goes on behind a backslash.
    std::string next;
    for (std::size_t last = line.find_last_not_of(" \t\r");
         last != std::string::npos && line[last] == '\\' && std::getline(file.stream, next);
         last = line.find_last_not_of(" \t\r"))
    {
      line.replace(last, std::string::npos, " " + next);
    }
    const std::size_t begin = line.find_first_not_of(" \t");
    line.erase(0, begin == std::string::npos ? line.size() : begin);
    line.resize(line.size() + 3, ' ');
    const char second = line[1];
    const bool blank = second == ' ' || second == '\t';
    const bool third = line[2] == ' ' || line[2] == '\t';
    const int kind = line[0] != 'v' ? -1
      : blank                       ? 0
      : second == 't' && third      ? 1
      : second == 'n' && third      ? 2
                                    : -1;
    counts[std::max(kind, 0)] += kind >= 0 ? 1 : 0;
    known = known || kind == 0;
    if (blank && line[0] == 'f')
    {
      CheckObjFace(line, counts);
    }
  }
  if (!known)
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

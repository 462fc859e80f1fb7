// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFileChecks.h"

#include "FileGuard.h"
#include "ObjText.h"
#include "PlyFileChecks.h"
#include "Refusals.h"

#include "vtkErrorCode.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

namespace relief::io
{

namespace
{
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
// Whether a reader can read a text: it takes numbers as floats.
class CheckedObj : public ObjText
{
public:
  explicit CheckedObj(std::istream& stream)
    : Stream(stream)
  {
  }

private:
  bool NextLine(std::string& line) override
  {
    return static_cast<bool>(std::getline(this->Stream, line));
  }
  bool TakeNumber(Kind, const char* begin, const char* end, bool plain) override
  {
    if (plain)
    {
      return true;
    }
    std::istringstream text(std::string(begin, end));
    text.imbue(std::locale::classic());
    float value = 0.0f;
    return static_cast<bool>(text >> value);
  }
  void TakeFace(const std::vector<std::uint64_t>&) override {}

  std::istream& Stream;
};

void CheckObj(OpenFile& file)
{
  const std::string wrong = CheckedObj(file.stream).Read();
  if (!wrong.empty())
  {
    RefuseFormat(wrong);
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

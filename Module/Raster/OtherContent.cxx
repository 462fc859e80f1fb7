// SPDX-License-Identifier: BSD-3-Clause
#include "OtherContent.h"

#include "FileGuard.h"

#include "vtkErrorCode.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>

namespace relief::raster
{
namespace
{
using vtksys::SystemTools;

std::string Beginning(const std::string& file)
{
  std::array<char, 256> buffer{};
  vtksys::ifstream stream(file.c_str(), std::ios::binary);
  stream.read(buffer.data(), buffer.size());
  return std::string(buffer.data(), static_cast<std::size_t>(stream.gcount()));
}

//------------------------------------------------------------------------------
/// What files of other kinds begin with, and what they are.
std::string ByContent(const std::string& start)
{
  struct Kind
  {
    std::string Start;
    const char* Name;
  };
  static const std::array<Kind, 12> kinds = {
    { { "LASF", "a point cloud; pdal or las2dem make a raster of one" },
      { "ASTM-E57", "a point cloud; pdal makes a raster of one" },
      { "ply\n", "a mesh or a point cloud; heights on a grid are expected" },
      { "ply\r", "a mesh or a point cloud; heights on a grid are expected" },
      { "solid ", "a mesh; heights on a grid are expected" },
      { "glTF", "a mesh; heights on a grid are expected" },
      { std::string("\0\0\x27\x0a", 4), "vectors; gdal_grid or gdal_rasterize make a raster" },
      { "SQLite format 3", "a database without a raster that is known" },
      { "PK\x03\x04", "an archive; unpack it, or name the raster in it as /vsizip/FILE/NAME" },
      { "\x1f\x8b", "compressed; unpack it, or read it as /vsigzip/FILE" },
      { "Rar!", "an archive; unpack it" }, { "7z\xbc\xaf", "an archive; unpack it" } }
  };
  for (const Kind& kind : kinds)
  {
    if (start.compare(0, kind.Start.size(), kind.Start) == 0)
    {
      return kind.Name;
    }
  }
  const std::size_t word = start.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  const char first = word == std::string::npos ? '\0' : start[word];
  if (first == '<')
  {
    return "a web page or other XML, perhaps what a server answered instead of the file";
  }
  if (first == '{')
  {
    return "JSON, perhaps what a server answered instead of the file";
  }
  return "";
}

#ifdef RELIEFRASTER_USE_GDAL
//------------------------------------------------------------------------------
bool IsOneOf(const std::string& extension, std::initializer_list<const char*> known)
{
  return std::find(known.begin(), known.end(), extension) != known.end();
}
#endif
}

//------------------------------------------------------------------------------
void RefuseOtherContent(const std::string& file)
{
  if (SystemTools::FileIsDirectory(file))
  {
    throw io::Failure(vtkErrorCode::CannotOpenFileError, "it is a directory");
  }
  const std::string kind = ByContent(Beginning(file));
  if (!kind.empty())
  {
    throw io::Failure(vtkErrorCode::UnrecognizedFileTypeError, "it is no raster but " + kind);
  }
#ifdef RELIEFRASTER_USE_GDAL
  const std::string extension = io::LowerExtension(file);
  if (IsOneOf(extension, { ".flt", ".bil", ".bip", ".bsq" }))
  {
    const std::string header =
      io::Shortened(SystemTools::GetFilenameWithoutLastExtension(file) + ".hdr");
    throw io::Failure(vtkErrorCode::UnrecognizedFileTypeError,
      SystemTools::FileExists(file.substr(0, file.size() - extension.size()) + ".hdr")
        ? "its header " + header + " does not fit it"
        : "its header is missing: " + header + " is expected beside it");
  }
  if (IsOneOf(extension, { ".r8", ".r16", ".r32", ".raw16", ".f32", ".bin" }))
  {
    throw io::Failure(vtkErrorCode::UnrecognizedFileTypeError,
      "it holds samples alone; an ENVI header of its name (.hdr) beside it tells their number and "
      "type");
  }
#endif
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceHeader.h"

#include "vtkErrorCode.h"

#include "FileGuard.h"

#include <vtksys/FStream.hxx>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <locale>
#include <map>
#include <sstream>
#include <system_error>

namespace relief::io
{
namespace
{
/// A line that may be anything, of which no more than a header's are long is kept.
bool TakeLine(std::istream& stream, std::string& line)
{
  const std::size_t longest = 4096;
  line.clear();
  for (char c; stream.get(c);)
  {
    if (c == '\n')
    {
      return true;
    }
    if (line.size() >= longest)
    {
      return false;
    }
    line += c;
  }
  return false;
}

//------------------------------------------------------------------------------
/// Multiplies by the numbers of a line, the last of which stands for all that lack. What is no
/// number above 0 changes nothing.
void Multiply(const std::string& text, std::array<double, 3>& exposure)
{
  std::istringstream numbers(text);
  numbers.imbue(std::locale::classic());
  double number = 1.0;
  for (double& component : exposure)
  {
    double next = 0.0;
    number = numbers >> next ? next : number;
    component *= number > 0.0 && std::isfinite(number) ? number : 1.0;
  }
}

//------------------------------------------------------------------------------
/// A number above 0 in decimal digits, or 0.
int Count(const std::string& text)
{
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  return error == std::errc() && end == text.data() + text.size() ? std::max(count, 0) : 0;
}
}

//------------------------------------------------------------------------------
bool IsRadiance(const std::string& fileName)
{
  vtksys::ifstream stream(fileName.c_str(), std::ios::binary);
  char begin[2] = {};
  stream.read(begin, 2);
  return begin[0] == '#' && begin[1] == '?';
}

//------------------------------------------------------------------------------
// "Radiance File Formats", radiance-online.org: lines of a name, = and a value, the exposures among
// them cumulative; an empty line; then the axis along which the lines follow one another, and the
// one along which their pixels do.
RadianceHeader ReadRadianceHeader(const std::string& fileName)
{
  RadianceHeader header;
  vtksys::ifstream stream(fileName.c_str(), std::ios::binary);
  std::string line;
  while (TakeLine(stream, line) && !line.empty())
  {
    const std::size_t equals = line.find('=');
    const std::string name = line.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : line.substr(equals + 1);
    if (name == "EXPOSURE" || name == "COLORCORR")
    {
      Multiply(value, header.Exposure);
    }
    if (name == "FORMAT" && value.find("xyze") != std::string::npos)
    {
      throw Failure(vtkErrorCode::FileFormatError,
        "its FORMAT is " + Shortened(value, 32) +
          " (CIE's XYZ); 32-bit_rle_rgbe is expected, ra_xyze -r converts it");
    }
  }
  TakeLine(stream, line);
  static const std::map<std::string, int> orientations{ { "-Y+X", 1 }, { "-Y-X", 2 }, { "+Y-X", 3 },
    { "+Y+X", 4 }, { "+X-Y", 5 }, { "-X-Y", 6 }, { "-X+Y", 7 }, { "+X+Y", 8 } };
  header.Pixels = stream ? static_cast<std::streamoff>(stream.tellg()) : 0;
  std::istringstream words(line);
  std::string first;
  std::string second;
  std::string lines;
  std::string pixels;
  words >> first >> lines >> second >> pixels;
  header.Rows = Count(lines);
  header.Columns = Count(pixels);
  const auto found = orientations.find(first + second);
  header.Orientation = found == orientations.end() ? 1 : found->second;
  return header;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "EsriGrid.h"

#include "vtkErrorCode.h"
#include "vtkType.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <system_error>

namespace relief::raster
{
namespace
{
/// What Microsoft's C library prints where a number is none, or has no end: 1.#QNAN,
/// -1.#IND, 1.#INF, also rounded (1.#J) or filled up with zeros.
bool ToNoNumber(const std::string& word, double& value)
{
  const std::size_t begin = word[0] == '+' || word[0] == '-' ? 1 : 0;
  const std::string known = "1.#";
  if (word.compare(begin, known.size(), known) != 0 || word.size() < begin + known.size() + 1 ||
    !std::all_of(word.begin() + begin + known.size(), word.end(),
      [](unsigned char c) { return std::isalnum(c); }))
  {
    return false;
  }
  const bool infinite = word.compare(begin + known.size(), 3, "INF") == 0;
  value =
    infinite ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  value = word[0] == '-' ? -value : value;
  return true;
}

//------------------------------------------------------------------------------
/// A point, no comma, whatever the locale says. Returns false unless the whole word is a number.
bool ToNumber(const std::string& word, double& value)
{
  if (word.find('#') != std::string::npos)
  {
    return ToNoNumber(word, value);
  }
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  const char* const begin = word.data() + (plus ? 1 : 0);
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(begin, end, value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end)
  {
    // It does not say whether the number is too small or too large.
    std::istringstream stream(word);
    stream.imbue(std::locale::classic());
    stream >> value;
    value =
      std::abs(value) > 1.0 ? std::copysign(std::numeric_limits<double>::infinity(), value) : 0.0;
    return true;
  }
  return result.ec == std::errc() && result.ptr == end;
}

//------------------------------------------------------------------------------
/// The words of a text, with the line that each stands in for messages. A byte order mark before
/// them is passed over.
class Words
{
public:
  explicit Words(const std::string& text)
    : Next(text.c_str() + (text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0))
  {
  }

  /// Where the next word is looked for.
  const char* At() const { return this->Next; }

  /// The next word without taking it; empty at the end.
  std::string Peek()
  {
    this->SkipSpace();
    const char* end = this->Next;
    while (*end && !std::isspace(static_cast<unsigned char>(*end)))
    {
      ++end;
    }
    return { this->Next, end };
  }

  std::string Take()
  {
    const std::string word = this->Peek();
    this->Next += word.size();
    return word;
  }

  double TakeNumber()
  {
    this->SkipSpace();
    const std::string word = this->Peek();
    double value = 0.0;
    if (!ToNumber(word, value))
    {
      throw io::Failure(
        *this->Next ? vtkErrorCode::FileFormatError : vtkErrorCode::PrematureEndOfFileError,
        "line " + std::to_string(this->Line) + ": " +
          (*this->Next ? "'" + io::Shortened(word, 32) + "' is no number" : "the file ends early"));
    }
    this->Next += word.size();
    return value;
  }

  int GetLine() const { return this->Line; }

private:
  void SkipSpace()
  {
    for (; std::isspace(static_cast<unsigned char>(*this->Next)); ++this->Next)
    {
      this->Line += *this->Next == '\n' ? 1 : 0;
    }
  }

  const char* Next;
  int Line = 1;
};

//------------------------------------------------------------------------------
/// All of it, or its beginning.
std::string ReadText(const std::string& file, std::size_t most = 0)
{
  std::ifstream stream(file, std::ios::binary);
  if (most > 0)
  {
    std::string text(most, '\0');
    stream.read(&text[0], static_cast<std::streamsize>(most));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
  }
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

//------------------------------------------------------------------------------
std::string Lower(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

//------------------------------------------------------------------------------
bool IsKey(const std::string& word)
{
  const char* const known[] = { "ncols", "nrows", "xllcorner", "xllcenter", "yllcorner",
    "yllcenter", "cellsize", "dx", "dy", "nodata_value" };
  return std::find(std::begin(known), std::end(known), word) != std::end(known);
}

//------------------------------------------------------------------------------
/// A number alone on its line may have a comma for a point.
std::string PointFor(std::string word)
{
  const std::size_t comma = word.find(',');
  if (comma != std::string::npos && word.find('.') == std::string::npos)
  {
    word[comma] = '.';
  }
  return word;
}

//------------------------------------------------------------------------------
/// The header, its keys in lower case: Esri's format has a key and a number in each line.
std::map<std::string, double> TakeHeader(Words& words)
{
  std::map<std::string, double> header;
  while (IsKey(Lower(words.Peek())))
  {
    const std::string key = Lower(words.Take());
    double value = 0.0;
    if (!ToNumber(PointFor(words.Peek()), value))
    {
      throw io::Failure(vtkErrorCode::FileFormatError,
        "line " + std::to_string(words.GetLine()) + ": '" + io::Shortened(words.Peek(), 32) +
          "' is no number, and " + key + " needs one" +
          (key == "nodata_value" ? ", or its line is left out" : ""));
    }
    words.Take();
    if (!header.emplace(key, value).second)
    {
      throw io::Failure(vtkErrorCode::FileFormatError,
        "line " + std::to_string(words.GetLine()) + ": " + key + " is given twice");
    }
  }
  return header;
}

//------------------------------------------------------------------------------
double GetNumber(
  const std::map<std::string, double>& header, const char* key, const char* other = "")
{
  const auto found = header.count(key) ? header.find(key) : header.find(other);
  if (found == header.end() || !std::isfinite(found->second))
  {
    throw io::Failure(vtkErrorCode::FileFormatError, std::string("its header lacks a good ") + key);
  }
  return found->second;
}

//------------------------------------------------------------------------------
int GetCount(const std::map<std::string, double>& header, const char* key)
{
  const double count = GetNumber(header, key);
  if (count < 1.0 || count > VTK_INT_MAX || count != std::floor(count))
  {
    throw io::Failure(vtkErrorCode::FileFormatError, std::string("its header lacks a good ") + key);
  }
  return static_cast<int>(count);
}

//------------------------------------------------------------------------------
RasterHeader Describe(const std::map<std::string, double>& header)
{
  RasterHeader raster;
  raster.Columns = GetCount(header, "ncols");
  raster.Rows = GetCount(header, "nrows");
  raster.ScalarType = VTK_FLOAT;
  raster.Driver = "AAIGrid";
  const double dx = GetNumber(header, "cellsize", "dx");
  const double dy = GetNumber(header, "cellsize", "dy");
  if (!(dx > 0.0) || !(dy > 0.0))
  {
    throw io::Failure(vtkErrorCode::FileFormatError, "its cell size is not above 0");
  }
  if (header.count("nodata_value"))
  {
    raster.NoData = header.at("nodata_value");
  }
  const double left = header.count("xllcenter") ? GetNumber(header, "xllcenter") - 0.5 * dx
                                                : GetNumber(header, "xllcorner");
  const double bottom = header.count("yllcenter") ? GetNumber(header, "yllcenter") - 0.5 * dy
                                                  : GetNumber(header, "yllcorner");
  raster.Reference.Present = true;
  raster.Reference.Transform = { left, dx, 0.0, bottom + raster.Rows * dy, 0.0, -dy };
  return raster;
}

//------------------------------------------------------------------------------
/// Blanks part numbers, whose point is a point. Where there are commas, they part numbers or stand
/// for points: which, the number of heights tells. Semicolons part numbers in any case.
void ReadCommas(std::string& text, std::size_t begin, std::size_t expected)
{
  std::replace(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), ';', ' ');
  if (text.find(',', begin) == std::string::npos)
  {
    return;
  }
  // Count the words that blanks part, and those that commas part as well.
  std::size_t words = 0;
  std::size_t parts = 0;
  bool inWord = false;
  bool inPart = false;
  bool afterComma = false;
  int commas = 0;
  bool points = false; // or words that would have two
  for (std::size_t k = begin; k < text.size(); ++k)
  {
    const bool blank = std::isspace(static_cast<unsigned char>(text[k])) != 0;
    const bool separates = blank || text[k] == ',';
    words += !blank && !inWord ? 1 : 0;
    parts += !separates && !inPart ? 1 : 0;
    // Between two commas a number is missing.
    const bool comma = text[k] == ',';
    parts += comma && afterComma ? 1 : 0;
    afterComma = comma || (afterComma && blank);
    inWord = !blank;
    inPart = !separates;
    commas = blank ? 0 : commas + (comma ? 1 : 0);
    points = points || text[k] == '.' || commas > 1;
  }
  if (parts != expected && (words != expected || points))
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "it has commas, and it is not clear whether they part numbers or stand for points: " +
        std::to_string(expected) + " heights are announced, " + std::to_string(words) + " or " +
        std::to_string(parts) + " found");
  }
  std::replace(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), ',',
    parts == expected ? ' ' : '.');
}
}

//------------------------------------------------------------------------------
bool IsEsriGrid(const std::string& file)
{
  std::string begin(64, '\0');
  std::ifstream(file, std::ios::binary).read(&begin[0], 64);
  return IsKey(Lower(Words(begin).Take()));
}

//------------------------------------------------------------------------------
RasterHeader ReadEsriHeader(const std::string& file)
{
  // Longer than any header.
  const std::string text = ReadText(file, 1 << 14);
  Words words(text);
  return Describe(TakeHeader(words));
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadEsriHeights(
  const std::string& file, const MemoryPlan& plan, const io::StepWatcher& watcher)
{
  std::string text = ReadText(file);
  Words words(text);
  const RasterHeader header = Describe(TakeHeader(words));
  const int columns = header.Columns;
  const int rows = header.Rows;
  // Every height takes two characters at least: a damaged header asks for no memory in vain.
  if (text.size() / 2 + 1 < static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
  {
    throw io::Failure(vtkErrorCode::PrematureEndOfFileError,
      "the file ends early: " + std::to_string(columns) + " x " + std::to_string(rows) +
        " heights are announced");
  }

  plan.Claim(columns, rows, sizeof(float), static_cast<double>(text.size()));
  ReadCommas(text, static_cast<std::size_t>(words.At() - text.c_str()),
    static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));

  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* heights = static_cast<float*>(image->GetScalarPointer());
  for (int row = rows - 1; row >= 0; --row)
  {
    io::Advance(watcher, 1.0 - (row + 1.0) / rows);
    float* values = heights + static_cast<std::size_t>(row) * columns;
    for (int column = 0; column < columns; ++column)
    {
      values[column] = static_cast<float>(words.TakeNumber());
    }
  }
  if (!words.Peek().empty())
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "line " + std::to_string(words.GetLine()) + ": more than " + std::to_string(columns) + " x " +
        std::to_string(rows) + " heights");
  }
  return image;
}

//------------------------------------------------------------------------------
bool HasGeographicProjection(const std::string& file)
{
  const std::string text = ReadText(std::filesystem::path(file).replace_extension(".prj").string());
  return text.compare(0, 7, "GEOGCS[") == 0 || text.compare(0, 8, "GEOGCRS[") == 0;
}

}

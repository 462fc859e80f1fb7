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
#include <mutex>
#include <sstream>
#include <system_error>
#include <utility>

namespace relief::raster
{
namespace
{
/// Longer than any header.
constexpr std::size_t LongestHeader = 1 << 14;

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

  /// Those of a text that begins in some line of a file.
  Words(const std::string& text, int line)
    : Next(text.c_str())
    , Line(line)
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

  /// Passes over words, whatever they are.
  void Skip(int count)
  {
    for (int k = 0; k < count; ++k)
    {
      this->SkipSpace();
      while (*this->Next && !std::isspace(static_cast<unsigned char>(*this->Next)))
      {
        ++this->Next;
      }
    }
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
/// Counts the numbers of a text. Blanks and semicolons part them, and their point is a point. Where
/// there are commas, they part numbers or stand for points: which, the number of heights tells.
class NumberCount
{
public:
  /// Takes the next character.
  void Take(char c)
  {
    const bool comma = c == ',';
    const bool blank = c == ';' || std::isspace(static_cast<unsigned char>(c)) != 0;
    const bool separates = blank || comma;
    this->BeginsWord = !blank && !this->InWord;
    this->BeginsPart = !separates && !this->InPart;
    this->Words += this->BeginsWord ? 1 : 0;
    this->Parts += this->BeginsPart ? 1 : 0;
    // Between two commas a number is missing.
    this->Missing += comma && this->AfterComma ? 1 : 0;
    this->AfterComma = comma || (this->AfterComma && blank);
    this->InWord = !blank;
    this->InPart = !separates;
    this->Commas = this->Commas || comma;
    this->CommasOfWord = blank ? 0 : this->CommasOfWord + (comma ? 1 : 0);
    this->Points = this->Points || c == '.' || this->CommasOfWord > 1;
  }

  /// Whether a number begins with the last one: where blanks part them, and where commas do.
  bool BeginsWord = false;
  bool BeginsPart = false;

  /// Whether commas part numbers. Throws a Failure where that is not clear.
  bool PartsByCommas(std::size_t expected) const
  {
    const std::size_t parts = this->Parts + this->Missing;
    if (this->Commas && parts != expected && (this->Words != expected || this->Points))
    {
      throw io::Failure(vtkErrorCode::FileFormatError,
        "it has commas, and it is not clear whether they part numbers or stand for points: " +
          std::to_string(expected) + " heights are announced, " + std::to_string(this->Words) +
          " or " + std::to_string(parts) + " found");
    }
    return this->Commas && parts == expected;
  }

private:
  std::size_t Words = 0;   // that blanks part
  std::size_t Parts = 0;   // that commas part as well
  std::size_t Missing = 0; // of these
  bool InWord = false;
  bool InPart = false;
  bool AfterComma = false;
  bool Commas = false;
  int CommasOfWord = 0;
  bool Points = false; // or words that would have two
};

//------------------------------------------------------------------------------
/// Makes numbers that blanks part, with points, of a text from an offset on.
void SetSeparators(std::string& text, std::size_t begin, bool partedByCommas)
{
  const auto first = text.begin() + static_cast<std::ptrdiff_t>(begin);
  std::replace(first, text.end(), ';', ' ');
  std::replace(first, text.end(), ',', partedByCommas ? ' ' : '.');
}

//------------------------------------------------------------------------------
std::size_t CountOf(const RasterHeader& header)
{
  return static_cast<std::size_t>(header.Columns) * static_cast<std::size_t>(header.Rows);
}

//------------------------------------------------------------------------------
/// Every height takes two characters at least: a damaged header asks for no memory in vain.
void CheckLength(const RasterHeader& header, double bytes)
{
  if (bytes / 2.0 + 1.0 < static_cast<double>(CountOf(header)))
  {
    throw io::Failure(vtkErrorCode::PrematureEndOfFileError,
      "the file ends early: " + std::to_string(header.Columns) + " x " +
        std::to_string(header.Rows) + " heights are announced");
  }
}

//------------------------------------------------------------------------------
io::Failure TooMany(const RasterHeader& header, int line)
{
  return { vtkErrorCode::FileFormatError,
    "line " + std::to_string(line) + ": more than " + std::to_string(header.Columns) + " x " +
      std::to_string(header.Rows) + " heights" };
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
  const std::string text = ReadText(file, LongestHeader);
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
  CheckLength(header, static_cast<double>(text.size()));

  plan.Claim(columns, rows, sizeof(float), static_cast<double>(text.size()));
  const auto begin = static_cast<std::size_t>(words.At() - text.c_str());
  NumberCount count;
  std::for_each(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(),
    [&count](char c) { count.Take(c); });
  SetSeparators(text, begin, count.PartsByCommas(CountOf(header)));

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
    throw TooMany(header, words.GetLine());
  }
  return image;
}

double SizeOfText(const std::string& file)
{
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  return code ? 0.0 : static_cast<double>(size);
}

namespace
{
/// Where the rows of a grid begin, if numbers are parted in one of two ways.
class RowStarts
{
public:
  explicit RowStarts(const RasterHeader& header)
    : Header(header)
  {
    this->Starts.reserve(static_cast<std::size_t>(header.Rows) + 1);
  }

  /// Told of every number.
  void Add(std::uint64_t offset, int line)
  {
    if (this->Found++ == this->Next)
    {
      // Behind the last row there is to be none.
      const std::size_t columns = static_cast<std::size_t>(this->Header.Columns);
      const bool behind = this->Starts.size() == static_cast<std::size_t>(this->Header.Rows);
      this->Starts.push_back({ offset, line });
      this->Next += behind ? std::numeric_limits<std::size_t>::max() - this->Next : columns;
    }
  }

  /// Those of all rows, and the end of the file. Throws a Failure unless there is a number for
  /// every height.
  EsriRows::Starts Take(std::uint64_t end, int lastLine)
  {
    if (this->Found > CountOf(this->Header))
    {
      throw TooMany(this->Header, this->Starts.back().Line);
    }
    if (this->Found < CountOf(this->Header))
    {
      throw io::Failure(vtkErrorCode::PrematureEndOfFileError,
        "line " + std::to_string(lastLine) + ": the file ends early");
    }
    this->Starts.push_back({ end, lastLine });
    return std::move(this->Starts);
  }

private:
  const RasterHeader& Header;
  EsriRows::Starts Starts;
  std::size_t Found = 0;
  std::size_t Next = 0; // that begins a row
};
}

//------------------------------------------------------------------------------
EsriRows::EsriRows(const std::string& file)
  : Name(file)
{
  const std::string head = ReadText(file, LongestHeader);
  Words words(head);
  const RasterHeader header = Describe(TakeHeader(words));
  this->Rows = header.Rows;
  std::ifstream stream(file, std::ios::binary);
  CheckLength(header, SizeOfText(file));

  // Once through the text; what its commas are is known at the end.
  std::uint64_t offset = static_cast<std::uint64_t>(words.At() - head.c_str());
  stream.seekg(static_cast<std::streamoff>(offset));
  int line = words.GetLine();
  NumberCount count;
  RowStarts byBlanks(header);
  RowStarts byCommas(header);
  std::vector<char> buffer(std::size_t(1) << 20);
  bool ended = false; // at a character that ends texts
  while (!ended && stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size())).gcount())
  {
    const std::streamsize got = stream.gcount();
    for (std::streamsize k = 0; k < got && !ended; ++k, ++offset)
    {
      const char c = buffer[static_cast<std::size_t>(k)];
      ended = c == '\0';
      count.Take(ended ? ' ' : c);
      if (count.BeginsWord)
      {
        byBlanks.Add(offset, line);
      }
      if (count.BeginsPart)
      {
        byCommas.Add(offset, line);
      }
      line += c == '\n' ? 1 : 0;
    }
  }
  this->PartedByCommas = count.PartsByCommas(CountOf(header));
  this->Begins = (this->PartedByCommas ? byCommas : byBlanks).Take(offset, line);
}

//------------------------------------------------------------------------------
std::shared_ptr<const EsriRows> EsriRows::Of(const std::string& file)
{
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const EsriRows>> known;
  std::error_code code;
  const std::string state = file + "\n" + std::to_string(SizeOfText(file)) + "\n" +
    std::to_string(std::filesystem::last_write_time(file, code).time_since_epoch().count());
  // Another thread that wants the same waits.
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<const EsriRows> rows = known[state].lock();
  if (!rows)
  {
    for (auto other = known.begin(); other != known.end();)
    {
      other = other->second.expired() ? known.erase(other) : std::next(other);
    }
    rows = std::make_shared<EsriRows>(file);
    known[state] = rows;
  }
  return rows;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> EsriRows::Read(const RasterFile::Window& window) const
{
  const int width = window.i1 - window.i0;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, window.j1 - window.j0, 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(image->GetScalarPointer());
  std::ifstream stream(this->Name, std::ios::binary);
  std::string text;
  for (int j = window.j0; j < window.j1; ++j, values += width)
  {
    // The file begins with the northern row.
    const auto row = static_cast<std::size_t>(this->Rows - 1 - j);
    const Start& start = this->Begins[row];
    text.resize(static_cast<std::size_t>(this->Begins[row + 1].Offset - start.Offset));
    stream.seekg(static_cast<std::streamoff>(start.Offset));
    stream.read(&text[0], static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    stream.clear();
    SetSeparators(text, 0, this->PartedByCommas);
    Words words(text, start.Line);
    words.Skip(window.i0);
    for (int i = 0; i < width; ++i)
    {
      values[i] = static_cast<float>(words.TakeNumber());
    }
  }
  return image;
}

//------------------------------------------------------------------------------
std::vector<std::string> FilesOfEsriGrid(const std::string& file)
{
  const std::string projection = std::filesystem::path(file).replace_extension(".prj").string();
  std::error_code code;
  return std::filesystem::exists(projection, code) ? std::vector<std::string>{ file, projection }
                                                   : std::vector<std::string>{ file };
}

//------------------------------------------------------------------------------
bool HasGeographicProjection(const std::string& file)
{
  const std::string text = ReadText(std::filesystem::path(file).replace_extension(".prj").string());
  return text.compare(0, 7, "GEOGCS[") == 0 || text.compare(0, 8, "GEOGCRS[") == 0;
}

}

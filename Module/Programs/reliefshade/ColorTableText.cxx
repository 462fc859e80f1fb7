// SPDX-License-Identifier: BSD-3-Clause
#include "ColorTableText.h"

#include "FileGuard.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace
{

using namespace reliefshade;
using relief::io::Shortened;

using Color = std::array<double, 4>;

constexpr double Infinity = std::numeric_limits<double>::infinity();

//------------------------------------------------------------------------------
std::string lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

//------------------------------------------------------------------------------
/// The words between blanks and the separators, in lower case.
std::vector<std::string> splitLine(const std::string& line, const std::string& separators)
{
  std::vector<std::string> words(1);
  for (const char c : lower(line))
  {
    if (std::isspace(static_cast<unsigned char>(c)) || separators.find(c) != std::string::npos)
    {
      words.emplace_back();
    }
    else
    {
      words.back() += c;
    }
  }
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
}

//------------------------------------------------------------------------------
std::string quoted(const std::string& word)
{
  return "'" + Shortened(word, 32) + "'";
}

//------------------------------------------------------------------------------
double number(const std::string& word)
{
  // The program never sets a locale, so this is the C locale's reading: a point, no comma.
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end || !std::isfinite(value))
  {
    throw std::runtime_error(quoted(word) + " is no number");
  }
  return value;
}

//------------------------------------------------------------------------------
/// A number within a range, as a share of it.
double share(const std::string& word, double greatest = 255.0)
{
  const double value = number(word);
  if (!(value >= 0.0 && value <= greatest))
  {
    throw std::runtime_error(
      quoted(word) + " is not from 0 to " + std::to_string(static_cast<int>(greatest)));
  }
  return value / greatest;
}

using Names = std::map<std::string, std::array<double, 3>>;

//------------------------------------------------------------------------------
Color named(const std::array<double, 3>& color)
{
  return { color[0] / 255.0, color[1] / 255.0, color[2] / 255.0, 1.0 };
}

//------------------------------------------------------------------------------
/// Red, green, blue and perhaps alpha, or the name of a colour, in words[1] and behind it.
Color colorOf(const std::vector<std::string>& words)
{
  // The names that GRASS has given to its r.colors, and gdaldem has from there.
  static const Names names{ { "white", { 255, 255, 255 } }, { "black", { 0, 0, 0 } },
    { "red", { 255, 0, 0 } }, { "green", { 0, 255, 0 } }, { "blue", { 0, 0, 255 } },
    { "yellow", { 255, 255, 0 } }, { "magenta", { 255, 0, 255 } }, { "cyan", { 0, 255, 255 } },
    { "aqua", { 0, 191, 191 } }, { "grey", { 191, 191, 191 } }, { "gray", { 191, 191, 191 } },
    { "orange", { 255, 127, 0 } }, { "brown", { 191, 127, 63 } }, { "purple", { 127, 0, 255 } },
    { "violet", { 127, 0, 255 } }, { "indigo", { 0, 127, 255 } } };
  Color color{ 0.0, 0.0, 0.0, 1.0 };
  std::size_t alpha = 4;
  const auto found = words.size() > 1 ? names.find(words[1]) : names.end();
  if (found != names.end())
  {
    color = named(found->second);
    alpha = 2;
  }
  else if (words.size() < 4)
  {
    throw std::runtime_error("expected are a height and red, green, blue or a colour's name");
  }
  if (words.size() > alpha + 1)
  {
    throw std::runtime_error(quoted(words[alpha + 1]) + " is one word too many");
  }
  for (std::size_t c = alpha == 4 ? 0 : 3; c < 4 && c + alpha - 3 < words.size(); ++c)
  {
    color[c] = share(words[c + alpha - 3]);
  }
  return color;
}

//------------------------------------------------------------------------------
/// What QGIS calls interpolation.
enum class Filling
{
  Interpolated,
  Discrete, ///< each colour reaches from the height before to its own
  Exact
};

/// The lines of a table, still in their order.
struct Table
{
  std::vector<ColorNode> Entries;
  Filling Between = Filling::Interpolated;
};

//------------------------------------------------------------------------------
/// `INTERPOLATION:` and one of QGIS's three words.
bool takeFilling(const std::string& line, Filling& filling)
{
  const std::vector<std::string> words = splitLine(line, ":");
  if (words.empty() || words[0] != "interpolation")
  {
    return false;
  }
  static const std::map<std::string, Filling> known{ { "interpolated", Filling::Interpolated },
    { "discrete", Filling::Discrete }, { "exact", Filling::Exact } };
  const auto found = known.find(words.size() == 2 ? words[1] : "");
  if (found == known.end())
  {
    throw std::runtime_error("INTERPOLATED, DISCRETE or EXACT is expected behind 'INTERPOLATION:'");
  }
  filling = found->second;
  return true;
}

//------------------------------------------------------------------------------
/// The five numbers of a line of QGIS, without the label behind them, which may be any text.
std::vector<std::string> splitQgisLine(const std::string& line)
{
  std::size_t end = 0;
  for (int commas = 0; end < line.size() && commas < 5; ++end)
  {
    commas += line[end] == ',' ? 1 : 0;
  }
  return splitLine(line.substr(0, end), ",");
}

//------------------------------------------------------------------------------
/// A line of gdaldem's or QGIS's.
void addEntry(const std::vector<std::string>& words,
  const std::function<double(double)>& heightOfShare, Table& table)
{
  const Color color = colorOf(words);
  std::string height = words[0];
  if (height == "nv")
  {
    return; // samples without data are transparent in any case
  }
  if (table.Between == Filling::Discrete && (height == "inf" || height == "+inf"))
  {
    table.Entries.push_back({ Infinity, color });
    return;
  }
  if (height.back() != '%')
  {
    table.Entries.push_back({ number(height), color });
    return;
  }
  height.pop_back();
  table.Entries.push_back({ heightOfShare(number(height) / 100.0), color });
}

//------------------------------------------------------------------------------
/// The nodes of entries that stand in any order.
std::vector<ColorNode> nodesOf(Table& table)
{
  std::vector<ColorNode>& entries = table.Entries;
  std::stable_sort(entries.begin(), entries.end(),
    [](const ColorNode& a, const ColorNode& b) { return a.Height < b.Height; });
  if (table.Between == Filling::Interpolated)
  {
    return entries;
  }
  std::vector<ColorNode> nodes;
  const auto add = [&nodes](double height, Color color, bool visible)
  {
    color[3] = visible ? color[3] : 0.0;
    nodes.push_back({ height, color });
  };
  double begin = -std::numeric_limits<double>::max();
  for (const ColorNode& entry : entries)
  {
    if (table.Between == Filling::Discrete)
    {
      const double end = std::min(entry.Height, std::numeric_limits<double>::max());
      add(begin, entry.Color, true);
      add(end, entry.Color, true);
      begin = std::nextafter(end, Infinity);
      continue;
    }
    // A number that was printed is met by those that single precision makes of it.
    const double near = std::numeric_limits<float>::epsilon() * std::abs(entry.Height);
    add(std::nextafter(entry.Height - near, -Infinity), entry.Color, false);
    add(entry.Height - near, entry.Color, true);
    add(entry.Height + near, entry.Color, true);
    add(std::nextafter(entry.Height + near, Infinity), entry.Color, false);
  }
  if (table.Between == Filling::Discrete && std::isfinite(begin))
  {
    add(begin, entries.back().Color, false); // above the last height QGIS shows nothing
  }
  return nodes;
}

//------------------------------------------------------------------------------
/// GMT's tables: a line for each segment, of two heights with a colour each.
class GmtTable
{
public:
  /// A line that begins with #.
  void AddComment(const std::string& line);
  void AddLine(const std::string& line);
  std::vector<ColorNode> Nodes() const;

private:
  struct ModelColor
  {
    Color Parts; ///< three from 0 to 1, and alpha
    bool Hsv;
    Color ToRGB() const;
  };
  ModelColor Take(
    const std::vector<std::string>& words, std::size_t first, std::size_t count) const;

  struct Segment
  {
    double Low;
    double High;
    ModelColor First;
    ModelColor Last;
  };
  std::vector<Segment> Segments;
  std::vector<Color> Below; ///< one or none
  std::vector<Color> Above;
  bool Hsv = false;          ///< what three numbers mean
  bool BetweenInHsv = false; ///< how colours between two are found
};

//------------------------------------------------------------------------------
void GmtTable::AddComment(const std::string& line)
{
  const std::vector<std::string> words = splitLine(line, "#=");
  if (words.size() < 2 || words[0] != "color_model")
  {
    return;
  }
  const bool inside = words[1][0] == '+';
  const std::string model = words[1].substr(inside ? 1 : 0);
  if (model != "rgb" && model != "hsv")
  {
    throw std::runtime_error("the colour model " + quoted(model) + " is not read; RGB and HSV are");
  }
  this->Hsv = model == "hsv";
  this->BetweenInHsv = inside && this->Hsv;
}

//------------------------------------------------------------------------------
Color GmtTable::ModelColor::ToRGB() const
{
  if (!this->Hsv)
  {
    return this->Parts;
  }
  const auto part = [this](double shift)
  {
    const double k = std::fmod(shift + this->Parts[0] * 6.0, 6.0);
    const double share = std::max(0.0, std::min({ k, 4.0 - k, 1.0 }));
    return this->Parts[2] * (1.0 - this->Parts[1] * share);
  };
  return { part(5.0), part(3.0), part(1.0), this->Parts[3] };
}

//------------------------------------------------------------------------------
/// The parts of r/g/b, or of h-s-v, whose numbers may have exponents.
std::vector<std::string> partsOf(const std::string& word, char separator)
{
  std::vector<std::string> parts(1);
  for (std::size_t k = 0; k < word.size(); ++k)
  {
    const bool exponent = separator == '-' && k > 0 && word[k - 1] == 'e';
    if (word[k] == separator && !exponent)
    {
      parts.emplace_back();
    }
    else
    {
      parts.back() += word[k];
    }
  }
  return parts;
}

//------------------------------------------------------------------------------
GmtTable::ModelColor GmtTable::Take(
  const std::vector<std::string>& words, std::size_t first, std::size_t count) const
{
  // X11's names, as GMT has them.
  static const Names names{ { "black", { 0, 0, 0 } }, { "white", { 255, 255, 255 } },
    { "red", { 255, 0, 0 } }, { "green", { 0, 255, 0 } }, { "blue", { 0, 0, 255 } },
    { "yellow", { 255, 255, 0 } }, { "cyan", { 0, 255, 255 } }, { "magenta", { 255, 0, 255 } },
    { "gray", { 190, 190, 190 } }, { "grey", { 190, 190, 190 } },
    { "lightgray", { 211, 211, 211 } }, { "lightgrey", { 211, 211, 211 } },
    { "darkgray", { 169, 169, 169 } }, { "darkgrey", { 169, 169, 169 } },
    { "orange", { 255, 165, 0 } }, { "brown", { 165, 42, 42 } }, { "tan", { 210, 180, 140 } },
    { "purple", { 160, 32, 240 } }, { "violet", { 238, 130, 238 } }, { "pink", { 255, 192, 203 } },
    { "navy", { 0, 0, 128 } }, { "lightblue", { 173, 216, 230 } }, { "darkblue", { 0, 0, 139 } },
    { "lightgreen", { 144, 238, 144 } }, { "darkgreen", { 0, 100, 0 } },
    { "darkred", { 139, 0, 0 } }, { "darkorange", { 255, 140, 0 } },
    { "lightyellow", { 255, 255, 224 } }, { "beige", { 245, 245, 220 } },
    { "turquoise", { 64, 224, 208 } } };
  std::vector<std::string> parts(words.begin() + first, words.begin() + first + count);
  bool hsv = this->Hsv;
  double alpha = 1.0;
  const std::size_t at = parts.back().find('@');
  if (at != std::string::npos)
  {
    alpha = 1.0 - share(parts.back().substr(at + 1), 100.0);
    parts.back().erase(at);
  }
  Color color{ 0.0, 0.0, 0.0, 1.0 };
  const std::string word = parts[0];
  if (count == 1 && names.count(word))
  {
    hsv = false;
    color = named(names.at(word));
  }
  else if (count == 1 && word.size() == 7 && word[0] == '#' &&
    word.find_first_not_of("0123456789abcdef", 1) == std::string::npos)
  {
    hsv = false;
    for (int c = 0; c < 3; ++c)
    {
      color[c] = std::stoi(word.substr(1 + 2 * c, 2), nullptr, 16) / 255.0;
    }
  }
  else
  {
    if (count == 1)
    {
      const bool slashes = word.find('/') != std::string::npos;
      hsv = !slashes && partsOf(word, '-').size() == 3;
      parts = partsOf(word, slashes ? '/' : '-');
      parts = parts.size() == 1 ? std::vector<std::string>(3, parts[0]) : parts; // grey
    }
    if (parts.size() != 3)
    {
      throw std::runtime_error(quoted(word) + " is no colour; r/g/b, h-s-v or a name is expected");
    }
    for (int c = 0; c < 3; ++c)
    {
      color[c] = share(parts[c], !hsv ? 255.0 : c == 0 ? 360.0 : 1.0);
    }
  }
  color[3] = alpha;
  return { color, hsv };
}

//------------------------------------------------------------------------------
void GmtTable::AddLine(const std::string& line)
{
  std::vector<std::string> words = splitLine(line.substr(0, line.find(';')), "");
  if (words.empty())
  {
    return;
  }
  const std::string first = words[0];
  const bool ends = first == "b" || first == "f" || first == "n";
  // Which ends of a segment have their heights written on a scale.
  if (!ends && words.size() > 4 &&
    (words.back() == "l" || words.back() == "u" || words.back() == "b"))
  {
    words.pop_back();
  }
  const std::size_t count = words.size();
  if (ends && (count == 2 || count == 4))
  {
    const Color color = this->Take(words, 1, count - 1).ToRGB();
    if (first != "n") // samples without data are transparent in any case
    {
      (first == "b" ? this->Below : this->Above) = { color };
    }
    return;
  }
  if (ends || (count != 4 && count != 8))
  {
    throw std::runtime_error("expected are two heights with a colour each, as GMT has them");
  }
  const std::size_t half = count / 2;
  const Segment segment{ number(words[0]), number(words[half]), this->Take(words, 1, half - 1),
    this->Take(words, half + 1, half - 1) };
  if (!(segment.Low < segment.High) ||
    (!this->Segments.empty() && segment.Low < this->Segments.back().High))
  {
    throw std::runtime_error("heights are expected to rise from segment to segment");
  }
  this->Segments.push_back(segment);
}

//------------------------------------------------------------------------------
std::vector<ColorNode> GmtTable::Nodes() const
{
  std::vector<ColorNode> nodes;
  if (this->Segments.empty())
  {
    return nodes;
  }
  if (!this->Below.empty())
  {
    nodes.push_back({ std::nextafter(this->Segments.front().Low, -Infinity), this->Below[0] });
  }
  for (const Segment& segment : this->Segments)
  {
    const bool inHsv = this->BetweenInHsv && segment.First.Hsv && segment.Last.Hsv;
    const Color first = inHsv ? segment.First.Parts : segment.First.ToRGB();
    const Color second = inHsv ? segment.Last.Parts : segment.Last.ToRGB();
    const int steps = inHsv ? 32 : 1;
    // A height between two segments is the upper one's.
    const bool last = &segment == &this->Segments.back();
    const double high = last ? segment.High : std::nextafter(segment.High, -Infinity);
    for (int k = 0; k <= steps; ++k)
    {
      const double t = static_cast<double>(k) / steps;
      ModelColor color{ {}, inHsv };
      std::transform(first.begin(), first.end(), second.begin(), color.Parts.begin(),
        [t](double a, double b) { return a + t * (b - a); });
      nodes.push_back(
        { k == steps ? high : segment.Low + t * (high - segment.Low), color.ToRGB() });
    }
  }
  if (!this->Above.empty())
  {
    nodes.push_back({ std::nextafter(this->Segments.back().High, Infinity), this->Above[0] });
  }
  return nodes;
}

//------------------------------------------------------------------------------
std::vector<std::string> readLines(std::istream& stream)
{
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
  {
    lines.push_back(line);
  }
  const std::string byteOrderMark = "\xEF\xBB\xBF";
  if (!lines.empty() && lines[0].compare(0, byteOrderMark.size(), byteOrderMark) == 0)
  {
    lines[0].erase(0, byteOrderMark.size());
  }
  return lines;
}

//------------------------------------------------------------------------------
/// Whether a line is in none of the other forms: GMT's model, or its colours at the ends.
bool isGmtLine(const std::string& line)
{
  if (line[0] == '#')
  {
    return splitLine(line, "#=")[0] == "color_model";
  }
  const std::vector<std::string> words = splitLine(line, "");
  return words[0] == "b" || words[0] == "f" || words[0] == "n";
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
std::vector<ColorNode> parseColorTable(
  std::istream& stream, bool gmt, const std::function<double(double)>& heightOfShare)
{
  const std::vector<std::string> lines = readLines(stream);
  const auto any = [&lines](bool (*is)(const std::string&))
  {
    return std::any_of(lines.begin(), lines.end(),
      [is](const std::string& line) { return !splitLine(line, "#").empty() && is(line); });
  };
  gmt = gmt || any(&isGmtLine);
  bool qgis = any([](const std::string& line)
    { return line[0] == '#' && line.find("QGIS") != std::string::npos; });
  Table table;
  GmtTable segments;
  int lineNumber = 0;
  for (const std::string& line : lines)
  {
    ++lineNumber;
    try
    {
      if (gmt)
      {
        !line.empty() && line[0] == '#' ? segments.AddComment(line) : segments.AddLine(line);
        continue;
      }
      const std::string text = line.substr(0, qgis && line[0] != '#' ? line.npos : line.find('#'));
      if (takeFilling(text, table.Between))
      {
        qgis = true;
        continue;
      }
      const std::vector<std::string> words = qgis ? splitQgisLine(text) : splitLine(text, ",:");
      if (!words.empty())
      {
        addEntry(words, heightOfShare, table);
      }
    }
    catch (const std::runtime_error& error)
    {
      throw std::runtime_error("line " + std::to_string(lineNumber) + ": " + error.what());
    }
  }
  std::vector<ColorNode> nodes = gmt ? segments.Nodes() : nodesOf(table);
  if (nodes.empty())
  {
    throw std::runtime_error("it has no colours");
  }
  return nodes;
}

}

// SPDX-License-Identifier: BSD-3-Clause
#include "ObjText.h"

#include "ShortText.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace relief::io
{

namespace
{
constexpr const char* Blanks = " \t\r";

std::string InLine(std::uint64_t number, const std::string& reason)
{
  return "line " + std::to_string(number) + ": " + reason;
}

// A line as a message shows it, without what was added to it.
std::string Quoted(const std::string& line)
{
  return "'" + Shortened(line.substr(0, line.find_last_not_of(" \t\r") + 1)) + "'";
}

// One number of a corner of a face, from 1, or from the end if below 0.
bool IsThere(long long index, std::uint64_t count)
{
  return index > 0 ? static_cast<std::uint64_t>(index) <= count
                   : index < 0 && static_cast<std::uint64_t>(-index) <= count;
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
}

//------------------------------------------------------------------------------
std::string ObjText::Read()
{
  Line line;
  while (this->NextWhole(line))
  {
    const std::string wrong = this->ReadLine(line);
    if (!wrong.empty())
    {
      return wrong;
    }
  }
  return this->Counts[Points] == 0 ? "it is no OBJ file: it has no line of a point, 'v x y z'" : "";
}

//------------------------------------------------------------------------------
// The next line without blanks in front. Returns whether there is one.
bool ObjText::NextWhole(Line& line)
{
  std::string& text = line.Text;
  if (!this->NextLine(text))
  {
    return false;
  }
  line.Number = ++this->Lines;
  // A line goes on behind a backslash.
  std::string next;
  for (std::size_t last = text.find_last_not_of(Blanks);
       last != std::string::npos && text[last] == '\\' && this->NextLine(next);
       last = text.find_last_not_of(Blanks))
  {
    text.replace(last, std::string::npos, " " + next);
    ++this->Lines;
  }
  const std::size_t begin = text.find_first_not_of(" \t");
  text.erase(0, begin == std::string::npos ? text.size() : begin);
  text.resize(text.size() + 3, ' ');
  return true;
}

//------------------------------------------------------------------------------
std::string ObjText::ReadLine(const Line& line)
{
  const std::string& text = line.Text;
  // Some readers pass over the mark with the word behind it, others complain.
  if (line.Number == 1 && text.compare(0, 3, "\xEF\xBB\xBF") == 0)
  {
    return InLine(1,
      "a byte order mark of UTF-8 is in front of " + Quoted(text.substr(3)) +
        "; save the file without");
  }
  const char second = text[1];
  const bool blank = second == ' ' || second == '\t';
  const bool third = text[2] == ' ' || text[2] == '\t';
  if (text[0] == 'v' && blank)
  {
    return this->ReadNumbers(line, Points);
  }
  if (text[0] == 'v' && (second == 't' || second == 'n') && third)
  {
    return this->ReadNumbers(line, second == 't' ? TexturePoints : Normals);
  }
  return text[0] == 'f' && blank ? this->ReadFace(line) : std::string();
}

//------------------------------------------------------------------------------
// The numbers of a point, a texture point or a normal; what else there is behind them, such as
// colors, is not read.
std::string ObjText::ReadNumbers(const Line& line, Kind kind)
{
  static const char* const expected[NumberOfKinds] = { "a point is 'v x y z', with 3 numbers",
    "a texture point is 'vt u v', with 2 numbers", "a normal is 'vn x y z', with 3 numbers" };
  constexpr std::ptrdiff_t safe = 38; // so many digits fit without an exponent
  const char* at = line.Text.c_str() + (kind == Points ? 1 : 2);
  for (int count = 0; count < (kind == TexturePoints ? 2 : 3); ++count)
  {
    at += std::strspn(at, Blanks);
    const char* end = at + std::strcspn(at, Blanks);
    bool exponent = false;
    if (!IsDecimal(at, end, exponent) ||
      !this->TakeNumber(kind, at, end, !exponent && end - at <= safe))
    {
      const bool comma = std::find(at, end, ',') != end;
      return InLine(line.Number,
        std::string(expected[kind]) + (comma ? " and decimal points, not " : ", not ") +
          Quoted(line.Text));
    }
    at = end;
  }
  ++this->Counts[kind];
  return {};
}

//------------------------------------------------------------------------------
// Corners are numbers of a point, of a point and a texture point, or of a normal as well: 1, 1/2,
// 1//3 or 1/2/3, and all of a face are written in one of these ways. VTK's reader takes no comment
// behind them.
std::string ObjText::ReadFace(const Line& line)
{
  const char* at = line.Text.c_str() + 1;
  this->Corners.clear();
  int firstWay = 0;
  for (at += std::strspn(at, Blanks); *at != '\0'; at += std::strspn(at, Blanks))
  {
    if (*at == '#')
    {
      return InLine(line.Number,
        "a comment behind a face is not read; give it a line of its own: " + Quoted(line.Text));
    }
    int way = 0; // a bit for each kind of number
    const std::string wrong = this->ReadCorner(line, at, way);
    if (!wrong.empty())
    {
      return wrong;
    }
    firstWay = this->Corners.size() == 1 ? way : firstWay;
    if (way != firstWay)
    {
      return InLine(
        line.Number, "the corners of a face are written in different ways: " + Quoted(line.Text));
    }
  }
  if (this->Corners.size() < 3)
  {
    return InLine(line.Number,
      "a face has " + std::to_string(this->Corners.size()) +
        " corners, and needs 3 at least: " + Quoted(line.Text));
  }
  this->TakeFace(this->Corners);
  return {};
}

//------------------------------------------------------------------------------
std::string ObjText::ReadCorner(const Line& line, const char*& at, int& way)
{
  static const char* const kinds[NumberOfKinds] = { " points", " texture points", " normals" };
  bool more = true;
  for (int kind = 0; more && kind < NumberOfKinds; ++kind)
  {
    // strtoll passes over blanks, behind which the next corner begins.
    char* end = const_cast<char*>(at);
    const long long index = std::strchr(Blanks, *at) ? 0 : std::strtoll(at, &end, 10);
    const bool skipped = end == at && kind == TexturePoints && *at == '/';
    const std::uint64_t count = this->Counts[kind];
    if (end != at && !IsThere(index, count))
    {
      return InLine(line.Number,
        "a face names number " + std::to_string(index) + " of " + std::to_string(count) +
          kinds[kind]);
    }
    more = *end == '/';
    const bool ended = *end == '\0' || std::strchr(Blanks, *end);
    if ((end == at && !skipped) || !(more || ended) || (more && kind == Normals))
    {
      return InLine(line.Number, "a face is no list of numbers: " + Quoted(line.Text));
    }
    if (kind == Points)
    {
      const auto number = static_cast<std::uint64_t>(index);
      this->Corners.push_back(index > 0 ? number - 1 : count + number); // modulo 2^64
    }
    way |= skipped ? 0 : 1 << kind;
    at = more ? end + 1 : end;
  }
  return {};
}

}

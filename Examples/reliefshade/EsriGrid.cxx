// SPDX-License-Identifier: BSD-3-Clause
#include "EsriGrid.h"

#include "RasterReader.h"
#include "Watch.h"

#include "vtkType.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

namespace
{

using namespace reliefshade;

/// The words of a text, with the line that each stands in for messages.
class Words
{
public:
  explicit Words(const std::string& text)
    : Next(text.c_str())
  {
  }

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
    // The program never sets a locale, so this is the C locale's reading: a point, no comma.
    char* end = nullptr;
    const double value = std::strtod(this->Next, &end);
    if (end == this->Next || (*end && !std::isspace(static_cast<unsigned char>(*end))))
    {
      throw std::runtime_error("line " + std::to_string(this->Line) + ": " +
        (*this->Next ? "'" + this->Peek() + "' is no number" : "the file ends early"));
    }
    this->Next = end;
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
std::string readText(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

//------------------------------------------------------------------------------
std::string lower(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

//------------------------------------------------------------------------------
bool isKey(const std::string& word)
{
  const char* const known[] = { "ncols", "nrows", "xllcorner", "xllcenter", "yllcorner",
    "yllcenter", "cellsize", "dx", "dy", "nodata_value" };
  return std::find(std::begin(known), std::end(known), word) != std::end(known);
}

//------------------------------------------------------------------------------
/// The header, its keys in lower case: Esri's format has a key and a number in each line.
std::map<std::string, double> takeHeader(Words& words)
{
  std::map<std::string, double> header;
  while (isKey(lower(words.Peek())))
  {
    const std::string key = lower(words.Take());
    if (!header.emplace(key, words.TakeNumber()).second)
    {
      throw std::runtime_error(
        "line " + std::to_string(words.GetLine()) + ": " + key + " is given twice");
    }
  }
  return header;
}

//------------------------------------------------------------------------------
double get(const std::map<std::string, double>& header, const char* key, const char* other = "")
{
  const auto found = header.count(key) ? header.find(key) : header.find(other);
  if (found == header.end() || !std::isfinite(found->second))
  {
    throw std::runtime_error(std::string("its header lacks a good ") + key);
  }
  return found->second;
}

//------------------------------------------------------------------------------
int getCount(const std::map<std::string, double>& header, const char* key)
{
  const double count = get(header, key);
  if (count < 1.0 || count > VTK_INT_MAX || count != std::floor(count))
  {
    throw std::runtime_error(std::string("its header lacks a good ") + key);
  }
  return static_cast<int>(count);
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
bool isEsriGrid(const std::string& file)
{
  std::string begin(64, '\0');
  std::ifstream(file, std::ios::binary).read(&begin[0], 64);
  return isKey(lower(Words(begin).Take()));
}

//------------------------------------------------------------------------------
EsriGrid readEsriGrid(const std::string& file, const MemoryPlan& plan)
{
  const std::string text = readText(file);
  Words words(text);
  const std::map<std::string, double> header = takeHeader(words);
  const int columns = getCount(header, "ncols");
  const int rows = getCount(header, "nrows");
  const double dx = get(header, "cellsize", "dx");
  const double dy = get(header, "cellsize", "dy");
  if (!(dx > 0.0) || !(dy > 0.0))
  {
    throw std::runtime_error("its cell size is not above 0");
  }
  // Every height takes two characters at least: a damaged header asks for no memory in vain.
  if (text.size() / 2 + 1 < static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
  {
    throw std::runtime_error("the file ends early: " + std::to_string(columns) + " x " +
      std::to_string(rows) + " heights are announced");
  }

  plan.Claim(columns, rows, sizeof(float), static_cast<double>(text.size()));

  EsriGrid grid;
  grid.Heights = vtkSmartPointer<vtkImageData>::New();
  grid.Heights->SetDimensions(columns, rows, 1);
  grid.Heights->AllocateScalars(VTK_FLOAT, 1);
  auto* heights = static_cast<float*>(grid.Heights->GetScalarPointer());
  for (int row = rows - 1; row >= 0; --row)
  {
    stopIfInterrupted();
    float* values = heights + static_cast<std::size_t>(row) * columns;
    for (int column = 0; column < columns; ++column)
    {
      values[column] = static_cast<float>(words.TakeNumber());
    }
  }
  if (!words.Peek().empty())
  {
    throw std::runtime_error("line " + std::to_string(words.GetLine()) + ": more than " +
      std::to_string(columns) + " x " + std::to_string(rows) + " heights");
  }
  if (header.count("nodata_value"))
  {
    grid.NoData = header.at("nodata_value");
  }
  const double left =
    header.count("xllcenter") ? get(header, "xllcenter") - 0.5 * dx : get(header, "xllcorner");
  const double bottom =
    header.count("yllcenter") ? get(header, "yllcenter") - 0.5 * dy : get(header, "yllcorner");
  grid.Transform = { left, dx, 0.0, bottom + rows * dy, 0.0, -dy };
  return grid;
}

//------------------------------------------------------------------------------
bool hasGeographicProjection(const std::string& file)
{
  const std::string text = readText(std::filesystem::path(file).replace_extension(".prj").string());
  return text.compare(0, 7, "GEOGCS[") == 0 || text.compare(0, 8, "GEOGCRS[") == 0;
}

}

// SPDX-License-Identifier: BSD-3-Clause
#include "ColourTable.h"

#include "Failure.h"

#include "vtkDataArray.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

namespace
{

using namespace reliefshade;

struct Entry
{
  double Height;
  std::array<double, 4> Colour; ///< red, green, blue, alpha from 0 to 1
};

//------------------------------------------------------------------------------
std::vector<std::string> splitLine(const std::string& line)
{
  std::vector<std::string> words(1);
  for (const char c : line.substr(0, line.find('#')))
  {
    if (std::isspace(static_cast<unsigned char>(c)) || c == ',' || c == ':')
    {
      words.emplace_back();
    }
    else
    {
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
}

//------------------------------------------------------------------------------
double number(const std::string& word)
{
  // The program never sets a locale, so this is the C locale's reading: a point, no comma.
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end || !std::isfinite(value))
  {
    throw std::runtime_error("'" + word + "' is no number");
  }
  return value;
}

//------------------------------------------------------------------------------
/// The least and the greatest height of samples that have data.
std::array<double, 2> heightRange(const Raster& raster)
{
  vtkDataArray* heights = raster.Heights->GetPointData()->GetScalars();
  vtkDataArray* mask = raster.Mask ? raster.Mask->GetPointData()->GetScalars() : nullptr;
  std::array<double, 2> range{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  for (vtkIdType i = 0; i < heights->GetNumberOfTuples(); ++i)
  {
    const double height = heights->GetComponent(i, 0);
    const bool marked = raster.NoData && height == *raster.NoData;
    if (std::isfinite(height) && !marked && !(mask && mask->GetComponent(i, 0) == 0.0))
    {
      range = { std::min(range[0], height), std::max(range[1], height) };
    }
  }
  return range[0] <= range[1] ? range : std::array<double, 2>{ 0.0, 0.0 };
}

//------------------------------------------------------------------------------
double heightOf(std::string word, const Raster& raster)
{
  if (word.back() != '%')
  {
    return number(word);
  }
  word.pop_back();
  const double share = number(word) / 100.0;
  const std::array<double, 2> range = heightRange(raster);
  return range[0] + share * (range[1] - range[0]);
}

//------------------------------------------------------------------------------
std::array<double, 4> colourOf(const std::vector<std::string>& words)
{
  // The names that GRASS has given to its r.colors, and gdaldem has from there.
  static const std::map<std::string, std::array<double, 4>> names{ { "white", { 255, 255, 255 } },
    { "black", { 0, 0, 0 } }, { "red", { 255, 0, 0 } }, { "green", { 0, 255, 0 } },
    { "blue", { 0, 0, 255 } }, { "yellow", { 255, 255, 0 } }, { "magenta", { 255, 0, 255 } },
    { "cyan", { 0, 255, 255 } }, { "aqua", { 0, 191, 191 } }, { "grey", { 191, 191, 191 } },
    { "gray", { 191, 191, 191 } }, { "orange", { 255, 127, 0 } }, { "brown", { 191, 127, 63 } },
    { "purple", { 127, 0, 255 } }, { "violet", { 127, 0, 255 } }, { "indigo", { 0, 127, 255 } } };
  std::array<double, 4> colour{ 0.0, 0.0, 0.0, 255.0 };
  std::size_t alpha = 4;
  const auto named = words.size() > 1 ? names.find(words[1]) : names.end();
  if (named != names.end())
  {
    std::copy_n(named->second.begin(), 3, colour.begin());
    alpha = 2;
  }
  else if (words.size() < 4)
  {
    throw std::runtime_error("expected are a height and red, green, blue or a colour's name");
  }
  if (words.size() > alpha + 1)
  {
    throw std::runtime_error("'" + words[alpha + 1] + "' is one word too many");
  }
  for (std::size_t c = alpha == 4 ? 0 : 3; c < 4 && c + alpha - 3 < words.size(); ++c)
  {
    colour[c] = number(words[c + alpha - 3]);
    if (!(colour[c] >= 0.0 && colour[c] <= 255.0))
    {
      throw std::runtime_error("'" + words[c + alpha - 3] + "' is not from 0 to 255");
    }
  }
  for (double& component : colour)
  {
    component /= 255.0;
  }
  return colour;
}

//------------------------------------------------------------------------------
std::vector<Entry> readEntries(const std::string& file, const Raster& raster)
{
  std::ifstream stream(file);
  if (!stream)
  {
    throw Failure(file, "cannot be opened");
  }
  std::vector<Entry> entries;
  int lineNumber = 0;
  for (std::string line; std::getline(stream, line);)
  {
    ++lineNumber;
    const std::vector<std::string> words = splitLine(line);
    try
    {
      if (words.empty())
      {
        continue;
      }
      const std::array<double, 4> colour = colourOf(words);
      if (words[0] != "nv") // samples without data are transparent in any case
      {
        entries.push_back({ heightOf(words[0], raster), colour });
      }
    }
    catch (const std::runtime_error& error)
    {
      throw Failure(file, "line " + std::to_string(lineNumber) + ": " + error.what());
    }
  }
  if (entries.empty())
  {
    throw Failure(file, "it has no colours");
  }
  std::stable_sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b) { return a.Height < b.Height; });
  return entries;
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkScalarsToColors> readColourTable(const std::string& file, const Raster& raster)
{
  std::vector<Entry> entries = readEntries(file, raster);
  auto table = vtkSmartPointer<vtkDiscretizableColorTransferFunction>::New();
  vtkNew<vtkPiecewiseFunction> opacity;
  bool transparent = false;
  double last = -std::numeric_limits<double>::infinity();
  for (Entry& entry : entries)
  {
    // A transfer function has one colour for each place.
    last = entry.Height <= last ? std::nextafter(last, std::numeric_limits<double>::max())
                                : entry.Height;
    table->AddRGBPoint(last, entry.Colour[0], entry.Colour[1], entry.Colour[2]);
    opacity->AddPoint(last, entry.Colour[3]);
    transparent = transparent || entry.Colour[3] < 1.0;
  }
  table->DiscretizeOff();
  table->SetScalarOpacityFunction(opacity);
  table->SetEnableOpacityMapping(transparent);
  table->Build();
  return table;
}

}

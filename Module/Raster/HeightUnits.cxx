// SPDX-License-Identifier: BSD-3-Clause
#include "HeightUnits.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <locale>
#include <map>
#include <sstream>

namespace relief::raster
{
namespace
{
constexpr double SurveyFoot = 1200.0 / 3937.0;

/// In small letters, without what parts the words, and without an s at their end.
const std::map<std::string, double>& Units()
{
  static const std::map<std::string, double> units = { // No unit at all.
    { "", 1.0 }, { "1", 1.0 }, { "none", 1.0 }, { "unknown", 1.0 }, { "unspecified", 1.0 },
    { "unitle", 1.0 }, { "dimensionle", 1.0 }, { "n/a", 1.0 }, { "na", 1.0 },
    // Metres. Geopotential ones are as long to a few thousandths.
    { "m", 1.0 }, { "meter", 1.0 }, { "metre", 1.0 }, { "mtr", 1.0 }, { "masl", 1.0 },
    { "gpm", 1.0 }, { "geopotentialmeter", 1.0 }, { "geopotentialmetre", 1.0 },
    { "germanlegalmetre", 1.0000135965 }, { "legalmetre", 1.0000135965 },
    // Their multiples and parts.
    { "km", 1000.0 }, { "kilometer", 1000.0 }, { "kilometre", 1000.0 }, { "hm", 100.0 },
    { "hectometer", 100.0 }, { "hectometre", 100.0 }, { "dam", 10.0 }, { "decameter", 10.0 },
    { "decametre", 10.0 }, { "dekameter", 10.0 }, { "dm", 0.1 }, { "decimeter", 0.1 },
    { "decimetre", 0.1 }, { "cm", 0.01 }, { "centimeter", 0.01 }, { "centimetre", 0.01 },
    { "mm", 0.001 }, { "millimeter", 0.001 }, { "millimetre", 0.001 }, { "um", 1e-6 },
    { "\u00b5m", 1e-6 }, { "\u03bcm", 1e-6 }, { "micron", 1e-6 }, { "micrometer", 1e-6 },
    { "micrometre", 1e-6 }, { "nm", 1e-9 }, { "nanometer", 1e-9 }, { "nanometre", 1e-9 },
    // International feet, and their multiples and parts.
    { "ft", 0.3048 }, { "foot", 0.3048 }, { "feet", 0.3048 }, { "'", 0.3048 }, { "intft", 0.3048 },
    { "ftint", 0.3048 }, { "footint", 0.3048 }, { "foot(international)", 0.3048 },
    { "intfoot", 0.3048 }, { "internationalfoot", 0.3048 }, { "internationalfeet", 0.3048 },
    { "ift", 0.3048 }, { "in", 0.0254 }, { "inch", 0.0254 }, { "inche", 0.0254 }, { "\"", 0.0254 },
    { "internationalinch", 0.0254 }, { "internationalinche", 0.0254 }, { "yd", 0.9144 },
    { "yard", 0.9144 }, { "internationalyard", 0.9144 }, { "fathom", 1.8288 }, { "fath", 1.8288 },
    { "fm", 1.8288 }, { "ftm", 1.8288 }, { "internationalfathom", 1.8288 }, { "mi", 1609.344 },
    { "mile", 1609.344 }, { "internationalmile", 1609.344 }, { "statutemile", 1609.344 },
    { "nmi", 1852.0 }, { "nauticalmile", 1852.0 }, { "internationalnauticalmile", 1852.0 },
    // Those of the survey of the United States.
    { "usft", SurveyFoot }, { "ftu", SurveyFoot }, { "usfoot", SurveyFoot },
    { "usfeet", SurveyFoot }, { "footu", SurveyFoot }, { "feetu", SurveyFoot },
    { "ussurveyfoot", SurveyFoot }, { "ussurveyfeet", SurveyFoot }, { "ussurveyft", SurveyFoot },
    { "surveyfoot", SurveyFoot }, { "surveyfeet", SurveyFoot }, { "surveyft", SurveyFoot },
    { "ftussurvey", SurveyFoot }, { "footussurvey", SurveyFoot }, { "sft", SurveyFoot },
    { "ussurveyinch", SurveyFoot / 12.0 }, { "ussurveyyard", 3.0 * SurveyFoot },
    { "usyd", 3.0 * SurveyFoot }, { "ussurveyfathom", 6.0 * SurveyFoot },
    { "ussurveymile", 5280.0 * SurveyFoot }, { "usmi", 5280.0 * SurveyFoot },
    { "ussurveystatutemile", 5280.0 * SurveyFoot },
    // Other feet of EPSG's.
    { "clarke'sfoot", 0.3047972654 }, { "indianfoot", 12.0 / 39.370142 },
    { "searsfoot", 12.0 / 39.370147 }, { "britishfoot(sears1922)", 12.0 / 39.370147 },
    { "goldcoastfoot", 0.3047997101815088 }, { "britishfoot(1936)", 0.3048007491 }
  };
  return units;
}

//------------------------------------------------------------------------------
/// Small letters; blanks, underscores, hyphens and points go, brackets around all of it as well.
std::string Plain(std::string text)
{
  const auto drop = [](unsigned char c)
  { return std::isspace(c) || c == '_' || c == '-' || c == '.'; };
  text.erase(std::remove_if(text.begin(), text.end(), drop), text.end());
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* pair : { "[]", "()", "{}" })
  {
    if (text.size() >= 2 && text.front() == pair[0] && text.back() == pair[1])
    {
      text = text.substr(1, text.size() - 2);
    }
  }
  return text;
}
}

//------------------------------------------------------------------------------
std::optional<double> MetersPerHeightUnit(const std::string& name)
{
  const std::map<std::string, double>& units = Units();
  std::string text = Plain(name);
  for (int plural = 0; plural < 2; ++plural)
  {
    const auto found = units.find(text);
    if (found != units.end())
    {
      return found->second;
    }
    while (text.size() > 2 && text.back() == 's')
    {
      text.pop_back();
    }
  }
  // UDUNITS: so many of another unit.
  std::istringstream numbered(name);
  numbered.imbue(std::locale::classic());
  double factor = 0.0;
  std::string rest;
  if (numbered >> factor && std::getline(numbered, rest) && factor > 0.0 && std::isfinite(factor) &&
    rest.find_first_not_of(" *\t") != std::string::npos && !std::isdigit(rest.back()))
  {
    const std::optional<double> unit =
      MetersPerHeightUnit(rest.substr(rest.find_first_not_of(" *\t")));
    return unit ? std::optional<double>(factor * *unit) : std::nullopt;
  }
  return std::nullopt;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "SurveyFile.h"

#include "Gdal.h"
#include "HeightHash.h"
#include "HeightInputs.h"
#include "RasterFile.h"
#include "SameFile.h"
#include "ShortestText.h"
#include "StagedFile.h"
#include "TiledHeights.h"

#include <cpl_conv.h>
#include <cpl_string.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <exception>
#include <filesystem>
#include <system_error>

namespace fs = std::filesystem;

namespace relief::raster
{
namespace
{
constexpr int Planes = 5;
using Plane = std::vector<float>;

//------------------------------------------------------------------------------
template <class Number>
bool ReadNumber(GDALDataset* dataset, const char* name, Number& number)
{
  const char* text = dataset->GetMetadataItem(name);
  if (!text)
  {
    return false;
  }
  const char* end = text + std::strlen(text);
  const std::from_chars_result read = std::from_chars(text, end, number);
  return read.ec == std::errc() && read.ptr == end;
}

//------------------------------------------------------------------------------
std::array<Plane, Planes> PlanesOf(const RasterBounds& bounds)
{
  std::array<Plane, Planes> planes;
  for (const RasterBounds::Range& range : bounds.GetRanges())
  {
    planes[0].push_back(range.lo);
    planes[1].push_back(range.hi);
  }
  for (const MinMaxPyramid::Bounds& bound : bounds.GetBounds())
  {
    planes[2].push_back(bound.lo);
    planes[3].push_back(bound.hi);
    planes[4].push_back(bound.twist);
  }
  return planes;
}

//------------------------------------------------------------------------------
void FillBounds(const std::array<Plane, Planes>& planes, RasterBounds& bounds)
{
  for (std::size_t k = 0; k < planes[0].size(); ++k)
  {
    bounds.GetRanges()[k] = { planes[0][k], planes[1][k] };
    bounds.GetBounds()[k] = { planes[2][k], planes[3][k], planes[4][k] };
  }
}

//------------------------------------------------------------------------------
bool Transfer(GDALDataset* dataset, GDALRWFlag way, std::array<Plane, Planes>& planes)
{
  bool done = true;
  const int columns = dataset->GetRasterXSize();
  const int rows = dataset->GetRasterYSize();
  for (int k = 0; k < Planes && done; ++k)
  {
    planes[k].resize(static_cast<std::size_t>(columns) * rows);
    done = dataset->GetRasterBand(k + 1)->RasterIO(way, 0, 0, columns, rows, planes[k].data(),
             columns, rows, GDT_Float32, 0, 0, nullptr) == CE_None;
  }
  return done;
}

//------------------------------------------------------------------------------
bool IsSurvey(const std::string& name)
{
  const DatasetPointer file(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER));
  return file && file->GetMetadataItem("RELIEF_SOURCE");
}

//------------------------------------------------------------------------------
/// A hash of all that has been kept, which tells whether a file is whole.
std::string HashOf(const std::array<Plane, Planes>& planes, const hosts::HeightSurvey& survey,
  const std::string& warning)
{
  std::uint64_t hash = MixHash(survey.hash, survey.bounds.GetNumberWithData());
  for (const double number : { survey.least, survey.greatest, survey.scale, survey.datum })
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    hash = MixHash(hash, bits);
  }
  for (const Plane& plane : planes)
  {
    for (const float number : plane)
    {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &number, sizeof bits);
      hash = MixHash(hash, bits);
    }
  }
  for (const char c : warning)
  {
    hash = MixHash(hash, static_cast<unsigned char>(c));
  }
  return HashText(hash);
}

/// Stands for an empty text, which GDAL does not keep.
constexpr const char* Nothing = "none";
}

//------------------------------------------------------------------------------
std::string SurveyName(const std::string& raster)
{
  return raster + ".bounds.tif";
}

//------------------------------------------------------------------------------
std::string StateOfFiles(const std::vector<std::string>& files)
{
  std::string state;
  for (const std::string& file : files)
  {
    std::error_code wrong;
    const std::string behind = io::FileBehind(file); // of one in an archive, that
    const std::uintmax_t size = fs::file_size(behind, wrong);
    if (wrong)
    {
      return std::string();
    }
    const auto time = fs::last_write_time(behind, wrong).time_since_epoch().count();
    state += (state.empty() ? "" : " ") + fs::path(file).filename().string() + " " +
      std::to_string(size) + " bytes of " + std::to_string(time);
  }
  return state;
}

//------------------------------------------------------------------------------
std::string StateOfInput(const std::string& file)
{
  const std::string own = StateOfFiles({ file });
  const std::string all = own.empty() ? own : StateOfFiles(FilesOf(file));
  return all.empty() ? own : all;
}

//------------------------------------------------------------------------------
std::string HashOfProbes(hosts::HeightSupply& heights)
{
  constexpr int probes = 16;
  const int rows = heights.GetRows();
  std::uint64_t hash = 0;
  for (int k = 0; k < std::min(probes, rows); ++k)
  {
    const int j = static_cast<int>((2LL * k + 1) * rows / (2LL * std::min(probes, rows)));
    const hosts::HeightSupply::Part part = heights.Read({ 0, heights.GetColumns(), j, j + 1 });
    const double unit[2] = { 1.0, 1.0 };
    hosts::WithHeightSource(hosts::InputsOf(part, 1.0), unit,
      [&hash](const auto& row) { hash = MixHash(hash, HashRow(row, 0)); });
  }
  return HashText(hash);
}

//------------------------------------------------------------------------------
bool LoadSurvey(const std::string& raster, const std::string& state,
  const hosts::HeightSupply& heights, double scale, hosts::HeightSurvey& survey,
  std::string& warning)
{
  const GdalErrors errors;
  const std::string name = SurveyName(raster);
  std::error_code none;
  if (!fs::is_regular_file(name, none))
  {
    return false;
  }
  const DatasetPointer file(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER));
  const char* kept = file ? file->GetMetadataItem("RELIEF_SOURCE") : nullptr;
  const char* told = file ? file->GetMetadataItem("RELIEF_UNDECLARED") : nullptr;
  const char* sum = file ? file->GetMetadataItem("RELIEF_SUM") : nullptr;
  hosts::HeightSurvey found;
  found.bounds.SetSize(heights.GetColumns(), heights.GetRows());
  std::uint64_t samples = 0;
  const bool fits = kept && told && sum && state == kept && file->GetRasterCount() == Planes &&
    file->GetRasterXSize() == found.bounds.GetRegionColumns() &&
    file->GetRasterYSize() == found.bounds.GetRegionRows() &&
    ReadNumber(file.get(), "RELIEF_SCALE", found.scale) &&
    ReadNumber(file.get(), "RELIEF_DATUM", found.datum) &&
    ReadNumber(file.get(), "RELIEF_LEAST", found.least) &&
    ReadNumber(file.get(), "RELIEF_GREATEST", found.greatest) &&
    ReadNumber(file.get(), "RELIEF_SAMPLES", samples) &&
    ReadNumber(file.get(), "RELIEF_HASH", found.hash) && found.scale == scale;
  std::array<Plane, Planes> planes;
  if (!fits || !Transfer(file.get(), GF_Read, planes))
  {
    return false;
  }
  FillBounds(planes, found.bounds);
  found.bounds.SetNumberWithData(samples);
  if (HashOf(planes, found, told) != sum)
  {
    return false;
  }
  warning = std::strcmp(told, Nothing) == 0 ? "" : told;
  survey = std::move(found);
  return true;
}

//------------------------------------------------------------------------------
void SaveSurvey(const std::string& raster, const std::string& state,
  const hosts::HeightSurvey& survey, const std::string& warning)
{
  const GdalErrors errors;
  const CPLConfigOptionSetter noSideFiles("GDAL_PAM_ENABLED", "NO", false);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  try
  {
    const std::string name = SurveyName(raster);
    std::error_code none;
    if (fs::exists(name, none) && !fs::is_empty(name, none) && !IsSurvey(name))
    {
      return; // somebody else's file
    }
    io::StagedFile staged(name);
    io::CheckPlace(staged.Name());
    const RasterBounds& bounds = survey.bounds;
    CPLStringList options;
    options.SetNameValue("COMPRESS", "DEFLATE");
    options.SetNameValue("INTERLEAVE", "BAND");
    DatasetPointer file(driver ? driver->Create(staged.Name().c_str(), bounds.GetRegionColumns(),
                                   bounds.GetRegionRows(), Planes, GDT_Float32, options.List())
                               : nullptr);
    std::array<Plane, Planes> planes = PlanesOf(bounds);
    if (!file || !Transfer(file.get(), GF_Write, planes))
    {
      return;
    }
    const std::string told = warning.empty() ? Nothing : warning;
    const std::array<std::array<std::string, 2>, 9> items{ { { "RELIEF_SOURCE", state },
      { "RELIEF_SCALE", TextOf(survey.scale) }, { "RELIEF_DATUM", TextOf(survey.datum) },
      { "RELIEF_LEAST", TextOf(survey.least) }, { "RELIEF_GREATEST", TextOf(survey.greatest) },
      { "RELIEF_SAMPLES", std::to_string(bounds.GetNumberWithData()) },
      { "RELIEF_HASH", std::to_string(survey.hash) }, { "RELIEF_UNDECLARED", told },
      { "RELIEF_SUM", HashOf(planes, survey, told) } } };
    for (const auto& [name, value] : items)
    {
      file->SetMetadataItem(name.c_str(), value.c_str());
    }
    file->FlushCache();
    file.reset();
    if (!GdalErrors::Any())
    {
      staged.Keep();
    }
  }
  catch (const std::exception&)
  {
    return; // the next run makes its own
  }
}
}

// SPDX-License-Identifier: BSD-3-Clause
#ifndef EsriGrid_h
#define EsriGrid_h

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <optional>
#include <string>

namespace reliefshade
{

struct MemoryPlan;

/// An ESRI ASCII grid: a header of keys and numbers, then heights, the northern row first.
struct EsriGrid
{
  /// As float, the southern row first.
  vtkSmartPointer<vtkImageData> Heights;
  std::optional<double> NoData;
  /// As GeoReference has it.
  std::array<double, 6> Transform;
};

/// Whether the file begins as such a grid does.
bool isEsriGrid(const std::string& file);

/// Reads it and refuses what GDAL passes over: words that are no numbers (GDAL takes them for 0)
/// and heights too many. Throws a std::runtime_error that names the line.
EsriGrid readEsriGrid(const std::string& file, const MemoryPlan& plan);

/// Whether a file of the same name that ends in .prj says that the coordinates are degrees.
bool hasGeographicProjection(const std::string& file);

}

#endif

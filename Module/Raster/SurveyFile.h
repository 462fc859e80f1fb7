// SPDX-License-Identifier: BSD-3-Clause
#ifndef SurveyFile_h
#define SurveyFile_h

/// @file
/// What a pass over a raster has found, kept beside it for the next run. Not installed; there where
/// GDAL is.

#include "HeightSupply.h"
#include "vtkIOReliefRasterModule.h" // For export macro

#include <string>
#include <vector>

namespace relief::raster
{
/// The file beside a raster's: a GeoTIFF that has the bounds of 64 x 64 samples in a pixel each, as
/// float: the least and the greatest of its own samples, and what rays skip by.
std::string SurveyName(const std::string& raster);

/// Names, sizes and dates of files; empty if any of them is none. What is read from within an
/// archive has its size and date.
std::string StateOfFiles(const std::vector<std::string>& files);

/// The same of all that a raster or picture is read from, or of a file that is neither.
VTKIORELIEFRASTER_EXPORT std::string StateOfInput(const std::string& file);

/// A hash of some rows, spread over the raster: of heights that have been written over within the
/// same second. Throws what reading throws.
std::string HashOfProbes(hosts::HeightSupply& heights);

/// Reads what has been kept for a state of a raster and a scale. Returns whether there is any.
bool LoadSurvey(const std::string& raster, const std::string& state,
  const hosts::HeightSupply& heights, double scale, hosts::HeightSurvey& survey,
  std::string& warning);

/// Keeps a survey, in place of any other, and what the pass has to warn of, which may be nothing.
/// Does nothing where that cannot be written.
void SaveSurvey(const std::string& raster, const std::string& state,
  const hosts::HeightSurvey& survey, const std::string& warning);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef Charts_h
#define Charts_h

#include <string>
#include <vector>

namespace bench
{

/// A line with markers.
struct Series
{
  std::string name;
  unsigned char color[3] = { 0, 0, 0 };
  int marker = 0;   ///< vtkPlotPoints
  bool line = true; ///< else the markers alone, larger
  std::vector<double> x;
  std::vector<double> y;
};

struct Chart
{
  std::string title;
  std::string xTitle;
  std::string yTitle;
  std::vector<Series> series;
  bool powersOfTwo = false; ///< the numbers along x are sizes: label each point's
  bool legendAbove = false; ///< at the left; else below, at the right
};

/// Draws a chart with two logarithmic axes into a PNG, off-screen. Values that are not above 0 are
/// left out. Returns whether the file could be written.
bool DrawChart(const Chart& chart, const std::string& fileName);

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightDot_h
#define LightDot_h

/// @file
/// The dot of a light as coloured polygons in display coordinates. Private to the module.

#include "vtkActor2D.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <vector>

namespace relief::widget
{
using Point = std::array<double, 2>;

/// What is drawn later covers what was drawn before; lines and discs have a dark rim, to be seen on
/// every ground.
class LightDot
{
public:
  LightDot();

  void Clear();
  /// A line through the points, two pixels wide.
  void AddLine(const std::vector<Point>& points, const double outline[3]);
  /// A disc in a ring, with rays if it is a sun's.
  void AddDot(
    Point center, double radius, bool rays, const double outline[3], const double fill[3]);
  /// Call it when all is drawn.
  void Finish();

  /// Invisible while there is nothing to show.
  vtkActor2D* GetActor() { return this->Actor; }

private:
  using Color = std::array<unsigned char, 3>;
  void Disc(Point center, double radius, Color color);
  void Segment(Point from, Point to, double width, Color color);

  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Polys;
  vtkNew<vtkUnsignedCharArray> Colors;
  vtkNew<vtkPolyData> Shape;
  vtkNew<vtkActor2D> Actor;
};
}

#endif

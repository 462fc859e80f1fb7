// SPDX-License-Identifier: BSD-3-Clause
#include "LightDot.h"

#include "vtkCellData.h"
#include "vtkCoordinate.h"
#include "vtkMath.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkReliefAngles.h"

#include <algorithm>

namespace relief::widget
{
namespace
{
const std::array<unsigned char, 3> Dark = { 20, 20, 20 };

std::array<unsigned char, 3> Bytes(const double color[3])
{
  std::array<unsigned char, 3> bytes;
  // A light's colour may be anything; NaN shows as black.
  std::transform(color, color + 3, bytes.begin(),
    [](double c)
    { return static_cast<unsigned char>((c > 0.0 ? std::min(c, 1.0) : 0.0) * 255.0 + 0.5); });
  return bytes;
}
}

//------------------------------------------------------------------------------
LightDot::LightDot()
{
  this->Points->SetDataTypeToDouble();
  this->Colors->SetNumberOfComponents(3);
  this->Shape->SetPoints(this->Points);
  this->Shape->SetPolys(this->Polys);
  this->Shape->GetCellData()->SetScalars(this->Colors);
  vtkNew<vtkCoordinate> display;
  display->SetCoordinateSystemToDisplay();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(this->Shape);
  mapper->SetTransformCoordinate(display);
  this->Actor->SetMapper(mapper);
}

//------------------------------------------------------------------------------
void LightDot::Clear()
{
  this->Points->Reset();
  this->Polys->Reset();
  this->Colors->Reset();
}

//------------------------------------------------------------------------------
void LightDot::Finish()
{
  this->Points->Modified();
  this->Polys->Modified();
  this->Colors->Modified();
  this->Shape->Modified();
  this->Actor->SetVisibility(this->Shape->GetNumberOfCells() > 0);
}

//------------------------------------------------------------------------------
void LightDot::Disc(Point center, double radius, Color color)
{
  const int corners = 32;
  this->Polys->InsertNextCell(corners);
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 360.0 * i / corners;
    this->Polys->InsertCellPoint(
      this->Points->InsertNextPoint(center[0] + radius * vtkReliefCosDegrees(angle),
        center[1] + radius * vtkReliefSinDegrees(angle), 0.0));
  }
  this->Colors->InsertNextTypedTuple(color.data());
}

//------------------------------------------------------------------------------
void LightDot::Segment(Point from, Point to, double width, Color color)
{
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  if (length == 0.0)
  {
    return;
  }
  const double x = 0.5 * width * (from[1] - to[1]) / length;
  const double y = 0.5 * width * (to[0] - from[0]) / length;
  this->Polys->InsertNextCell(4);
  for (const Point& corner : { Point{ from[0] + x, from[1] + y }, { from[0] - x, from[1] - y },
         { to[0] - x, to[1] - y }, { to[0] + x, to[1] + y } })
  {
    this->Polys->InsertCellPoint(this->Points->InsertNextPoint(corner[0], corner[1], 0.0));
  }
  this->Colors->InsertNextTypedTuple(color.data());
}

//------------------------------------------------------------------------------
void LightDot::AddLine(const std::vector<Point>& points, const double outline[3])
{
  for (const bool rim : { true, false })
  {
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      this->Segment(points[i - 1], points[i], rim ? 4.0 : 2.0, rim ? Dark : Bytes(outline));
    }
  }
}

//------------------------------------------------------------------------------
void LightDot::AddDot(
  Point center, double radius, bool rays, const double outline[3], const double fill[3])
{
  for (const bool rim : { true, false })
  {
    for (int ray = 0; rays && ray < 8; ++ray)
    {
      const double x = vtkReliefCosDegrees(45.0 * ray);
      const double y = vtkReliefSinDegrees(45.0 * ray);
      const double inner = radius + 3.0;
      const double outer = radius * 1.6 + (rim ? 6.0 : 5.0);
      this->Segment({ center[0] + inner * x, center[1] + inner * y },
        { center[0] + outer * x, center[1] + outer * y }, rim ? 4.0 : 2.0,
        rim ? Dark : Bytes(outline));
    }
    this->Disc(center, radius + (rim ? 3.0 : 2.0), rim ? Dark : Bytes(outline));
  }
  this->Disc(center, radius, Bytes(fill));
}
}

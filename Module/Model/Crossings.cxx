// SPDX-License-Identifier: BSD-3-Clause
#include "Crossings.h"

#include "ReliefModel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace relief
{

Crossings::Crossings(double dx, double dy, double dz, double depth, double end, int outside)
{
  const double infinity = std::numeric_limits<double>::infinity();
  int x = dx < 0.0 ? -1 : 0;
  int y = dy < 0.0 ? -1 : 0;
  double s = 0.0;
  while (s < end)
  {
    const double exitX = dx != 0.0 ? (dx > 0.0 ? x + 1 : x) / dx : infinity;
    const double exitY = dy != 0.0 ? (dy > 0.0 ? y + 1 : y) / dy : infinity;
    const bool throughX = exitX <= exitY;
    const double next = std::max(throughX ? exitX : exitY, s);
    Cell cell;
    cell.x = x;
    cell.y = y;
    cell.firstX = cell.secondX = throughX && dx > 0.0 ? x + 1 : x;
    cell.firstY = cell.secondY = !throughX && dy > 0.0 ? y + 1 : y;
    ++(throughX ? cell.secondY : cell.secondX);
    const double place = throughX ? dy * next - y : dx * next - x;
    if (place > 0.5)
    {
      // From the nearer sample, as reliefBetween().
      std::swap(cell.firstX, cell.secondX);
      std::swap(cell.firstY, cell.secondY);
    }
    if (dx == 0.0 || dy == 0.0)
    {
      // Along a grid line the second does not count, and may have no data.
      cell.secondX = cell.firstX;
      cell.secondY = cell.firstY;
    }
    cell.weight = static_cast<float>(std::max(std::min(place, 1.0 - place), 0.0));
    cell.length = static_cast<float>(next - s);
    cell.distance = static_cast<float>(s);
    cell.axis = this->LastAxis;
    cell.touches = next - s <= f64::RELIEF_TOUCH * next;
    cell.rise = static_cast<float>(next * dz - depth);
    // A bow that the rounding of heights hides is none: whether its square vanishes, too, would
    // depend on the unit of length.
    const double bend = dx * (next - s) * dy * (next - s);
    cell.bend =
      std::abs(bend) < std::numeric_limits<float>::epsilon() ? 0.0f : static_cast<float>(bend);
    this->Add(cell, s, next, s * dz - depth, { dx == 0.0 ? 1 : 0, dy == 0.0 ? 1 : 0 });
    s = next;
    this->LastAxis = throughX ? 0 : 1;
    (throughX ? x : y) += (throughX ? dx : dy) > 0.0 ? 1 : -1;
  }
  // After the last cell every ray is outside or above everything: one more group says so.
  const int size = static_cast<int>(this->Cells.size());
  this->Groups.push_back({ size, size, outside, outside, 0, 0, static_cast<float>(s * dz - depth),
    0.0f, 0.0f, static_cast<float>(s) });
  this->Spans = ListSpans(this->Groups, SpanSize);
  this->LongSpans = ListSpans(this->Groups, LongSpanSize);
}

void Crossings::Add(
  const Cell& cell, double s, double next, double riseIn, const std::array<int, 2>& beside)
{
  const int at = static_cast<int>(this->Cells.size());
  const int x0 = cell.x - beside[0];
  const int y0 = cell.y - beside[1];
  auto fits = [&](const Group& group)
  {
    return std::max(group.x1, cell.x) - std::min(group.x0, x0) < BoxSize &&
      std::max(group.y1, cell.y) - std::min(group.y0, y0) < BoxSize;
  };
  if (this->Groups.empty() || !fits(this->Groups.back()))
  {
    this->Groups.push_back({ at, 0, x0, cell.x, y0, cell.y, static_cast<float>(riseIn), 0.0f, 0.0f,
      static_cast<float>(s) });
  }
  this->Cells.push_back(cell);
  Group& group = this->Groups.back();
  group.end = at + 1;
  group.x0 = std::min(group.x0, x0);
  group.x1 = std::max(group.x1, cell.x);
  group.y0 = std::min(group.y0, y0);
  group.y1 = std::max(group.y1, cell.y);
  group.riseOut = cell.rise;
  group.length = static_cast<float>(next - group.distance);
}

std::vector<Crossings::Group> Crossings::ListSpans(
  const std::vector<Group>& groups, std::size_t size)
{
  std::vector<Group> spans;
  for (std::size_t g = 0; g < groups.size(); g += size)
  {
    Group span = groups[g];
    for (std::size_t k = g; k < std::min(g + size, groups.size()); ++k)
    {
      const Group& group = groups[k];
      span.end = group.end;
      span.x0 = std::min(span.x0, group.x0);
      span.x1 = std::max(span.x1, group.x1);
      span.y0 = std::min(span.y0, group.y0);
      span.y1 = std::max(span.y1, group.y1);
    }
    spans.push_back(span);
  }
  return spans;
}

}

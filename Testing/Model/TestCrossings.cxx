// SPDX-License-Identifier: BSD-3-Clause
#include "Crossings.h"
#include "TestTerrain.h"

#include <gtest/gtest.h>

#include <cstdlib>

using relief::Crossings;

// The cells follow one another along the ray, and where it leaves them is between the two samples.
TEST(Crossings, FollowTheRay)
{
  Random random(Seed());
  for (int round = 0; round < 200; ++round)
  {
    const glm::dvec3 light =
      Toward(random.Chance(0.3) ? 45.0 * random.Integer(0, 7) : random.Uniform(0.0, 360.0),
        random.Uniform(0.0, 80.0));
    const double dx = std::abs(light.x) < 1e-12 ? 0.0 : light.x;
    const double dy = std::abs(light.y) < 1e-12 ? 0.0 : light.y;
    const double depth = random.Uniform(0.0, 2.0);
    const double end = random.Uniform(0.5, 60.0);
    SCOPED_TRACE(testing::Message() << "round " << round << ": " << dx << ' ' << dy);
    const Crossings crossings(dx, dy, light.z, depth, end, 1000);
    const std::vector<Crossings::Cell>& cells = crossings.GetCells();
    ASSERT_FALSE(cells.empty());
    double s = 0.0;
    for (std::size_t k = 0; k < cells.size(); ++k)
    {
      const Crossings::Cell& cell = cells[k];
      EXPECT_LT(s, end);
      s += cell.length;
      EXPECT_GE(cell.weight, 0.0f);
      EXPECT_LE(cell.weight, 0.5f);
      EXPECT_NEAR(cell.firstX + cell.weight * (cell.secondX - cell.firstX), dx * s, 1e-3);
      EXPECT_NEAR(cell.firstY + cell.weight * (cell.secondY - cell.firstY), dy * s, 1e-3);
      EXPECT_NEAR(cell.rise, light.z * s - depth, 1e-3);
      if (k > 0)
      {
        EXPECT_EQ(std::abs(cell.x - cells[k - 1].x) + std::abs(cell.y - cells[k - 1].y), 1);
      }
    }
    EXPECT_GE(s, end - 1e-3);
  }
}

// Groups and spans cover the cells in order, and the last group is outside.
TEST(Crossings, AreGrouped)
{
  const glm::dvec3 light = Toward(210.0, 20.0);
  const Crossings crossings(light.x, light.y, light.z, 1.0, 50.0, 1000);
  const std::vector<Crossings::Cell>& cells = crossings.GetCells();
  int next = 0;
  for (const Crossings::Group& group : crossings.GetGroups())
  {
    EXPECT_EQ(group.begin, next);
    next = group.end;
    const bool last = &group == &crossings.GetGroups().back();
    EXPECT_EQ(last, group.begin == group.end);
    EXPECT_EQ(last, group.x0 == 1000);
    for (int k = group.begin; k < group.end; ++k)
    {
      EXPECT_TRUE(cells[k].x >= group.x0 && cells[k].x <= group.x1);
      EXPECT_TRUE(cells[k].y >= group.y0 && cells[k].y <= group.y1);
    }
  }
  EXPECT_EQ(next, static_cast<int>(cells.size()));
  for (std::size_t g = 0; g < crossings.GetGroups().size(); ++g)
  {
    const Crossings::Group& span = crossings.GetSpans().at(g / Crossings::SpanSize);
    const Crossings::Group& group = crossings.GetGroups()[g];
    EXPECT_TRUE(span.begin <= group.begin && span.end >= group.end);
    EXPECT_TRUE(span.x0 <= group.x0 && span.x1 >= group.x1);
    EXPECT_TRUE(span.y0 <= group.y0 && span.y1 >= group.y1);
  }
  EXPECT_GT(crossings.GetMemorySize(), cells.size() * sizeof(Crossings::Cell));
}

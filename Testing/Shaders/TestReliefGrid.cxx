// SPDX-License-Identifier: BSD-3-Clause
//
// Which part of a field a view shows, and which of its samples are shaded.

#include "ReliefGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

// Looks straight down at the samples [x0, x0 + width) x [y0, y0 + height).
void Above(double x0, double y0, double width, double height, double toClip[16])
{
  const double rows[16] = { 2.0 / width, 0.0, 0.0, -2.0 * x0 / width - 1.0, //
    0.0, 2.0 / height, 0.0, -2.0 * y0 / height - 1.0,                       //
    0.0, 0.0, 1.0, 0.0,                                                     //
    0.0, 0.0, 0.0, 1.0 };
  std::copy_n(rows, 16, toClip);
}

const int Viewport[2] = { 400, 300 };
const double Area[4] = { 0.0, 1000.0, 0.0, 800.0 };

}

TEST(ReliefGrid, FindsWhatIsSeenFromAbove)
{
  double toClip[16];
  Above(100.0, 50.0, 400.0, 150.0, toClip);
  relief::VisiblePart part = relief::FindVisiblePart(toClip, Area, Viewport);
  ASSERT_TRUE(part.any);
  EXPECT_NEAR(part.lo[0], 100.0, 1e-9);
  EXPECT_NEAR(part.hi[0], 500.0, 1e-9);
  EXPECT_NEAR(part.lo[1], 50.0, 1e-9);
  EXPECT_NEAR(part.hi[1], 200.0, 1e-9);
  EXPECT_NEAR(part.stride[0], 1.0, 1e-9);
  EXPECT_NEAR(part.stride[1], 0.5, 1e-9);

  // Only what is there is seen.
  Above(-1000.0, -1000.0, 4000.0, 4000.0, toClip);
  part = relief::FindVisiblePart(toClip, Area, Viewport);
  EXPECT_NEAR(part.lo[0], 0.0, 1e-9);
  EXPECT_NEAR(part.hi[1], 800.0, 1e-9);
  EXPECT_NEAR(part.stride[0], 10.0, 1e-9);

  Above(2000.0, 0.0, 100.0, 100.0, toClip);
  EXPECT_FALSE(relief::FindVisiblePart(toClip, Area, Viewport).any);
}

TEST(ReliefGrid, FindsTheForegroundOfASlantedView)
{
  // An eye at y = -100, 50 above the plane, looking along +y: what is at y = 0 is nearest.
  const double toClip[16] = { 1.0, 0.0, 0.0, -500.0, //
    0.0, 0.0, 1.0, -50.0,                            //
    0.0, 1.0, 0.0, 90.0,                             //
    0.0, 1.0, 0.0, 100.0 };
  const relief::VisiblePart part = relief::FindVisiblePart(toClip, Area, Viewport);
  ASSERT_TRUE(part.any);
  EXPECT_NEAR(part.lo[1], 0.0, 1e-9);
  EXPECT_NEAR(part.hi[1], 800.0, 1e-9);
  EXPECT_NEAR(part.lo[0], 0.0, 1e-9); // far away all of it is in view
  EXPECT_NEAR(part.stride[0], 100.0 / 200.0, 1e-9);

  // Nothing behind the eye.
  const double behind[4] = { 0.0, 1000.0, -900.0, -200.0 };
  EXPECT_FALSE(relief::FindVisiblePart(toClip, behind, Viewport).any);
}

TEST(ReliefGrid, HasATexelForEachPixelOrSample)
{
  relief::VisiblePart part;
  part.any = true;
  part.hi[0] = 1000.0;
  part.hi[1] = 800.0;
  part.stride[0] = part.stride[1] = 0.3;
  relief::ReliefGrid grid = relief::MakeGrid(part, 1000, 800, 1.0, 1e9, 4096);
  EXPECT_EQ(grid.size[0], 1000);
  EXPECT_EQ(grid.size[1], 800);
  EXPECT_EQ(grid.stride[0], 1.0);
  EXPECT_EQ(grid.SampleOf(0, 999, 1000), 999);

  part.stride[0] = part.stride[1] = 4.0 - 1e-6; // as cameras round
  grid = relief::MakeGrid(part, 1000, 800, 1.0, 1e9, 4096);
  EXPECT_EQ(grid.stride[0], 4.0);
  EXPECT_EQ(grid.size[0], 250);

  // Any stride: at least a texel a pixel, less than one and a half; all in the field.
  for (double stride = 1.0; stride < 50.0; stride *= 1.13)
  {
    part.stride[0] = part.stride[1] = stride;
    grid = relief::MakeGrid(part, 1000, 800, 1.0, 1e9, 4096);
    EXPECT_LE(grid.stride[0], stride * 1.0001);
    EXPECT_GT(grid.stride[0], stride / 1.2);
    for (int axis = 0; axis < 2; ++axis)
    {
      const int samples = axis == 0 ? 1000 : 800;
      EXPECT_EQ(grid.first[axis], 0);
      EXPECT_LT(grid.SampleOf(axis, 0, samples), grid.stride[axis]);
      EXPECT_LT(grid.SampleOf(axis, grid.size[axis] - 1, samples), samples);
      EXPECT_GE(grid.SampleOf(axis, grid.size[axis] - 1, samples), samples - grid.stride[axis]);
    }
  }
}

TEST(ReliefGrid, KeepsToItsBounds)
{
  relief::VisiblePart part;
  part.any = true;
  part.hi[0] = 100000.0;
  part.hi[1] = 300.0;
  const relief::ReliefGrid long_ = relief::MakeGrid(part, 100000, 300, 1.0, 1e9, 4096);
  EXPECT_LE(long_.size[0], 4096);
  const relief::ReliefGrid few = relief::MakeGrid(part, 100000, 300, 1.0, 5000.0, 4096);
  EXPECT_LE(few.GetNumberOfTexels(), 5000.0);
  EXPECT_GE(few.GetNumberOfTexels(), 2000.0);
  EXPECT_GT(relief::MakeGrid(part, 100000, 300, 3.0, 5000.0, 4096).stride[0], 2.5);
  EXPECT_TRUE(relief::MakeGrid(relief::VisiblePart(), 10, 10, 1.0, 100.0, 100).IsEmpty());
}

TEST(ReliefGrid, KnowsWhatOtherGridsHold)
{
  relief::ReliefGrid large;
  large.first[0] = large.first[1] = 10;
  large.size[0] = large.size[1] = 50;
  relief::ReliefGrid inside = large;
  inside.first[0] = 20;
  inside.size[0] = 40;
  EXPECT_TRUE(large.Holds(inside));
  EXPECT_FALSE(inside.Holds(large));
  inside.size[0] = 41;
  EXPECT_FALSE(large.Holds(inside));

  relief::ReliefGrid coarse;
  coarse.stride[0] = coarse.stride[1] = 4.0;
  coarse.first[0] = coarse.first[1] = 2;
  coarse.size[0] = coarse.size[1] = 13;
  EXPECT_TRUE(coarse.Reaches(large));
  EXPECT_FALSE(coarse.Holds(large));
  coarse.size[0] = 5;
  EXPECT_FALSE(coarse.Reaches(large));
  EXPECT_FALSE(relief::ReliefGrid().Reaches(large));
}

// SPDX-License-Identifier: BSD-3-Clause
// The gallery's sculptures: sizes, bounds, what does not depend on the resolution.
#include "Sculpture.h"

#include "ReliefTestUtilities.h"

#include <cstdlib>

namespace
{
using sculpture::HeightImage;

int Failures = 0;

struct Facts
{
  double least = VTK_DOUBLE_MAX;
  double largest = -VTK_DOUBLE_MAX;
  double share = 0.0; // of samples with data
};

Facts FactsOf(const HeightImage& image)
{
  Facts facts;
  for (const float height : image.heights)
  {
    if (!std::isnan(height))
    {
      facts.least = std::min<double>(facts.least, height);
      facts.largest = std::max<double>(facts.largest, height);
      facts.share += 1.0 / image.heights.size();
    }
  }
  return facts;
}

// Coarse samples lie between four fine ones, where none of these is far from the others.
void TestResolutions(const HeightImage& coarse, const HeightImage& fine)
{
  CHECK(coarse.columns * 2 == fine.columns && coarse.rows * 2 == fine.rows);
  CHECK(coarse.spacing == 2.0 * fine.spacing);
  int compared = 0;
  int wrong = 0;
  for (int j = 0; j < coarse.rows; ++j)
  {
    for (int i = 0; i < coarse.columns; ++i)
    {
      const float corners[4] = { fine.heights[fine.At(2 * i, 2 * j)],
        fine.heights[fine.At(2 * i + 1, 2 * j)], fine.heights[fine.At(2 * i, 2 * j + 1)],
        fine.heights[fine.At(2 * i + 1, 2 * j + 1)] };
      const float least = *std::min_element(corners, corners + 4);
      const float largest = *std::max_element(corners, corners + 4);
      const float sum = corners[0] + corners[1] + corners[2] + corners[3];
      if (!std::isnan(sum) && largest - least < 0.01)
      {
        ++compared;
        wrong += std::abs(coarse.heights[coarse.At(i, j)] - sum / 4.0) < 0.01 ? 0 : 1;
      }
    }
  }
  CHECK(compared > coarse.columns * coarse.rows / 5);
  CHECK(wrong < compared / 100);
}
}

//------------------------------------------------------------------------------
int TestSculpture(int, char*[])
{
  const HeightImage owl = sculpture::CarveOwl(120);
  CHECK(owl.columns == 120 && owl.rows == 144);
  CHECK(owl.heights.size() == 120u * 144u);
  Facts facts = FactsOf(owl);
  CHECK(facts.share > 0.3 && facts.share < 0.7);
  CHECK(facts.least > -0.5 && facts.largest < 0.7 && facts.largest - facts.least > 0.5);
  TestResolutions(owl, sculpture::CarveOwl(240));
  // Nothing but detail is carved.
  const Facts smooth = FactsOf(sculpture::CarveOwl(120, 0.0));
  CHECK_NEAR(smooth.largest, facts.largest, 0.05);
  CHECK_NEAR(smooth.share, facts.share, 0.05);

  const HeightImage rosette = sculpture::StrikeRosette(120);
  CHECK(rosette.columns == 120 && rosette.rows == 120);
  facts = FactsOf(rosette);
  CHECK_NEAR(facts.share, 0.98 * 0.98 * std::acos(-1.0) / 4.0, 0.01);
  CHECK(facts.least >= 0.0 && facts.largest < 0.6);
  TestResolutions(rosette, sculpture::StrikeRosette(240));

  for (const int size : { -5, 0, 1, 2, 3 })
  {
    CHECK(sculpture::CarveOwl(size).columns == std::max(size, 1));
    CHECK(sculpture::StrikeRosette(size).rows == std::max(size, 1));
  }
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

// SPDX-License-Identifier: BSD-3-Clause
//
// Illuminations that are retraced by the reference: what is shaded keeps the promise, and what is
// not as it was shaded is found.
#include "IlluminationCheck.h"
#include "RandomScene.h"
#include "ScenePicture.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

using namespace relief;

namespace
{

constexpr std::size_t All = ~std::size_t(0) / 16;

std::vector<float> Illuminate(const HeightField& field, const Scene& scene)
{
  return Shade(field, scene, IlluminationOnly).illumination;
}

void Retrace(IlluminationCheck& check, std::size_t begin, std::size_t end)
{
  for (std::size_t k = begin; k < end; ++k)
  {
    check.Retrace(k);
  }
}

IlluminationCheck Check(const HeightField& field, const Scene& scene, const std::vector<float>& d,
  std::size_t samples = All, std::uint64_t seed = 1)
{
  const HeightView<float>& heights = field.GetField().heights;
  IlluminationCheck check(
    field, scene, { 0, 0, heights.columns, heights.rows, d.data() }, samples, seed);
  Retrace(check, 0, check.GetNumberOfSamples());
  return check;
}

}

TEST(DrawSamples, AreDifferentHaveDataAndDependOnTheSeed)
{
  const auto even = [](std::size_t at) { return at % 2 == 0; };
  for (const std::size_t wanted : { std::size_t(0), std::size_t(1), std::size_t(10),
         std::size_t(400), std::size_t(500), std::size_t(5000) })
  {
    const std::vector<std::size_t> drawn = DrawSamples(1000, wanted, 7, even);
    const std::set<std::size_t> different(drawn.begin(), drawn.end());
    EXPECT_EQ(different.size(), std::min(wanted, std::size_t(500)));
    EXPECT_EQ(different.size(), drawn.size());
    EXPECT_TRUE(std::all_of(drawn.begin(), drawn.end(), even));
    EXPECT_EQ(DrawSamples(1000, wanted, 7, even), drawn);
  }
  EXPECT_NE(DrawSamples(1000, 10, 8, even), DrawSamples(1000, 10, 7, even));
  // Where nearly nothing has data.
  const auto last = [](std::size_t at) { return at == 99999; };
  EXPECT_EQ(DrawSamples(100000, 5, 7, last), std::vector<std::size_t>{ 99999 });
  EXPECT_TRUE(DrawSamples(0, 5, 7, even).empty());
}

// All that is shaded, whatever the field, the medium, the light and the tolerance.
TEST(IlluminationCheck, KeepsWhatIsPromised)
{
  const std::uint64_t seed = Seed();
  Random random(seed);
  std::size_t samples = 0;
  std::size_t grazing = 0;
  for (int round = 0; round < 400; ++round)
  {
    const RandomScene drawn = MakeRandomScene(random);
    Prepared prepared(drawn.terrain, round % 2 == 0);
    Scene scene = Plain();
    scene.medium = drawn.medium;
    scene.medium.tolerance = round % 3 == 0 ? 0.0 : random.Logarithmic(1e-4, 0.1);
    scene.lights = { drawn.light, Sun(random.Uniform(0.0, 360.0), random.Uniform(5.0, 90.0)) };
    scene.lights[1].weight = random.Uniform(-0.3, 1.0);
    scene.lights.resize(round % 2 + 1);
    const IlluminationCheck check =
      Check(prepared.Field, scene, Illuminate(prepared.Field, scene), 200, round);
    ASSERT_NE(check.GetWorst(), nullptr);
    const IlluminationCheck::Sample& worst = *check.GetWorst();
    EXPECT_TRUE(check.IsKept()) << "seed " << seed << ", round " << round << ": " << worst.d
                                << " in place of " << worst.reference << " at " << worst.i << ' '
                                << worst.j << ", " << worst.error << "; " << drawn;
    samples += check.GetNumberOfSamples();
    grazing += check.CountGrazing();
  }
  EXPECT_LT(grazing, samples / 50);
}

// The mean is that of the layer: lights that are black, dark or take away, and an environment's
// weights.
TEST(IlluminationCheck, TakesTheMeanOfTheLayer)
{
  Prepared prepared(Hills());
  Scene scene = Rich();
  scene.medium.tolerance = 1e-3;
  scene.lights.push_back(Sun(80.0, 25.0));
  scene.lights.back().intensity = -0.4;
  scene.lights.push_back(Sun(100.0, -25.0));
  scene.lights.push_back(Sun(10.0, 5.0));
  scene.lights.back().color = glm::dvec3(0.0);
  scene.lights.push_back(Sun(200.0, 30.0));
  scene.lights.back().weight = 0.7;
  scene.lights.back().open = 0.5;
  scene.lights.back().toleranceScale = 0.25;
  const IlluminationCheck check = Check(prepared.Field, scene, Illuminate(prepared.Field, scene));
  EXPECT_TRUE(check.IsKept()) << check.GetWorst()->error;
  // 1, 0.7, 0.5, 0.4, 1 and 0.7 / 4 of the tolerance, and 1 + 0.7 + 0.5 - 0.4 + 1 + 0.7 / 2,
  // shares in single precision.
  EXPECT_NEAR(check.GetTolerance(), 1e-3 * 3.775 / 3.15, 1e-10);
  EXPECT_NEAR(check.GetRounding(), 2e-6 * 4.3 / 3.15, 1e-10);

  // Without light there is nothing that could be wrong.
  scene.lights.clear();
  EXPECT_TRUE(Check(prepared.Field, scene, Illuminate(prepared.Field, scene)).IsKept());
}

// d of another light, of another depth or of a larger tolerance is found, and so is a single one.
TEST(IlluminationCheck, FindsWhatIsWrong)
{
  Prepared prepared(Hills());
  const int columns = prepared.Field.GetField().heights.columns;
  Scene scene = Plain();
  scene.medium.tolerance = 3e-4;
  scene.lights[0] = Lamp(40.0, 60.0, 9.0);
  const std::vector<float> right = Illuminate(prepared.Field, scene);
  EXPECT_TRUE(Check(prepared.Field, scene, right).IsKept());

  Scene other = scene;
  other.lights[0].vector.x += 0.5;
  EXPECT_FALSE(Check(prepared.Field, scene, Illuminate(prepared.Field, other), 500).IsKept());
  other = scene;
  other.medium.depth *= 1.01;
  EXPECT_FALSE(Check(prepared.Field, scene, Illuminate(prepared.Field, other), 500).IsKept());
  other = scene;
  other.medium.tolerance = 0.1;
  EXPECT_FALSE(Check(prepared.Field, scene, Illuminate(prepared.Field, other)).IsKept());
  std::vector<float> darker = right;
  std::transform(right.begin(), right.end(), darker.begin(), [](float d) { return 0.999f * d; });
  EXPECT_FALSE(Check(prepared.Field, scene, darker, 500).IsKept());

  const std::size_t at = 12 * static_cast<std::size_t>(columns) + 8;
  for (const float wrong : { right[at] + 6e-4f, right[at] - 6e-4f, std::nanf(""), 3e38f })
  {
    std::vector<float> one = right;
    one[at] = wrong;
    const IlluminationCheck check = Check(prepared.Field, scene, one);
    EXPECT_FALSE(check.IsKept()) << wrong;
    EXPECT_EQ(check.GetWorst()->i, 8);
    EXPECT_EQ(check.GetWorst()->j, 12);
    // Rounding of the heights has no part in what it does not explain.
    EXPECT_FALSE(check.GetWorst()->grazing);
    EXPECT_TRUE(std::isnan(wrong) ||
      check.GetWorst()->error == std::abs(double(wrong) - check.GetWorst()->reference));
  }
}

// Where few have data, a list of them is shuffled, without such a list.
TEST(DrawSamples, OfFewAreThoseOfAShuffledList)
{
  std::mt19937_64 random(7);
  for (const std::size_t total : { 1, 2, 9, 400, 5000 })
  {
    std::vector<std::size_t> some;
    std::set<std::size_t> with;
    for (std::size_t at = 0; at < total; ++at)
    {
      if (random() % 40 == 0)
      {
        some.push_back(at);
        with.insert(at);
      }
    }
    for (const std::size_t wanted : { 1, 3, 60, 10000 })
    {
      const std::uint64_t seed = random();
      const std::vector<std::size_t> drawn =
        DrawSamples(total, wanted, seed, [&with](std::size_t at) { return with.count(at) > 0; });
      // What has been drawn in vain by then counts.
      std::mt19937_64 numbers(seed);
      std::set<std::size_t> tried;
      std::vector<std::size_t> expected;
      for (std::size_t k = 0; k < 16 * wanted && 4 * wanted < total && expected.size() < wanted;
           ++k)
      {
        const std::size_t at = static_cast<std::size_t>(numbers() % total);
        if (tried.insert(at).second && with.count(at))
        {
          expected.push_back(at);
        }
      }
      if (expected.size() < wanted)
      {
        expected = some;
        const std::size_t count = std::min(wanted, expected.size());
        for (std::size_t k = 0; k < count; ++k)
        {
          std::swap(
            expected[k], expected[k + static_cast<std::size_t>(numbers() % (expected.size() - k))]);
        }
        expected.resize(count);
      }
      EXPECT_EQ(drawn, expected) << total << " " << wanted;
    }
  }
}

// Parts of a picture are retraced at their place.
TEST(IlluminationCheck, TakesAPart)
{
  Prepared prepared(Hills());
  const HeightView<float>& heights = prepared.Field.GetField().heights;
  const Scene scene = Plain();
  const std::vector<float> d = Illuminate(prepared.Field, scene);
  std::vector<float> part;
  for (int j = 9; j < 30; ++j)
  {
    part.insert(
      part.end(), d.begin() + j * heights.columns + 13, d.begin() + j * heights.columns + 50);
  }
  IlluminationCheck check(prepared.Field, scene, { 13, 9, 37, 21, part.data() }, All, 1);
  Retrace(check, 0, 100);
  Retrace(check, 100, check.GetNumberOfSamples());
  EXPECT_TRUE(check.IsKept());
  // Holes are left out.
  EXPECT_LT(check.GetNumberOfSamples(), std::size_t(37 * 21));
  EXPECT_GT(check.GetNumberOfSamples(), std::size_t(37 * 21 - 41));
  IlluminationCheck beside(prepared.Field, scene, { 14, 9, 37, 21, part.data() }, All, 1);
  Retrace(beside, 0, beside.GetNumberOfSamples());
  EXPECT_FALSE(beside.IsKept());
}

TEST(IlluminationCheck, OfNoData)
{
  Terrain terrain(5, 4);
  terrain.Fill([](double, double) { return NoData; });
  Prepared prepared(terrain);
  const std::vector<float> d(20, 0.0f);
  const IlluminationCheck check = Check(prepared.Field, Plain(), d);
  EXPECT_EQ(check.GetNumberOfSamples(), 0u);
  EXPECT_EQ(check.GetWorst(), nullptr);
  EXPECT_TRUE(check.IsKept());
}

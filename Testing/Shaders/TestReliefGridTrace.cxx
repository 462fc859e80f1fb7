// SPDX-License-Identifier: BSD-3-Clause
//
// Lights traced on the processor for the texels of a grid: the model's d at each of them, wherever
// the grid begins, in whichever bands, and with no more work than the samples that are wanted.

#include "PreparedTerrain.h"

#include "ReliefGridTrace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace relief;

namespace
{

constexpr int Columns = 203;
constexpr int Rows = 118;

// Hills with a rough surface, with samples without data among them.
Terrain Landscape(bool holes = true)
{
  Random random(3);
  Terrain terrain(Columns, Rows, 1.0, 1.25);
  terrain.Fill(
    [&](double x, double y)
    {
      const double height = 6.0 * std::sin(0.05 * x) * std::cos(0.07 * y);
      return holes && random.Chance(0.01) ? NoData : height + random.Uniform(0.0, 0.6);
    });
  terrain.RoundToSingle();
  return terrain;
}

// The texels [first, first + size) of the grid with a stride, as far as the field reaches.
ReliefGrid Grid(double stride, int firstX = 0, int firstY = 0)
{
  ReliefGrid grid;
  const int first[2] = { firstX, firstY };
  const int samples[2] = { Columns, Rows };
  for (int axis = 0; axis < 2; ++axis)
  {
    grid.first[axis] = first[axis];
    grid.stride[axis] = stride;
    grid.size[axis] = static_cast<int>(std::ceil(samples[axis] / stride)) - first[axis];
  }
  return grid;
}

LightPlan Plan(const HeightField& field, const Scene& scene)
{
  return PlanEffects(field, scene).lights[0];
}

std::vector<float> Trace(const HeightField& field, const Scene& scene, const ReliefGrid& grid,
  RayCount& count, const ParallelFor& parallelFor = RunSerial)
{
  const GridTrace trace(field, scene, Plan(field, scene), grid);
  std::vector<float> d(static_cast<std::size_t>(grid.size[0]) * grid.size[1], -1.0f);
  trace.Trace(0, grid.size[1], d.data(), parallelFor, count);
  return d;
}

struct Case
{
  const char* name;
  Scene scene;
};

std::vector<Case> Cases()
{
  std::vector<Case> cases;
  auto add = [&](const char* name, const Light& light, const f64::ReliefMedium& medium)
  {
    Scene scene;
    scene.medium = medium;
    scene.lights = { light };
    cases.push_back({ name, scene });
  };
  add("a sun", Sun(315.0, 25.0), Sunk(1.0, f64::RELIEF_TANGENT_PLANE));
  add("a sun straight down", Sun(100.0, 40.0), Sunk(0.5));
  add("a sun along the normal", Sun(315.0, 25.0), Sunk(1.0, f64::RELIEF_SURFACE_NORMAL));
  add("a sun over a floor", Sun(315.0, -25.0), WithFloor(Sunk(1.0), -9.0));
  add("a lamp", Lamp(100.0, 60.0, 30.0), Sunk(1.0, f64::RELIEF_TANGENT_PLANE));
  cases.push_back(cases.back());
  cases.back().name = "fixed steps";
  cases.back().scene.integrator = Integrator::FixedStep;
  return cases;
}

// The parts of a loop one by one, the last first.
void RunBackward(int count, const std::function<void(int, int)>& body)
{
  for (int k = count; k > 0; --k)
  {
    body(k - 1, k);
  }
}

}

TEST(ReliefGridTrace, AgreesWithTheReferenceAtEveryStride)
{
  HeightField field;
  Prepare(Landscape(), field);
  const HeightView<float>& heights = field.GetField().heights;
  for (const Case& test : Cases())
  {
    const bool counts = test.scene.integrator == Integrator::FixedStep;
    const std::vector<double> expected =
      counts ? std::vector<double>() : Reference(field, test.scene.medium, test.scene.lights[0]);
    RayCount all;
    const std::vector<float> samples = Trace(field, test.scene, Grid(1.0), all);
    for (double stride : { 1.0, 1.189207115, 2.0, 3.363585661, 8.0, 19.02731384 })
    {
      SCOPED_TRACE(testing::Message() << test.name << ", stride " << stride);
      const ReliefGrid grid = Grid(stride);
      RayCount count;
      const std::vector<float> d = Trace(field, test.scene, grid, count);
      std::size_t at = 0;
      for (int row = 0; row < grid.size[1]; ++row)
      {
        for (int k = 0; k < grid.size[0]; ++k, ++at)
        {
          const int i = grid.SampleOf(0, k, Columns);
          const int j = grid.SampleOf(1, row, Rows);
          const std::size_t sample = static_cast<std::size_t>(j) * Columns + i;
          if (std::isnan(heights.At(i, j)))
          {
            ASSERT_EQ(d[at], 0.0f);
          }
          else if (counts)
          {
            ASSERT_EQ(d[at], samples[sample]);
          }
          else
          {
            ASSERT_NEAR(d[at], expected[sample], 1e-3) << i << ", " << j;
          }
        }
      }
    }
  }
}

TEST(ReliefGridTrace, DoesNotDependOnPartsThreadsOrWhereTheGridBegins)
{
  HeightField field;
  Prepare(Landscape(), field);
  for (Case& test : Cases())
  {
    test.scene.medium.tolerance = 0.01;
    for (double stride : { 1.0, 2.0, 3.363585661, 6.727171322 })
    {
      SCOPED_TRACE(testing::Message() << test.name << ", stride " << stride);
      const ReliefGrid whole = Grid(stride);
      RayCount count;
      const std::vector<float> expected = Trace(field, test.scene, whole, count);
      RayCount again;
      EXPECT_EQ(Trace(field, test.scene, whole, again, RunBackward), expected);
      EXPECT_EQ(again.cells, count.cells);

      const ReliefGrid part = Grid(stride, 7, 5);
      const std::vector<float> d = Trace(field, test.scene, part, again);
      for (int row = 0; row < part.size[1]; ++row)
      {
        const auto from = expected.begin() + (row + 5) * whole.size[0] + 7;
        ASSERT_TRUE(std::equal(from, from + part.size[0], d.begin() + row * part.size[0])) << row;
      }

      // Bands that end where they may are no more work together.
      const GridTrace trace(field, test.scene, Plan(field, test.scene), whole);
      std::vector<float> banded(expected.size());
      RayCount inBands;
      for (int row = 0; row < whole.size[1];)
      {
        const int end = GridTrace::EndOfBand(field, whole, row + 1);
        ASSERT_GT(end, row);
        trace.Trace(row, end, banded.data() + row * whole.size[0], RunSerial, inBands);
        row = end;
      }
      EXPECT_EQ(banded, expected);
      EXPECT_EQ(inBands.cells, count.cells);
    }
  }
}

// No sample is traced more than once, and of those that are not wanted only what lies in a tile.
TEST(ReliefGridTrace, TracesWhatIsWanted)
{
  HeightField field;
  Prepare(Landscape(false), field);
  for (const Case& test : Cases())
  {
    const LightPlan plan = Plan(field, test.scene);
    double before = GridTrace::EstimateWork(field, test.scene, plan, Grid(1.0));
    for (double stride : { 1.0, 2.0, 4.0, 8.0, 16.0 })
    {
      SCOPED_TRACE(testing::Message() << test.name << ", stride " << stride);
      const ReliefGrid grid = Grid(stride);
      RayCount count;
      Trace(field, test.scene, grid, count);
      const bool tiles = SweepThickness::Applies(test.scene.medium, test.scene.lights[0]) &&
        test.scene.integrator == Integrator::Exact && stride < 2.9;
      EXPECT_EQ(count.rays, tiles ? Columns * Rows : grid.GetNumberOfTexels());
      const double work = GridTrace::EstimateWork(field, test.scene, plan, grid);
      EXPECT_LE(work, before * 1.1);
      before = work;
    }
    // A view of a corner of the field.
    ReliefGrid corner = Grid(1.0, 150, 100);
    corner.size[0] = 20;
    corner.size[1] = 3;
    RayCount count;
    Trace(field, test.scene, corner, count);
    EXPECT_LE(count.rays, 3u * 16u * 32u);
  }
}

// Without padding, as a field too narrow for lockstep is, every light is traced by packets.
TEST(ReliefGridTrace, TakesNarrowFields)
{
  HeightField padded;
  HeightField narrow;
  Prepare(Landscape(), padded);
  Prepare(Landscape(), narrow, false);
  RayCount count;
  const Scene scene = Cases()[0].scene;
  const std::vector<float> expected = Trace(padded, scene, Grid(2.0), count);
  const std::vector<float> d = Trace(narrow, scene, Grid(2.0), count);
  for (std::size_t at = 0; at < d.size(); ++at)
  {
    ASSERT_NEAR(d[at], expected[at], 2e-3);
  }
}

TEST(ReliefGridTrace, KnowsSoftwareByItsName)
{
  for (const char* name :
    { "llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Software Rasterizer", "SWR (LLVM 11)",
      "Google SwiftShader", "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device), SwiftShader driver)",
      "GDI Generic", "Microsoft Basic Render Driver", "D3D12 (Microsoft Basic Render Driver)",
      "Apple Software Renderer" })
  {
    EXPECT_TRUE(IsSoftwareRenderer(name)) << name;
  }
  for (const char* name : { "", "NVIDIA GeForce RTX 3080/PCIe/SSE2", "Mesa Intel(R) UHD Graphics",
         "AMD Radeon RX 6800 (navi21, LLVM 15.0.7, DRM 3.49)", "Apple M1", "D3D12 (NVIDIA)",
         "virgl (AMD Radeon)" })
  {
    EXPECT_FALSE(IsSoftwareRenderer(name)) << name;
  }
}

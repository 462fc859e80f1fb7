// SPDX-License-Identifier: BSD-3-Clause
#ifndef PreparedTerrain_h
#define PreparedTerrain_h

/// @file
/// A terrain prepared as the filter does, its reference, and tests that run on every instruction
/// set.

#include "TestTerrain.h"

#include "HeightField.h"

#include <hwy/targets.h>

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

inline void RunSerial(int count, const std::function<void(int, int)>& body)
{
  body(0, count);
}

/// Rows of values, one after the other, with a spacing of 1.
template <class T>
relief::HeightSource<T> SourceOf(const std::vector<T>& values, int columns)
{
  relief::HeightSource<T> source;
  source.data = values.data();
  source.stepY = columns;
  source.columns = columns;
  source.rows = static_cast<int>(values.size()) / columns;
  return source;
}

/// Makes a field of a terrain's heights, padded for the lockstep integrator or not; returns what is
/// wrong with them, or nothing.
inline std::string Assign(const Terrain& terrain, relief::HeightField& field, bool padded = true)
{
  relief::HeightSource<double> source;
  source.data = terrain.heights.data();
  source.stepY = terrain.columns;
  source.columns = terrain.columns;
  source.rows = terrain.rows;
  source.spacingX = terrain.spacingX;
  source.spacingY = terrain.spacingY;
  return field.Assign(source, RunSerial, padded);
}

inline void Prepare(const Terrain& terrain, relief::HeightField& field, bool padded = true)
{
  ASSERT_EQ(Assign(terrain, field, padded), "");
}

/// d of every sample in double, without bounds and without tolerance.
inline std::vector<double> Reference(
  const relief::HeightField& field, relief::f64::ReliefMedium medium, const relief::Light& light)
{
  relief::Field<float> plain = field.GetField();
  plain.bounds = nullptr;
  medium.tolerance = 0.0;
  std::vector<double> result(static_cast<std::size_t>(plain.heights.columns) * plain.heights.rows);
  std::vector<glm::dvec3> normals(plain.heights.columns);
  relief::RayCount count;
  for (int j = 0; j < plain.heights.rows; ++j)
  {
    relief::RowRequest<double> request;
    request.j = j;
    request.end = plain.heights.columns;
    for (int i = 0; i < plain.heights.columns; ++i)
    {
      normals[i] = relief::f64::reliefNormal(plain, i, j);
    }
    request.normals = normals.data();
    request.illumination = result.data() + static_cast<std::size_t>(j) * plain.heights.columns;
    relief::TraceRow<double>(plain, medium, light, request, count);
  }
  return result;
}

/// With each tolerance d is within it of the exact d. `trace` takes a field, a medium and the work
/// to count, and returns d of every sample.
template <class Trace>
void ExpectTolerance(const Terrain& terrain, relief::f64::ReliefMedium medium, Trace&& trace)
{
  relief::HeightField field;
  Prepare(terrain, field);
  relief::RayCount count;
  const std::vector<float> exact = trace(field, medium, count);
  for (double tolerance : { 0.1, 0.02, 0.002 })
  {
    medium.tolerance = tolerance;
    const std::vector<float> traced = trace(field, medium, count);
    for (std::size_t at = 0; at < traced.size(); ++at)
    {
      if (!std::isnan(terrain.heights[at]))
      {
        ASSERT_LE(std::abs(traced[at] - exact[at]), tolerance + 1e-5) << "sample " << at;
      }
    }
  }
}

/// Over rough ground, where most of every low ray lies in the dark, each larger tolerance is less
/// work.
template <class Trace>
void ExpectToleranceSavesWork(Trace&& trace)
{
  Random random(6);
  Terrain terrain(400, 300, 1.0, 1.0);
  for (double& height : terrain.heights)
  {
    height = random.Uniform(0.0, 20.0);
  }
  relief::HeightField field;
  Prepare(terrain, field);
  relief::f64::ReliefMedium medium = Sunk(1.0, relief::f64::RELIEF_VERTICAL);
  std::uint64_t before = ~std::uint64_t(0);
  for (double tolerance : { 0.0, 0.002, 0.02, 0.1 })
  {
    medium.tolerance = tolerance;
    relief::RayCount work;
    trace(field, medium, work);
    EXPECT_EQ(work.rays, terrain.heights.size());
    EXPECT_LT(work.cells, before);
    before = work.cells;
  }
}

/// A test that is run on every instruction set of this machine.
class EveryTarget : public testing::TestWithParam<std::int64_t>
{
protected:
  void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
  void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

#define INSTANTIATE_FOR_EVERY_TARGET(suite)                                                        \
  INSTANTIATE_TEST_SUITE_P(EveryTarget, suite,                                                     \
    testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),                                        \
    [](const testing::TestParamInfo<std::int64_t>& info) { return hwy::TargetName(info.param); })

#endif

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

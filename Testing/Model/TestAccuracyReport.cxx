// SPDX-License-Identifier: BSD-3-Clause
//
// What accuracy costs on a field: every setting's error, and times that can be compared.
#include "AccuracyReport.h"
#include "ReferenceIllumination.h"
#include "ScenePicture.h"

#include <algorithm>
#include <cmath>

using namespace relief;

namespace
{

bool GoOn(double)
{
  return true;
}

Scene Low()
{
  Scene scene = Plain();
  scene.lights[0] = Lamp(-60.0, 80.0, 9.0);
  scene.medium.tolerance = 3e-4;
  return scene;
}

// The errors of all samples, found without the report.
std::vector<double> ErrorsOf(const HeightField& field, Scene scene, double tolerance)
{
  scene.medium.tolerance = tolerance;
  const std::vector<float> d = Shade(field, scene, IlluminationOnly).illumination;
  const std::vector<double> exact = Reference(field, scene.medium, scene.lights[0]);
  std::vector<double> errors;
  for (std::size_t at = 0; at < exact.size(); ++at)
  {
    if (!std::isnan(d[at]))
    {
      errors.push_back(std::abs(d[at] - exact[at]));
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

const AccuracyPoint& Find(const AccuracyReport& report, double tolerance)
{
  const auto found = std::find_if(report.GetPoints().begin(), report.GetPoints().end(),
    [&](const AccuracyPoint& point)
    { return point.integrator == Integrator::Exact && point.tolerance == tolerance; });
  EXPECT_NE(found, report.GetPoints().end()) << tolerance;
  return *found;
}

}

TEST(AccuracyReport, HasErrorAndTimeOfEverySetting)
{
  Prepared prepared(Hills());
  const Scene scene = Low();
  AccuracyReport report(prepared.Field, scene, 1);
  double before = 0.0;
  ASSERT_TRUE(report.Measure(RunSerial,
    [&](double done)
    {
      EXPECT_GE(done, before);
      EXPECT_LE(done, 1.0);
      before = done;
      return true;
    }));
  EXPECT_EQ(before, 1.0);

  // Tolerances, then steps; the scene's own is marked.
  ASSERT_EQ(report.GetPoints().size(), 16u);
  const double tolerances[] = { 0.0, 1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1 };
  const std::size_t data = report.GetNumberOfSamples();
  for (std::size_t k = 0; k < 8; ++k)
  {
    const AccuracyPoint& exact = report.GetPoints()[k];
    EXPECT_EQ(exact.integrator, Integrator::Exact);
    EXPECT_EQ(exact.tolerance, tolerances[k]);
    EXPECT_EQ(exact.present, k == 2);
    EXPECT_LE(exact.mostOf999, exact.tolerance + 1e-5);
    const AccuracyPoint& steps = report.GetPoints()[8 + k];
    EXPECT_EQ(steps.integrator, Integrator::FixedStep);
    EXPECT_EQ(steps.steps, 8 << k);
    EXPECT_FALSE(steps.present);
  }
  for (const AccuracyPoint& point : report.GetPoints())
  {
    EXPECT_GT(point.nanoseconds, 0.0);
    EXPECT_NEAR(point.seconds, 1e-9 * point.nanoseconds * data, 1e-9 * point.seconds);
    EXPECT_EQ(point.timed, data); // the field is small
    EXPECT_LE(point.rms, point.most);
    EXPECT_LE(point.mostOf999, point.most);
  }
  // All samples are compared.
  for (const double tolerance : { 0.0, 0.01, 0.1 })
  {
    const std::vector<double> errors = ErrorsOf(prepared.Field, scene, tolerance);
    const AccuracyPoint& point = Find(report, tolerance);
    EXPECT_EQ(point.compared, errors.size());
    EXPECT_EQ(point.compared, data);
    EXPECT_EQ(point.most, errors.back()) << tolerance;
    EXPECT_EQ(point.mostOf999, errors[static_cast<std::size_t>(std::ceil(0.999 * data)) - 1]);
  }
  // The tolerance is made use of, and the published steps do not come near.
  EXPECT_GT(Find(report, 0.1).most, 1e-3);
  EXPECT_GT(report.GetPoints()[15].mostOf999, 0.1);
}

// A setting that is not among the usual ones gets a place of its own.
TEST(AccuracyReport, MarksThePresentSetting)
{
  Prepared prepared(Hills());
  Scene scene = Low();
  const auto present = [&]
  {
    AccuracyReport report(prepared.Field, scene, 1);
    const std::vector<AccuracyPoint>& points = report.GetPoints();
    EXPECT_EQ(points.size(), 17u);
    EXPECT_EQ(std::count_if(points.begin(), points.end(),
                [](const AccuracyPoint& point) { return point.present; }),
      1);
    return *std::find_if(
      points.begin(), points.end(), [](const AccuracyPoint& point) { return point.present; });
  };
  scene.medium.tolerance = 0.002;
  EXPECT_EQ(present().tolerance, 0.002);
  scene.integrator = Integrator::FixedStep;
  scene.steps = 300;
  EXPECT_EQ(present().steps, 300);
  EXPECT_EQ(present().integrator, Integrator::FixedStep);
}

// The work is bounded whatever the field and the number of lights.
TEST(AccuracyReport, IsBounded)
{
  Terrain terrain(2000, 1400);
  terrain.Fill([](double x, double y) { return 3.0 * std::sin(0.1 * x + 0.02 * y); });
  terrain.RoundToSingle();
  Prepared prepared(terrain);
  Scene scene = Plain();
  AccuracyReport report(prepared.Field, scene, 5);
  ASSERT_EQ(report.GetPoints().size(), 16u);
  EXPECT_EQ(report.GetNumberOfSamples(), 2000u * 1400u);
  ASSERT_TRUE(report.Measure(RunSerial, GoOn));
  EXPECT_GE(report.GetNumberOfProbes(), 10000u);
  EXPECT_LE(report.GetNumberOfProbes(), 70000u);
  for (const AccuracyPoint& point : report.GetPoints())
  {
    EXPECT_LE(point.timed, std::size_t(1) << 19);
    EXPECT_GE(point.compared, 500u);
    EXPECT_NEAR(point.seconds, 1e-9 * point.nanoseconds * 2000 * 1400, 1e-9 * point.seconds);
  }

  // Many lights: fewer samples, and not all of the steps.
  scene.lights.assign(300, scene.lights[0]);
  AccuracyReport many(prepared.Field, scene, 5);
  EXPECT_LT(many.GetPoints().size(), 13u);
  EXPECT_GE(many.GetPoints().size(), 9u);
  EXPECT_LE(many.GetNumberOfProbes(), 16u * 256u);
}

// Where a part of the samples is compared, the seed says which.
TEST(AccuracyReport, HasTheSameErrorsOfTheSameSeed)
{
  Terrain terrain(200, 180);
  terrain.Fill([](double x, double y) { return 3.0 * std::sin(0.1 * x + 0.02 * y); });
  terrain.RoundToSingle();
  Prepared prepared(terrain);
  const Scene scene = Plain();
  AccuracyReport report(prepared.Field, scene, 5);
  AccuracyReport again(prepared.Field, scene, 5);
  ASSERT_TRUE(report.Measure(RunSerial, GoOn));
  ASSERT_TRUE(again.Measure(RunSerial, GoOn));
  EXPECT_LT(report.GetNumberOfProbes(), 200u * 180u);
  for (std::size_t k = 0; k < report.GetPoints().size(); ++k)
  {
    EXPECT_EQ(again.GetPoints()[k].rms, report.GetPoints()[k].rms);
    EXPECT_EQ(again.GetPoints()[k].most, report.GetPoints()[k].most);
  }
}

TEST(AccuracyReport, RecommendsTheQuickestThatDoesNotShow)
{
  Prepared prepared(Hills());
  Scene scene = Low();
  for (const double intensity : { 0.5, 200.0 })
  {
    scene.lights[0].intensity = intensity;
    scene.exposure = 1.0;
    AccuracyReport report(prepared.Field, scene, 1);
    EXPECT_NEAR(report.GetVisibleError(), 1.0 / (12.92 * 255.0 * 2.0 * intensity), 1e-12);
    ASSERT_TRUE(report.Measure(RunSerial, GoOn));
    const std::size_t chosen = report.GetRecommended();
    const AccuracyPoint& best = report.GetPoints()[chosen];
    EXPECT_EQ(best.integrator, Integrator::Exact);
    EXPECT_TRUE(best.tolerance == 0.0 || best.mostOf999 <= report.GetVisibleError());
    for (std::size_t k = 0; k < 8; ++k)
    {
      const AccuracyPoint& point = report.GetPoints()[k];
      if (point.mostOf999 <= report.GetVisibleError())
      {
        EXPECT_LE(best.nanoseconds, 1.1 * point.nanoseconds);
      }
    }
  }
}

TEST(AccuracyReport, EndsWhenItIsTold)
{
  Prepared prepared(Hills());
  const Scene scene = Low();
  for (int calls = 0; calls < 40; calls += 7)
  {
    AccuracyReport report(prepared.Field, scene, 1);
    int left = calls;
    EXPECT_FALSE(report.Measure(RunSerial, [&](double) { return left-- > 0; }));
    EXPECT_EQ(left, -1); // it was not asked again
  }
  Terrain empty(20, 10);
  empty.Fill([](double, double) { return NoData; });
  Prepared nothing(empty);
  AccuracyReport report(nothing.Field, scene, 1);
  EXPECT_FALSE(report.Measure(RunSerial, GoOn));
  EXPECT_TRUE(report.GetPoints().empty());
}

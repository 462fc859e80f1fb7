// SPDX-License-Identifier: BSD-3-Clause
//
// What must hold of every scene, tried on 16,000 random ones that are the same in every run. A
// scene that fails is made as small as it can be and printed as code, to be pasted into
// HardCases.cxx.
//
// Scenes that never were before are a run of their own, so that nobody's change fails by another's
// fault: ctest -C Nightly -L nightly. To look further, or at a seed that such a run has printed:
//
//   RELIEF_SEED=7 RELIEF_SCENES=1000000 reliefModelTests --gtest_filter='HardProperties.*'
#include "HardSceneChecks.h"
#include "HardSceneShrinking.h"
#include "RandomHardScene.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <iostream>

namespace
{

int NumberOfScenes(int otherwise)
{
  const char* text = std::getenv("RELIEF_SCENES");
  return text ? std::atoi(text) : otherwise;
}

// All that must hold of a scene; where a check takes a choice, it is made by the scene's number.
std::string CheckAll(const HardScene& scene, int number, BackwardErrors& found)
{
  std::string wrong = CheckRange(scene);
  wrong = wrong.empty() ? CheckBackwardError(scene, MostUnits, found) : wrong;
  wrong = wrong.empty() ? CheckMirrors(scene) : wrong;
  wrong = wrong.empty() ? CheckScaling(scene) : wrong;
  wrong = wrong.empty() && number % 4 == 0 ? CheckNudges(scene) : wrong; // the dearest
  wrong = wrong.empty() ? CheckTolerance(scene, number % 2 == 0 ? 0.002 : 0.1) : wrong;
  wrong = wrong.empty() ? CheckFixedSteps(scene, 1 + number % 40) : wrong;
  const Terrain& terrain = scene.terrain;
  const int i = number % terrain.columns;
  const int j = number / 7 % terrain.rows;
  wrong = wrong.empty()
    ? CheckRaisedWall(scene, i, j, terrain.At(i, j) + (number % 3 + 1) * terrain.spacingX)
    : wrong;
  return wrong;
}

void Try(std::uint64_t seed, int scenes)
{
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  BackwardErrors found;
  int failures = 0;
  for (int number = 0; number < scenes && failures < 5; ++number)
  {
    Random random(seed + 1000003ULL * static_cast<std::uint64_t>(number));
    const HardScene scene = MakeRandomHardScene(random);
    const std::string wrong = CheckAll(scene, number, found);
    if (wrong.empty())
    {
      continue;
    }
    ++failures;
    std::cout << "scene " << number << ", to be made smaller: " << wrong << std::endl;
    BackwardErrors ignored;
    const HardScene small = Shrink(scene,
      [&](const HardScene& candidate) { return !CheckAll(candidate, number, ignored).empty(); });
    ADD_FAILURE() << "RELIEF_SEED=" << seed << ", scene " << number << ": "
                  << CheckAll(small, number, ignored) << "\n"
                  << small;
  }
  std::printf(
    "%d scenes, d computed %ld times: heights moved for %ld of them, by more than 4 units "
    "for %ld, by at most %g in single precision and %g in double; rays moved for %ld\n",
    scenes, found.samples, found.moved, found.far, found.single, found.reference, found.jumps);
}

}

TEST(HardProperties, OfTheSameScenes)
{
  const int scenes = NumberOfScenes(16000);
  ASSERT_GT(scenes, 0) << "RELIEF_SCENES";
  Try(Seed(), scenes);
}

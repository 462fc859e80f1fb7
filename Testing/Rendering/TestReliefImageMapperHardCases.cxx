// SPDX-License-Identifier: BSD-3-Clause
//
// The catalogue of hard cases through the mapper: what either device computes is, as what
// the filter computes, that of heights within rounding.
#include "ReliefHardCaseUtilities.h"
#include "ReliefMapperTestUtilities.h"

#include <algorithm>

namespace
{
int Failures = 0;
}

int TestReliefImageMapperHardCases(int, char*[])
{
  int scenes = 0;
  ForEachHardLight(
    [&](const char* name, const HardScene& hard, std::size_t light)
    {
      MapperStage stage(ImageOf(hard.terrain));
      MessageKeeper warnings(stage.mapper); // of single rows
      Assign(hard, light, stage.Scene());
      const Terrain& terrain = hard.terrain;
      if (terrain.spacingX != terrain.spacingY || terrain.spacingX < 0.05)
      {
        return; // no camera shows it a pixel for a sample
      }
      stage.window->SetSize(std::max(terrain.columns, 120), terrain.rows);
      stage.LookAtAll();
      for (const int device : TracingDevices)
      {
        stage.mapper->SetTracing(device);
        CHECK(stage.Render());
        CHECK(CountWrong("mapper", name, hard, light, stage.Shading(), nullptr) == 0);
      }
      ++scenes;
    });
  std::cout << scenes << " scenes" << std::endl;
  CHECK(scenes > 100);
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

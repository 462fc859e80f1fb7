// SPDX-License-Identifier: BSD-3-Clause
//
// Random sequences of what programs do to a mapper: whatever has happened before, a still frame
// shows the filter's picture. RELIEF_SEED repeats a run, RELIEF_SEQUENCES makes it longer.

#include "ReliefMapperPlayer.h"

namespace
{

int Failures = 0;

void Play(MapperPlayer& player)
{
  const int steps = player.Changes.Below(8) + 2;
  for (int step = 0; step < steps; ++step)
  {
    if (player.Changes.Below(7) == 0)
    {
      player.Lose();
    }
    else
    {
      player.Change();
    }
    if (player.Changes.Below(3) == 0)
    {
      CHECK(player.Stage.Render());
    }
  }
}

void Verify(MapperPlayer& player)
{
  CHECK(player.RenderAll());
  vtkOpenGLReliefImageMapper* mapper = player.Stage.mapper;
  vtkNew<vtkImageReliefShading> filter;
  for (int port = 0; port < mapper->GetNumberOfInputPorts(); ++port)
  {
    filter->SetInputData(port, mapper->GetInputDataObject(port, 0));
  }
  filter->SetStretchTextures(mapper->GetStretchTextures());
  filter->SetScene(mapper->GetScene());
  filter->Update();
  const Agreement agreement = CompareColors(filter->GetOutput(), player.Stage.Shading(), 2.0e-2);
  CHECK(agreement.shareBeyond <= 5.0e-3);
}

}

int TestReliefImageMapperSequences(int, char*[])
{
  MapperPlayer player(ChooseSeed());
  const int sequences = FromEnvironment("RELIEF_SEQUENCES", 40);
  for (int k = 0; k < sequences && Failures == 0; ++k)
  {
    Play(player);
    Verify(player);
    if (Failures > 0)
    {
      std::cout << "in sequence " << k << std::endl;
    }
  }
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

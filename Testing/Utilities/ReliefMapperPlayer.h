// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefMapperPlayer_h
#define ReliefMapperPlayer_h

#include "ReliefLongRunTestUtilities.h"
#include "ReliefMapperTestUtilities.h"

/// Does to a mapper, at random, what programs do to it.
class MapperPlayer
{
public:
  explicit MapperPlayer(unsigned int seed)
    : Changes(seed)
  {
  }

  /// Changes the scene, the heights or what is seen of them.
  void Change()
  {
    vtkCamera* camera = this->Stage.renderer->GetActiveCamera();
    switch (this->Changes.Below(16))
    {
      case 0:
        this->Stage.mapper->SetInputData(this->Changes.Heights());
        break;
      case 1:
        this->Stage.window->SetSize(40 + this->Changes.Below(150), 40 + this->Changes.Below(120));
        break;
      case 2:
        this->Stage.mapper->SetCacheMemoryLimit(this->Changes.Below(3) * 20);
        break;
      case 3:
        camera->SetParallelScale(3.0 + 100.0 * this->Changes.Share());
        break;
      case 4:
        camera->Azimuth(40.0 * (this->Changes.Share() - 0.5));
        break;
      case 5:
        this->Stage.window->SetDesiredUpdateRate(this->Changes.Below(2) ? 10000.0 : 0.0001);
        break;
      case 6:
        this->Stage.mapper->SetDiffuseTextureData(this->Changes.Picture());
        this->Stage.mapper->SetBaseTextureData(this->Changes.Picture());
        this->Stage.mapper->SetSpecularTextureData(this->Changes.Picture());
        this->Stage.mapper->StretchTexturesOn();
        break;
      default:
        this->Changes.ChangeScene(this->Stage.Scene());
        break;
    }
  }

  /// Takes away what is on the graphics processor.
  void Lose()
  {
    switch (this->Changes.Below(3))
    {
      case 0:
        this->Stage.mapper->ReleaseGraphicsResources(this->Stage.window);
        break;
      case 1:
        this->Stage.window->Finalize();
        break;
      default:
        this->Stage.mapper->SetTextureSizeLimit(this->Changes.Below(2) * 64);
        break;
    }
  }

  /// A still picture with one texel for each sample, as the filter has it.
  bool RenderAll()
  {
    const int* size = this->Stage.mapper->GetInput()->GetDimensions();
    this->Stage.window->SetDesiredUpdateRate(0.0001);
    this->Stage.mapper->SetTextureSizeLimit(0);
    this->Stage.window->SetSize(size[0], size[1]);
    this->Stage.LookAtAll();
    return this->Stage.Render() && this->Stage.mapper->GetConverged();
  }

  RandomChanges Changes;
  MapperStage Stage{ MakeHeights(60, 40, Hills(1)) };
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Shades a digital elevation model and shows it as an image.
//
//   ShadeTerrain Examples/Data/jacksboro.tif [picture.png]
#include "ShowOrWrite.h"

#include <vtkCamera.h>
#include <vtkErrorCode.h>
#include <vtkImageProperty.h>
#include <vtkImageReliefShading.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkLight.h>
#include <vtkReliefMaterial.h>
#include <vtkReliefRasterReader.h>
#include <vtkReliefScene.h>
#include <vtkRenderer.h>

#include <iostream>

int main(int argc, char* argv[])
{
  if (argc < 2)
  {
    std::cerr << "Usage: " << argv[0] << " heights.tif [picture.png]\n";
    return EXIT_FAILURE;
  }

  // The file's samples are 3 seconds of arc apart. They come in metres, as heights do.
  vtkNew<vtkReliefRasterReader> heights;
  heights->SetFileName(argv[1]);
  heights->Update();
  if (heights->GetErrorCode() != vtkErrorCode::NoError)
  {
    return EXIT_FAILURE; // the reader has said why
  }

  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputConnection(heights->GetOutputPort());
  shading->SetOutputScalarTypeToUnsignedChar(); // sRGB, as a screen expects

  vtkReliefScene* scene = shading->GetScene();
  scene->SetHeightScale(2.0);
  scene->GetMaterial()->SetSubsurfaceDepth(60.0);

  // A warm, low sun, and a blue sky that shines into its shadows from all sides.
  vtkLight* sun = scene->AddSun(315.0, 28.0);
  sun->SetDiffuseColor(1.0, 0.8, 0.55);
  sun->SetIntensity(0.9);
  for (int azimuth = 0; azimuth < 360; azimuth += 45)
  {
    vtkLight* sky = scene->AddSun(azimuth, 45.0);
    sky->SetDiffuseColor(0.4, 0.6, 1.0);
    sky->SetIntensity(0.025);
  }

  vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputConnection(shading->GetOutputPort());
  vtkNew<vtkImageSlice> slice;
  slice->SetMapper(mapper);
  slice->GetProperty()->SetInterpolationTypeToCubic();

  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(slice);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(850, 900);
  window->SetWindowName("ShadeTerrain");
  window->AddRenderer(renderer);

  // Fill the window with the image.
  const double* bounds = slice->GetBounds();
  renderer->ResetCamera();
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetParallelScale((bounds[3] - bounds[2]) / 2.0);
  return ShowOrWrite(window, argc > 2 ? argv[2] : nullptr);
}

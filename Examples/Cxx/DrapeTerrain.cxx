// SPDX-License-Identifier: BSD-3-Clause
// Shades a digital elevation model and drapes the result over the terrain itself.
//
//   DrapeTerrain Examples/Data/jacksboro.tif [picture.png]
#include "ShowOrWrite.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkImageDataGeometryFilter.h>
#include <vtkImageReliefShading.h>
#include <vtkLight.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkReliefMaterial.h>
#include <vtkReliefRasterReader.h>
#include <vtkReliefScene.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkTextureMapToPlane.h>
#include <vtkWarpScalar.h>

#include <iostream>

int main(int argc, char* argv[])
{
  if (argc < 2)
  {
    std::cerr << "Usage: " << argv[0] << " heights.tif [picture.png]\n";
    return EXIT_FAILURE;
  }
  const double exaggeration = 2.5;

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
  scene->SetHeightScale(exaggeration);
  scene->GetMaterial()->SetSubsurfaceDepth(90.0);

  // A warm, low sun, and a blue sky that shines into its shadows from all sides.
  vtkLight* sun = scene->AddSun(295.0, 20.0);
  sun->SetDiffuseColor(1.0, 0.72, 0.42);
  for (int azimuth = 0; azimuth < 360; azimuth += 45)
  {
    vtkLight* sky = scene->AddSun(azimuth, 45.0);
    sky->SetDiffuseColor(0.4, 0.6, 1.0);
    sky->SetIntensity(0.025);
  }

  vtkNew<vtkImageDataGeometryFilter> grid;
  grid->SetInputConnection(heights->GetOutputPort());
  vtkNew<vtkWarpScalar> warp;
  warp->SetInputConnection(grid->GetOutputPort());
  warp->SetScaleFactor(exaggeration);

  // A texture runs from the outer edge of its first texel to that of its last one, half a sample
  // beyond the image's bounds. The plane is set so that each texel's centre falls on its sample.
  const double* bounds = heights->GetOutput()->GetBounds();
  const double* spacing = heights->GetOutput()->GetSpacing();
  const double west = bounds[0] - spacing[0] / 2.0, east = bounds[1] + spacing[0] / 2.0;
  const double south = bounds[2] - spacing[1] / 2.0, north = bounds[3] + spacing[1] / 2.0;
  vtkNew<vtkTextureMapToPlane> coordinates;
  coordinates->SetInputConnection(warp->GetOutputPort());
  coordinates->SetOrigin(west, south, 0.0);
  coordinates->SetPoint1(east, south, 0.0);
  coordinates->SetPoint2(west, north, 0.0);

  vtkNew<vtkTexture> texture;
  texture->SetInputConnection(shading->GetOutputPort());
  texture->SetColorModeToDirectScalars();
  texture->InterpolateOn();
  texture->MipmapOn();

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(coordinates->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> terrain;
  terrain->SetMapper(mapper);
  terrain->SetTexture(texture);
  terrain->GetProperty()->LightingOff(); // the texture is lit already

  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(terrain);
  renderer->GradientBackgroundOn();
  renderer->SetBackground(1.0, 0.82, 0.6);
  renderer->SetBackground2(0.6, 0.7, 0.84);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(17000.0, -8000.0, 8500.0);
  camera->SetFocalPoint(15200.0, 14000.0, 200.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCameraClippingRange();

  vtkNew<vtkRenderWindow> window;
  window->SetSize(900, 600);
  window->SetWindowName("DrapeTerrain");
  window->AddRenderer(renderer);
  return ShowOrWrite(window, argc > 2 ? argv[2] : nullptr);
}

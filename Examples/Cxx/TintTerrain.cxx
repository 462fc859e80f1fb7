// SPDX-License-Identifier: BSD-3-Clause
// Tints a digital elevation model by height, as maps do, and shades it.
//
//   TintTerrain Examples/Data/jacksboro.tif [picture.png]
#include "ShowOrWrite.h"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkErrorCode.h>
#include <vtkImageProperty.h>
#include <vtkImageReliefShading.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkReliefEnvironment.h>
#include <vtkReliefMaterial.h>
#include <vtkReliefRasterReader.h>
#include <vtkReliefScene.h>
#include <vtkRenderer.h>

#include <iostream>

// Height in metres and the colour there, as it is to look on the screen: green lowland, yellow
// hills, brown ridges, light summits.
const struct
{
  double height, red, green, blue;
} Tints[] = {
  { 230.0, 0.38, 0.55, 0.47 },
  { 290.0, 0.55, 0.69, 0.51 },
  { 350.0, 0.77, 0.80, 0.57 },
  { 450.0, 0.92, 0.83, 0.58 },
  { 600.0, 0.85, 0.67, 0.46 },
  { 780.0, 0.68, 0.49, 0.37 },
  { 920.0, 0.67, 0.58, 0.54 },
  { 1070.0, 0.97, 0.96, 0.95 },
};

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

  vtkNew<vtkColorTransferFunction> tints;
  for (const auto& tint : Tints)
  {
    tints->AddRGBPoint(tint.height, tint.red, tint.green, tint.blue);
  }

  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputConnection(heights->GetOutputPort());
  shading->SetLookupTable(tints); // of the file's own heights, whatever the height scale
  shading->SetOutputScalarTypeToUnsignedChar(); // sRGB, as a screen expects

  vtkReliefScene* scene = shading->GetScene();
  scene->SetHeightScale(2.5);
  scene->GetMaterial()->SetSubsurfaceDepth(80.0);
  scene->SetLightsToSunAndSky(315.0, 28.0);
  // A little brighter, so that level ground shows its tint as the table has it.
  vtkLight::SafeDownCast(scene->GetLights()->GetItemAsObject(0))->SetIntensity(1.15);
  scene->GetEnvironment()->SetIntensity(0.45);

  vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputConnection(shading->GetOutputPort());
  vtkNew<vtkImageSlice> slice;
  slice->SetMapper(mapper);
  slice->GetProperty()->SetInterpolationTypeToCubic();

  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(slice);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(850, 900);
  window->SetWindowName("TintTerrain");
  window->AddRenderer(renderer);

  // Fill the window with the image.
  const double* bounds = slice->GetBounds();
  renderer->ResetCamera();
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetParallelScale((bounds[3] - bounds[2]) / 2.0);
  return ShowOrWrite(window, argc > 2 ? argv[2] : nullptr);
}

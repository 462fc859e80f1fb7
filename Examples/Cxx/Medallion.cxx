// SPDX-License-Identifier: BSD-3-Clause
// Shades a bas-relief of bronze under a point light.
//
//   Medallion [picture.png]
#include "MedallionHeights.h"
#include "ShowOrWrite.h"

#include <vtkCamera.h>
#include <vtkImageReliefShading.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkLight.h>
#include <vtkReliefMaterial.h>
#include <vtkReliefScene.h>
#include <vtkRenderer.h>

int main(int argc, char* argv[])
{
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(medallion::MakeHeights());
  shading->SetOutputScalarTypeToUnsignedChar(); // sRGB, as a screen expects

  // Light enters metal hardly at all: a small depth, and highlights of the metal's own colour.
  vtkReliefScene* scene = shading->GetScene();
  vtkReliefMaterial* bronze = scene->GetMaterial();
  bronze->SetSubsurfaceDepth(0.004);
  bronze->SetBaseColor(0.01, 0.01, 0.012);
  bronze->SetDiffuseColor(0.42, 0.23, 0.1);
  bronze->SetSpecularColor(1.0, 0.75, 0.4);
  bronze->SetSpecularCoefficient(0.45);
  bronze->SetSpecularPower(8.0);

  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(-1.2, 1.4, 1.4);
  lamp->SetDiffuseColor(1.0, 0.9, 0.75);
  lamp->SetIntensity(1.3);
  scene->AddLight(lamp);

  vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputConnection(shading->GetOutputPort());
  vtkNew<vtkImageSlice> slice;
  slice->SetMapper(mapper);

  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(slice);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(900, 900);
  window->SetWindowName("Medallion");
  window->AddRenderer(renderer);

  // Fill the window with the image.
  const double* bounds = slice->GetBounds();
  renderer->ResetCamera();
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetParallelScale((bounds[3] - bounds[2]) / 2.0);
  return ShowOrWrite(window, argc > 1 ? argv[1] : nullptr);
}

// SPDX-License-Identifier: BSD-3-Clause
// Shades a translucent bas-relief, a roundel of alabaster in front of a lamp.
//
//   BacklitMedallion [picture.png]
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
  shading->SetInputData(medallion::MakeHeights(0.1));
  shading->SetOutputScalarTypeToUnsignedChar(); // sRGB, as a screen expects

  // The floor is the back of the slab. Light from behind it comes through where the slab is thin,
  // and is scattered forward, most of it straight on.
  vtkReliefScene* scene = shading->GetScene();
  vtkReliefMaterial* alabaster = scene->GetMaterial();
  alabaster->UseFloorOn();
  alabaster->SetFloorHeight(-0.01);
  alabaster->SetSubsurfaceDepth(0.015);
  alabaster->SetOffsetModeToSurfaceNormal();
  alabaster->SetAttenuationToExponential();
  alabaster->SetDensity(28.0);
  alabaster->SetForwardScatterCoefficient(0.6);
  alabaster->SetForwardScatterPower(2.0);
  alabaster->SetDiffuseColor(1.0, 0.42, 0.12);
  alabaster->SetSpecularCoefficient(0.06);
  alabaster->SetSpecularPower(10.0);

  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(0.1, -0.2, -0.7);
  lamp->SetDiffuseColor(1.0, 0.8, 0.55);
  lamp->SetIntensity(7.0);
  scene->AddLight(lamp);

  // Faint daylight from the front gives the dark parts their shape.
  vtkNew<vtkLight> daylight;
  daylight->PositionalOn();
  daylight->SetPosition(-1.2, 1.4, 0.9);
  daylight->SetDiffuseColor(0.7, 0.85, 1.0);
  daylight->SetIntensity(0.4);
  scene->AddLight(daylight);

  // The lamp's intensity also multiplies the error that the illumination may have.
  scene->SetTolerance(0.0002);

  vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputConnection(shading->GetOutputPort());
  vtkNew<vtkImageSlice> slice;
  slice->SetMapper(mapper);

  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(slice);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(900, 900);
  window->SetWindowName("BacklitMedallion");
  window->AddRenderer(renderer);

  // Fill the window with the image.
  const double* bounds = slice->GetBounds();
  renderer->ResetCamera();
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetParallelScale((bounds[3] - bounds[2]) / 2.0);
  return ShowOrWrite(window, argc > 1 ? argv[1] : nullptr);
}

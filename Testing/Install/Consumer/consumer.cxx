// SPDX-License-Identifier: BSD-3-Clause
// Uses the installed headers and library: shades level ground of 3 x 3 samples.
#include <vtkImageData.h>
#include <vtkImageReliefShading.h>
#include <vtkNew.h>
#include <vtkReliefScene.h>

#include <algorithm>
#include <cmath>
#include <iostream>

int main()
{
  vtkNew<vtkImageData> heights;
  heights->SetDimensions(3, 3, 1);
  heights->AllocateScalars(VTK_FLOAT, 1);
  float* values = static_cast<float*>(heights->GetScalarPointer());
  std::fill(values, values + 9, 7.0f);

  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(heights);
  shading->GetScene()->AddSun(90.0, 30.0);
  shading->GetScene()->SetTolerance(0.0);
  shading->Update();

  // Level ground is lit by d = t / r = sin(altitude).
  const double middle = shading->GetOutput()->GetScalarComponentAsDouble(1, 1, 0, 0);
  if (!(std::abs(middle - 0.5) < 1e-5))
  {
    std::cerr << "The middle sample is " << middle << ", 0.5 is expected\n";
    return 1;
  }
  return 0;
}

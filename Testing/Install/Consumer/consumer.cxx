// SPDX-License-Identifier: BSD-3-Clause
// Uses the installed headers and libraries: shades level ground of 3 x 3 samples, and makes an
// object of each other component that is there.
#include <vtkImageData.h>
#include <vtkImageReliefShading.h>
#include <vtkNew.h>
#include <vtkReliefScene.h>
#ifdef HAVE_Rendering
#include <vtkReliefImageMapper.h>
#endif
#ifdef HAVE_Interaction
#include <vtkReliefLightWidget.h>
#endif
#ifdef HAVE_Raster
#include <vtkReliefRasterReader.h>
#endif
#ifdef HAVE_IO
#include <vtkImageReader2Collection.h>
#include <vtkImageReader2Factory.h>
#include <vtkOpenImageIOReader.h>
#include <vtkReliefSceneFile.h>
#endif

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

#ifdef HAVE_Rendering
  // The factory must know the implementation.
  vtkNew<vtkReliefImageMapper> mapper;
  if (!mapper->IsA("vtkOpenGLReliefImageMapper"))
  {
    std::cerr << "vtkReliefImageMapper has become a " << mapper->GetClassName() << "\n";
    return 1;
  }
#endif
#ifdef HAVE_Interaction
  vtkNew<vtkReliefLightWidget> widget;
#endif
#ifdef HAVE_Raster
  vtkNew<vtkReliefRasterReader> reader;
  if (reader->CanReadFile("nothing.tif"))
  {
    std::cerr << "A raster that is not there can be read\n";
    return 1;
  }
#endif
#ifdef HAVE_IO
  vtkNew<vtkReliefSceneFile> file;
  file->SetScene(shading->GetScene());
  if (file->ToText().find("\"azimuth\": 90") == std::string::npos)
  {
    std::cerr << "The scene as text is " << file->ToText() << "\n";
    return 1;
  }
  // A shared library says so itself, and twice counts once.
  vtkOpenImageIOReader::RegisterWithFactory();
  vtkNew<vtkImageReader2Collection> readers;
  vtkImageReader2Factory::GetRegisteredReaders(readers);
  int found = 0;
  for (int i = 0; i < readers->GetNumberOfItems(); ++i)
  {
    found += readers->GetItemAsObject(i)->IsA("vtkOpenImageIOReader") ? 1 : 0;
  }
  if (found != 1)
  {
    std::cerr << "vtkImageReader2Factory knows the reader " << found << " times\n";
    return 1;
  }
#endif
  return 0;
}

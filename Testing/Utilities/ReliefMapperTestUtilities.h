// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefMapperTestUtilities_h
#define ReliefMapperTestUtilities_h

#include "ReliefOpenGLTestUtilities.h"
#include "ReliefTestUtilities.h"

#include "vtkCamera.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkOpenGLReliefImageMapper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

/// Both devices that rays are traced by.
constexpr int TracingDevices[] = { vtkReliefImageMapper::TraceOnGraphicsProcessor,
  vtkReliefImageMapper::TraceOnProcessor };

/// A mapper in a window, one pixel for each sample of an image.
struct MapperStage
{
  vtkSmartPointer<vtkOpenGLReliefImageMapper> mapper;
  vtkNew<vtkImageSlice> slice;
  vtkNew<vtkRenderer> renderer;
  vtkSmartPointer<vtkOpenGLRenderWindow> window;

  explicit MapperStage(vtkImageData* heights)
  {
    auto base = vtkSmartPointer<vtkReliefImageMapper>::New();
    this->mapper = vtkOpenGLReliefImageMapper::SafeDownCast(base);
    vtkSmartPointer<vtkRenderWindow> any = vtkSmartPointer<vtkRenderWindow>::New();
    this->window = vtkOpenGLRenderWindow::SafeDownCast(any);
    this->mapper->SetInputData(heights);
    this->mapper->BorderOn();
    this->slice->SetMapper(this->mapper);
    this->slice->GetProperty()->SetInterpolationTypeToNearest();
    this->renderer->AddViewProp(this->slice);
    this->window->OffScreenRenderingOn();
    this->window->SetMultiSamples(0);
    this->window->SetSize(heights->GetDimensions()[0], heights->GetDimensions()[1]);
    this->window->AddRenderer(this->renderer);
    WatchOpenGL(this->window);
    this->LookAtAll();
  }

  /// Puts a camera straight above the image.
  void LookAtAll()
  {
    const double* bounds = this->slice->GetBounds();
    const double center[3] = { (bounds[0] + bounds[1]) / 2.0, (bounds[2] + bounds[3]) / 2.0,
      (bounds[4] + bounds[5]) / 2.0 };
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(center);
    camera->SetPosition(center[0], center[1], center[2] + 100.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetParallelScale((bounds[3] - bounds[2]) / 2.0);
    camera->SetClippingRange(1.0, 1000.0);
  }

  vtkReliefScene* Scene() { return this->mapper->GetScene(); }

  /// Renders; false if OpenGL had something to complain of.
  bool Render()
  {
    const int before = OpenGLComplaints();
    this->window->Render();
    return OpenGLComplaints() == before;
  }

  /// The linear colours that were shaded.
  vtkSmartPointer<vtkImageData> Shading()
  {
    auto image = vtkSmartPointer<vtkImageData>::New();
    this->mapper->GetShading(this->renderer, image);
    return image;
  }

  /// The picture on the screen, RGB.
  vtkSmartPointer<vtkUnsignedCharArray> Pixels()
  {
    auto pixels = vtkSmartPointer<vtkUnsignedCharArray>::New();
    const int* size = this->window->GetSize();
    this->window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels.Get(), 0);
    return pixels;
  }
};

/// How far the mapper's linear colours are from the filter's.
struct Agreement
{
  double largest = VTK_DOUBLE_MAX;
  double shareBeyond = 1.0; ///< of samples that differ by more than a bound
  double mean = 0.0;        ///< of the filter's colours
};

inline Agreement CompareColors(vtkImageData* expected, vtkImageData* given, double bound)
{
  Agreement result;
  const int* size = expected->GetDimensions();
  if (!std::equal(size, size + 3, given->GetDimensions()))
  {
    std::cout << "The picture has " << given->GetDimensions()[0] << " x "
              << given->GetDimensions()[1] << " texels, " << size[0] << " x " << size[1]
              << " are expected" << std::endl;
    return result;
  }
  vtkDataArray* a = expected->GetPointData()->GetScalars();
  vtkDataArray* b = given->GetPointData()->GetScalars();
  result.largest = 0.0;
  vtkIdType beyond = 0;
  for (vtkIdType at = 0; at < a->GetNumberOfTuples(); ++at)
  {
    double largest = 0.0;
    for (int c = 0; c < 4; ++c)
    {
      const double difference = std::abs(a->GetComponent(at, c) - b->GetComponent(at, c));
      largest = difference <= largest ? largest : difference; // NaN too
      result.mean += c < 3 ? a->GetComponent(at, c) / 3.0 : 0.0;
    }
    beyond += largest <= bound ? 0 : 1;
    result.largest = largest <= result.largest ? result.largest : largest;
  }
  result.mean /= static_cast<double>(a->GetNumberOfTuples());
  result.shareBeyond = static_cast<double>(beyond) / static_cast<double>(a->GetNumberOfTuples());
  return result;
}

#endif

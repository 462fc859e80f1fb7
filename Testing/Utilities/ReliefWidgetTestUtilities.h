// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefWidgetTestUtilities_h
#define ReliefWidgetTestUtilities_h

#include "ReliefOpenGLTestUtilities.h"
#include "ReliefTestUtilities.h"

#include "vtkCamera.h"
#include "vtkGenericRenderWindowInteractor.h"
#include "vtkImageReliefShading.h"
#include "vtkImageSlice.h"
#include "vtkImageSliceMapper.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkReliefLightRepresentation.h"
#include "vtkReliefLightWidget.h"
#include "vtkReliefScene.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <array>

/// A window of two pixels for each sample that shows a shaded relief from above, and a widget for
/// its first light.
class WidgetStage
{
public:
  explicit WidgetStage(vtkImageData* heights)
  {
    this->Shading->SetInputData(heights);
    this->Shading->SetOutputScalarTypeToUnsignedChar();
    this->Mapper->SetInputConnection(this->Shading->GetOutputPort());
    this->Slice->SetMapper(this->Mapper);
    this->Renderer->AddViewProp(this->Slice);
    this->Renderer->SetBackground(0.0, 0.0, 0.4);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(2 * heights->GetDimensions()[0], 2 * heights->GetDimensions()[1]);
    this->Window->AddRenderer(this->Renderer);
    WatchOpenGL(this->Window);
    this->Interactor->SetRenderWindow(this->Window);
    this->Interactor->SetInteractorStyle(this->Style);
    this->Interactor->Initialize();
    this->Renderer->ResetCamera(heights->GetBounds());
    this->Renderer->GetActiveCamera()->ParallelProjectionOn();
    this->Renderer->GetActiveCamera()->SetParallelScale(
      0.5 * heights->GetDimensions()[1] * std::abs(heights->GetSpacing()[1]));
    this->Widget->SetInteractor(this->Interactor);
    this->Dot()->SetScene(this->Scene());
    this->Dot()->PlaceWidget(heights);
  }

  ~WidgetStage() { this->Window->SetInteractor(nullptr); } // they hold one another
  WidgetStage(const WidgetStage&) = delete;
  void operator=(const WidgetStage&) = delete;

  vtkReliefScene* Scene() { return this->Shading->GetScene(); }
  vtkReliefLightRepresentation* Dot() { return this->Widget->GetLightRepresentation(); }
  vtkCamera* Camera() { return this->Renderer->GetActiveCamera(); }

  /// Where the dot is in the window; not finite if there is none.
  std::array<double, 2> DotInWindow()
  {
    double at[3];
    if (!this->Dot()->GetDotPosition(at))
    {
      return { NAN, NAN };
    }
    this->Renderer->SetWorldPoint(at[0], at[1], at[2], 1.0);
    this->Renderer->WorldToDisplay();
    return { this->Renderer->GetDisplayPoint()[0], this->Renderer->GetDisplayPoint()[1] };
  }

  /// An event of the mouse or of a key.
  void Event(unsigned long event, double x, double y, bool shift = false, int repeat = 0,
    const char* key = nullptr)
  {
    this->Interactor->SetEventInformation(
      static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), 0, shift, 0, repeat, key);
    this->Interactor->InvokeEvent(event, nullptr);
  }

  std::array<int, 3> Pixel(double x, double y)
  {
    vtkNew<vtkUnsignedCharArray> color;
    const int i = static_cast<int>(x);
    const int j = static_cast<int>(y);
    this->Window->Render();
    this->Window->GetPixelData(i, j, i, j, 0, color);
    return { color->GetValue(0), color->GetValue(1), color->GetValue(2) };
  }

  vtkNew<vtkImageReliefShading> Shading;
  vtkNew<vtkImageSliceMapper> Mapper;
  vtkNew<vtkImageSlice> Slice;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkSmartPointer<vtkRenderWindowInteractor> Interactor =
    vtkSmartPointer<vtkGenericRenderWindowInteractor>::New();
  vtkNew<vtkInteractorStyleTrackballCamera> Style;
  vtkNew<vtkReliefLightWidget> Widget;
};

#endif

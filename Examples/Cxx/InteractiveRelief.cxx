// SPDX-License-Identifier: BSD-3-Clause
// Shades a digital elevation model on the graphics processor, under a lamp that you drag.
//
//   InteractiveRelief Examples/Data/jacksboro.tif [picture.png]
//
// Drag with the left button to move the lamp, turn the wheel to lift or lower it. With a picture, a
// drag is played and its result written.
#include "ShowOrWrite.h"

#include <vtkCamera.h>
#include <vtkCellPicker.h>
#include <vtkErrorCode.h>
#include <vtkImageSlice.h>
#include <vtkInteractorStyleUser.h>
#include <vtkLight.h>
#include <vtkObjectFactory.h>
#include <vtkReliefImageMapper.h>
#include <vtkReliefMaterial.h>
#include <vtkReliefRasterReader.h>
#include <vtkReliefScene.h>
#include <vtkRenderer.h>

#include <iostream>

// Moves a light to where the mouse is.
class DragLamp : public vtkInteractorStyleUser
{
public:
  static DragLamp* New();
  vtkTypeMacro(DragLamp, vtkInteractorStyleUser);

  vtkLight* Lamp = nullptr;
  vtkRenderer* Renderer = nullptr;

  void OnMouseMove() override
  {
    const int* at = this->Interactor->GetEventPosition();
    if (this->Dragging && this->Picker->Pick(at[0], at[1], 0.0, this->Renderer))
    {
      const double* position = this->Picker->GetPickPosition();
      this->Lamp->SetPosition(position[0], position[1], this->Lamp->GetPosition()[2]);
      this->Interactor->Render();
    }
  }
  void OnLeftButtonDown() override { this->Hold(true); }
  void OnLeftButtonUp() override { this->Hold(false); }
  void OnMouseWheelForward() override { this->Lift(1.1); }
  void OnMouseWheelBackward() override { this->Lift(1.0 / 1.1); }

private:
  // While the button is held, the mapper gives up detail for a steady frame rate.
  void Hold(bool down)
  {
    this->Dragging = down;
    this->Interactor->GetRenderWindow()->SetDesiredUpdateRate(down ? 15.0 : 0.0001);
    this->OnMouseMove();
    this->Interactor->Render();
  }

  void Lift(double factor)
  {
    const double* position = this->Lamp->GetPosition();
    this->Lamp->SetPosition(position[0], position[1], position[2] * factor);
    this->Interactor->Render();
  }

  vtkNew<vtkCellPicker> Picker;
  bool Dragging = false;
};
vtkStandardNewMacro(DragLamp);

int main(int argc, char* argv[])
{
  if (argc < 2)
  {
    std::cerr << "Usage: " << argv[0] << " heights.tif [picture.png]\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkReliefRasterReader> heights;
  heights->SetFileName(argv[1]);
  heights->Update();
  if (heights->GetErrorCode() != vtkErrorCode::NoError)
  {
    return EXIT_FAILURE; // the reader has said why
  }

  vtkNew<vtkReliefImageMapper> mapper;
  mapper->SetInputConnection(heights->GetOutputPort());
  vtkNew<vtkImageSlice> image;
  image->SetMapper(mapper);

  vtkReliefScene* scene = mapper->GetScene();
  scene->SetHeightScale(2.0);
  scene->GetMaterial()->SetSubsurfaceDepth(120.0);
  scene->GetMaterial()->SetDiffuseColor(1.0, 0.9, 0.75);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(8000.0, 20000.0, 5000.0);
  scene->AddLight(lamp);

  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(image);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(850, 900);
  window->SetWindowName("InteractiveRelief");
  window->AddRenderer(renderer);

  // Fill the window with the image.
  const double* bounds = image->GetBounds();
  const double half = (bounds[3] - bounds[2]) / 2.0;
  renderer->ResetCamera();
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetParallelScale(half);

  vtkNew<DragLamp> style;
  style->Lamp = lamp;
  style->Renderer = renderer;
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  interactor->SetInteractorStyle(style);
  if (argc < 3)
  {
    window->Render();
    interactor->Start();
    return EXIT_SUCCESS;
  }

  window->OffScreenRenderingOn();
  mapper->ProgressiveOff();
  interactor->Initialize();
  auto play = [&](unsigned long event, int x, int y)
  {
    interactor->SetEventInformation(x, y);
    interactor->InvokeEvent(event);
  };
  play(vtkCommand::LeftButtonPressEvent, 200, 200);
  play(vtkCommand::MouseMoveEvent, 400, 400);
  play(vtkCommand::MouseMoveEvent, 560, 610);
  play(vtkCommand::LeftButtonReleaseEvent, 560, 610);
  play(vtkCommand::MouseWheelBackwardEvent, 560, 610);
  return ShowOrWrite(window, argv[2]);
}

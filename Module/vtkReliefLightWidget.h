// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefLightWidget
 * @brief   drag the light over the picture of a relief
 *
 * The light is a dot on the picture, see vtkReliefLightRepresentation. Moving it edits the
 * vtkLight of a vtkReliefScene and nothing else; whatever shows the relief (vtkImageReliefShading,
 * vtkReliefImageMapper) follows, as it does for every change of the scene.
 *
 * On the dot:
 *
 *  - drag, left button: moves the light in the plane;
 *  - shift-drag up or down: raises or lowers it;
 *  - wheel: raises (forward) or lowers it. Away from the dot the wheel is the camera's;
 *  - double-click: switches between lamp and sun;
 *  - arrow keys: move the dot by one pixel, with shift by ten;
 *  - escape, while dragging: puts the light back.
 *
 * As with all widgets, the key i switches this one on and off (KeyPressActivation), and
 * GetEventTranslator() changes what mouse and keys do. The widget events are Select and EndSelect,
 * Move, Scale (the shift-drag), Up and Down (the wheel), ModifyEvent (the double-click), Translate
 * (the arrow keys) and Reset (escape).
 *
 * Each of these invokes vtkCommand::StartInteractionEvent, then InteractionEvent once or more, when
 * the light has changed and before it is shown, then EndInteractionEvent; a drag stays between the
 * first and the last as long as the button is down. If the widget is switched off, or the light
 * taken out of the scene, in the middle of a drag, then the drag ends there.
 *
 * Several lights have a widget each:
 *
 *     vtkNew<vtkReliefLightWidget> widget;
 *     widget->SetInteractor(interactor);
 *     widget->GetLightRepresentation()->SetScene(shading->GetScene());
 *     widget->GetLightRepresentation()->PlaceWidget(heights);
 *     widget->On();
 *
 * @sa vtkReliefLightRepresentation vtkReliefScene
 */
#ifndef vtkReliefLightWidget_h
#define vtkReliefLightWidget_h

#include "vtkAbstractWidget.h"
#include "vtkReliefShadingModule.h" // For export macro

class vtkReliefLightRepresentation;

class VTKRELIEFSHADING_EXPORT vtkReliefLightWidget : public vtkAbstractWidget
{
public:
  static vtkReliefLightWidget* New();
  vtkTypeMacro(vtkReliefLightWidget, vtkAbstractWidget);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The dot, which knows the scene and the light. Default: a new one.
   */
  void SetRepresentation(vtkReliefLightRepresentation* representation);
  vtkReliefLightRepresentation* GetLightRepresentation();
  void CreateDefaultRepresentation() override;
  ///@}

  ///@{
  /**
   * Switching off, or no longer listening, ends a drag.
   */
  void SetEnabled(int enabling) override;
  void SetProcessEvents(vtkTypeBool process) override;
  ///@}

  /**
   * Whether the light is being dragged.
   */
  vtkGetMacro(Dragging, bool);

protected:
  vtkReliefLightWidget();
  ~vtkReliefLightWidget() override;

  void SetCursor(int state) override;

  static void SelectAction(vtkAbstractWidget* widget);
  static void ScaleAction(vtkAbstractWidget* widget);
  static void MoveAction(vtkAbstractWidget* widget);
  static void EndSelectAction(vtkAbstractWidget* widget);
  static void UpAction(vtkAbstractWidget* widget);
  static void DownAction(vtkAbstractWidget* widget);
  static void TranslateAction(vtkAbstractWidget* widget);
  static void ModifyAction(vtkAbstractWidget* widget);
  static void ResetAction(vtkAbstractWidget* widget);

  bool Dragging = false;

private:
  vtkReliefLightWidget(const vtkReliefLightWidget&) = delete;
  void operator=(const vtkReliefLightWidget&) = delete;

  bool IsOverDot();
  bool Hover();
  void StartDrag(int state);
  void EndDrag();
  template <class Change>
  void ChangeAtOnce(const Change& change);
  void Raise(double steps);

  bool Hovering = false;
};

#endif

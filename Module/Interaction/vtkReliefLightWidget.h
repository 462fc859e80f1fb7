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
 *  - escape, while dragging: puts the light back.
 *
 * Keys are for the dot that has the key focus, else for the one under the mouse:
 *
 *  - tab and shift-tab: give the key focus to the next or the previous dot of the interactor, in
 *    the order in which their widgets were switched on;
 *  - arrow keys: move the dot by one pixel, with shift by ten;
 *  - page up and page down: raise and lower the light by a step, with shift by ten;
 *  - escape: takes the key focus away.
 *
 * A key that a widget has used does not reach the interactor's style; all others do, and so do all
 * with control or alt. As with all widgets, the key i switches this one on and off
 * (KeyPressActivation), and GetEventTranslator() changes what mouse and keys do. The widget events
 * are Select and EndSelect, Move, HoverLeave (the mouse leaves the window), Scale (the shift-drag),
 * Up and Down (the wheel), ModifyEvent (the double-click), Translate (arrows, page up and page
 * down), Right and Left (tab and shift-tab) and Reset (escape).
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
#include "vtkInteractionReliefShadingModule.h" // For export macro

class vtkReliefLightRepresentation;

class VTKINTERACTIONRELIEFSHADING_EXPORT vtkReliefLightWidget : public vtkAbstractWidget
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

  ///@{
  /**
   * Whether keys are for this dot, which looks then as if the mouse were over it. At most one of
   * an interactor's widgets has the key focus: it goes when another gets it, when the mouse comes
   * over another dot or is pressed beside this one, and with SetEnabled(0). Without effect on a
   * widget that is not enabled. A change invokes vtkCommand::SelectionChangedEvent. Default: off.
   */
  void SetKeyFocus(bool focus);
  vtkGetMacro(KeyFocus, bool);
  vtkBooleanMacro(KeyFocus, bool);
  ///@}

protected:
  vtkReliefLightWidget();
  ~vtkReliefLightWidget() override;

  void SetCursor(int state) override;

  static void SelectAction(vtkAbstractWidget* widget);
  static void ScaleAction(vtkAbstractWidget* widget);
  static void MoveAction(vtkAbstractWidget* widget);
  static void LeaveAction(vtkAbstractWidget* widget);
  static void EndSelectAction(vtkAbstractWidget* widget);
  static void UpAction(vtkAbstractWidget* widget);
  static void DownAction(vtkAbstractWidget* widget);
  static void TranslateAction(vtkAbstractWidget* widget);
  static void NextAction(vtkAbstractWidget* widget);
  static void PreviousAction(vtkAbstractWidget* widget);
  static void ModifyAction(vtkAbstractWidget* widget);
  static void ResetAction(vtkAbstractWidget* widget);

  bool Dragging = false;
  bool KeyFocus = false;

private:
  vtkReliefLightWidget(const vtkReliefLightWidget&) = delete;
  void operator=(const vtkReliefLightWidget&) = delete;

  bool IsOverDot();
  bool Hover();
  void SetHovering(bool over);
  void Highlight();
  void FocusNeighbor(int step);
  void Press(int state);
  void StartDrag(int state);
  void EndDrag();
  template <class Change>
  void ChangeAtOnce(const Change& change);
  void Raise(double steps);

  bool Hovering = false;
};

#endif

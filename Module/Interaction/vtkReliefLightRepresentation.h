// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefLightRepresentation
 * @brief   a light of a relief as a dot on its picture
 *
 * The dot lies in the plane of the picture (see Draped) and is as large under every camera. It is a
 * picture of the light itself: whatever changes the light moves the dot in the next frame.
 *
 *  - A lamp, a vtkLight that is Positional, is straight above or below its dot.
 *  - A sun has rays. Its dot is read like a compass about the middle of the relief: its direction
 * from there is the sun's azimuth, its distance the altitude. The zenith is in the middle, the
 * horizon on a circle, shown while the dot is under the mouse or is dragged, and altitudes between
 * are spaced evenly. Outside the circle, as far as twice its radius, a sun is below the horizon:
 * only where the material has a floor does the dot go there, for without one no light comes from
 * below.
 *
 * The dot has the light's colour, and is dark where the light is switched off. The light is the one
 * that SetLight names, else the first of the scene. There is no dot without such a light, for a
 * light whose numbers are not finite, or behind the camera. Until the renderer has a camera, which
 * it makes and resets in its first frame unless you set one, no dot is anywhere in the window.
 *
 * All coordinates are those of the scene's lights, that is those of the heights; SetProp tells
 * where the picture has been moved to.
 *
 * @sa vtkReliefLightWidget vtkReliefScene
 */
#ifndef vtkReliefLightRepresentation_h
#define vtkReliefLightRepresentation_h

#include "vtkInteractionReliefShadingModule.h" // For export macro
#include "vtkSmartPointer.h"                   // For vtkSmartPointer
#include "vtkWidgetRepresentation.h"

#include <memory> // For std::unique_ptr

class vtkImageData;
class vtkLight;
class vtkProp3D;
class vtkReliefScene;

class VTKINTERACTIONRELIEFSHADING_EXPORT vtkReliefLightRepresentation
  : public vtkWidgetRepresentation
{
public:
  static vtkReliefLightRepresentation* New();
  vtkTypeMacro(vtkReliefLightRepresentation, vtkWidgetRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene whose light is shown. Default: null, there is no dot.
   */
  void SetScene(vtkReliefScene* scene);
  vtkReliefScene* GetScene();
  ///@}

  ///@{
  /**
   * Which of the scene's lights is shown. Null takes the first. GetLight returns the light that is
   * shown: null while the scene lacks the one that was set, or has none at all. Default: null.
   */
  void SetLight(vtkLight* light);
  vtkLight* GetLight();
  ///@}

  ///@{
  /**
   * Where the relief is. Given the image of the heights: in the plane of the image, whatever its
   * direction, with heights about their mean (samples that are NaN or infinite do not count); call
   * it again when the image has changed. Given bounds: in a level plane in their middle. The
   * compass of suns is centred on the relief and fits its shorter side; PlaceFactor, here 1 by
   * default, makes it larger or smaller. An image that is empty or has no scalars is an error and
   * leaves the place as it is. Default: a square of side 1 about the origin.
   *
   * PlaceOnHeights is PlaceWidget for images alone: Python takes one that can be indexed, as
   * PyVista's can, for bounds.
   */
  void PlaceOnHeights(vtkImageData* heights);
  void PlaceWidget(vtkImageData* heights) { this->PlaceOnHeights(heights); }
  void PlaceWidget(double bounds[6]) override;
  ///@}

  ///@{
  /**
   * The mean of the heights, not yet scaled, which PlaceWidget sets. Set it afterwards where a
   * number in the image stands for no data. Default: 0.
   */
  vtkSetMacro(MeanHeight, double);
  vtkGetMacro(MeanHeight, double);
  ///@}

  ///@{
  /**
   * Whether the picture is draped over the relief in 3D. Then the dot lies at the mean height, else
   * in the plane of the image, where a vtkImageSlice shows it. From straight above, in parallel
   * projection, both look the same. Default: off.
   */
  vtkSetMacro(Draped, bool);
  vtkGetMacro(Draped, bool);
  vtkBooleanMacro(Draped, bool);
  ///@}

  ///@{
  /**
   * The prop that shows the picture; the dot goes where its position, orientation, scale and user
   * matrix take it. Default: null, the picture is where the heights are.
   */
  void SetProp(vtkProp3D* prop);
  vtkProp3D* GetProp();
  ///@}

  ///@{
  /**
   * The colour of the ring about the dot, and while the dot is under the mouse or is dragged. RGB
   * as shown, in [0, 1]: what is less or more is set to 0 or 1, NaN is refused. Default: white,
   * (1, 0.6, 0.1).
   */
  virtual void SetOutlineColor(double red, double green, double blue);
  virtual void SetOutlineColor(const double color[3])
  {
    this->SetOutlineColor(color[0], color[1], color[2]);
  }
  vtkGetVector3Macro(OutlineColor, double);
  virtual void SetSelectedOutlineColor(double red, double green, double blue);
  virtual void SetSelectedOutlineColor(const double color[3])
  {
    this->SetSelectedOutlineColor(color[0], color[1], color[2]);
  }
  vtkGetVector3Macro(SelectedOutlineColor, double);
  ///@}

  ///@{
  /**
   * Where the dot is, in world coordinates, as the picture is shown. Returns false if there is
   * none.
   */
  bool GetDotPosition(double position[3]);
  ///@}

  /**
   * Moves the light so that its dot is where the plane has that point in display coordinates. A
   * lamp keeps its height, and stays within ten times the size of the relief. A sun stops at the
   * horizon, or at the nadir if the material has a floor. Returns false, and changes nothing, if
   * there is no light, no camera yet, or no such point of the plane in front of it.
   */
  bool MoveDot(double displayX, double displayY);

  /**
   * The same by a number of pixels, from where the dot is.
   */
  bool ShiftDot(double pixelsX, double pixelsY);

  /**
   * Raises the light by steps, which may be fractions, or negative. A sun: one degree a step, in
   * [0, 90], or [-90, 90] if the material has a floor. A lamp: by a tenth of its height above the
   * mean of the relief, and less close to it, where it passes to the other side. Returns false if
   * there is no light.
   */
  bool RaiseLight(double steps);

  /**
   * Makes a lamp of a sun or a sun of a lamp. The light comes from the same direction in the middle
   * of the relief. The lamp is as far away as its dot can stay on the picture, so that the picture
   * changes little; one that has been a lamp before is as far as then. Returns false if there is no
   * light.
   */
  bool SwitchLightType();

  enum InteractionStateType
  {
    Outside = 0, ///< the mouse is elsewhere
    Nearby,      ///< it is over the dot
    Moving,      ///< the dot is dragged
    Raising      ///< the light is raised and lowered
  };

  ///@{
  /**
   * What vtkReliefLightWidget calls. HandleSize is the radius of the dot in pixels, 7 by default; a
   * few pixels more are Nearby.
   */
  int ComputeInteractionState(int X, int Y, int modify = 0) override;
  void StartWidgetInteraction(double eventPosition[2]) override;
  void WidgetInteraction(double eventPosition[2]) override;
  void EndWidgetInteraction(double eventPosition[2]) override;
  void Highlight(int highlight) override;
  void BuildRepresentation() override;
  void SetInteractionState(int state);
  ///@}

  /**
   * Puts the light back where it was at StartWidgetInteraction.
   */
  void CancelWidgetInteraction();

  ///@{
  /**
   * As a vtkProp.
   */
  void GetActors2D(vtkPropCollection* actors) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  int RenderOverlay(vtkViewport* viewport) override;
  void ShallowCopy(vtkProp* prop) override;
  ///@}

protected:
  vtkReliefLightRepresentation();
  ~vtkReliefLightRepresentation() override;

  vtkSmartPointer<vtkReliefScene> Scene;
  vtkSmartPointer<vtkLight> Light;
  vtkSmartPointer<vtkProp3D> Prop;
  bool Draped = false;
  double MeanHeight = 0.0;
  double OutlineColor[3] = { 1.0, 1.0, 1.0 };
  double SelectedOutlineColor[3] = { 1.0, 0.6, 0.1 };

private:
  vtkReliefLightRepresentation(const vtkReliefLightRepresentation&) = delete;
  void operator=(const vtkReliefLightRepresentation&) = delete;

  // What is private to the module: geometry and drawing.
  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefView_h
#define ReliefView_h

#include "EnvironmentTurn.h"

#include "vtkImageSlice.h"
#include "vtkNew.h"
#include "vtkReliefImageMapper.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <QTimer>
#include <QVTKOpenGLNativeWidget.h>

#include <memory>
#include <optional>
#include <vector>

class vtkReliefLightRepresentation;
class vtkReliefLightWidget;

namespace reliefviewer
{

class Document;

/// What the last frame did.
struct FrameReport
{
  double Seconds = 0.0;
  int LightsTraced = 0;
  bool Converged = false;
  /// Share of the work that is done, from 0 to 1.
  double Refinement = 0.0;
};

/// Shows a document's relief and a dot for each of its lights, to be dragged. Left or middle button
/// beside a dot moves the picture, the right one, or left with control, turns the environment about
/// the middle of the window, and the wheel zooms at the mouse. With the keyboard's focus, tab goes
/// from light to light, and keys move the selected one.
class ReliefView : public QVTKOpenGLNativeWidget
{
  Q_OBJECT

public:
  explicit ReliefView(Document* document, QWidget* parent = nullptr);
  ~ReliefView() override;

  /// The whole relief in the window.
  void Fit();
  /// One sample for each pixel of the screen.
  void ShowSamples();
  /// Magnifies about the middle of the window.
  void Zoom(double factor);
  /// A frame, soon: many changes at once make one.
  void Refresh();

  bool RefreshPending() const { return this->Pending.isActive(); }
  /// Where a point of the picture is in the widget.
  QPoint ToWidget(double x, double y) const;

  vtkReliefImageMapper* Mapper() const { return this->ImageMapper; }
  /// The dot of a light of the scene; null if there is no such light.
  vtkReliefLightRepresentation* Dot(int light) const;
  const FrameReport& LastFrame() const { return this->Frame; }
  /// Makes a lamp of the selected light, or a sun.
  void SwitchLightType();
  void ShowDots(bool on);
  /// Takes the keyboard's focus for the selected light.
  void TakeKeys();
  /// Whether keys move the selected light.
  bool HasKeys() const { return this->Keys; }

signals:
  void frameShown();
  /// Where the mouse is, in the frame of the heights; inside is false beside the window.
  void hovered(bool inside, double x, double y);
  /// The mouse has turned the environment to an angle, in degrees.
  void environmentTurned(double angle);

protected:
  void resizeEvent(QResizeEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  bool focusNextPrevChild(bool next) override;
  void leaveEvent(QEvent* event) override;

private:
  class Style;
  void TakeField();
  void TakeHeights();
  void TakeLights();
  void PlaceDot(vtkReliefLightRepresentation* dot);
  void HighlightSelected();
  void ZoomAt(double factor, double displayX, double displayY);
  void FrameBegins();
  void FrameEnds();
  void LightEvent(vtkObject* widget, unsigned long event, void*);
  void TurnTo(double displayX, double displayY);
  std::optional<double> AngleOf(double displayX, double displayY) const;

  Document* Shown;
  vtkNew<vtkReliefImageMapper> ImageMapper;
  vtkNew<vtkImageSlice> Slice;
  vtkNew<vtkRenderer> Renderer;
  std::vector<vtkSmartPointer<vtkReliefLightWidget>> Lights;
  QTimer Pending;
  FrameReport Frame;
  double FrameBegan = 0.0;
  bool Fitted = true;
  bool DotsShown = true;
  bool Keys = false;
  EnvironmentTurn Turn;
};

}

#endif

// SPDX-License-Identifier: BSD-3-Clause

// Lights by keys alone, and the environment by mouse.

#include "ViewerTest.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefScene.h"

#include <QAction>
#include <QDoubleSpinBox>
#include <QEvent>

#include <array>
#include <cmath>

using namespace reliefviewer;

class TestViewerKeys : public ViewerTest
{
  Q_OBJECT

private slots:
  void keysChooseAndMoveLights();
  void tabLeavesTheView();
  void keysOfTheMenu();
  void theMouseTakesTheKeysAway();
  void highlightGoesWithTheMouse();
  void environmentIsTurned_data();
  void environmentIsTurned();
  void escapeTurnsItBack();
  void nothingToTurn();
  void itGoesWhileItIsTurned();

private:
  using Place = std::array<double, 3>;
  static Place LightAt(const Window& window, int light);
  static double Turned(const Window& window)
  {
    return window->Opened()->Scene()->GetEnvironment()->GetRotationZ();
  }
  static void Send(const Window& window, QEvent::Type type, const QPoint& at,
    Qt::MouseButton button, Qt::KeyboardModifiers modifiers = Qt::NoModifier);
  static QPoint Around(const Window& window, double degrees);
  static void Focus(const Window& window);
};

//------------------------------------------------------------------------------
TestViewerKeys::Place TestViewerKeys::LightAt(const Window& window, int light)
{
  Place place;
  vtkLight::SafeDownCast(window->Opened()->Scene()->GetLights()->GetItemAsObject(light))
    ->GetPosition(place.data());
  return place;
}

//------------------------------------------------------------------------------
void TestViewerKeys::Send(const Window& window, QEvent::Type type, const QPoint& at,
  Qt::MouseButton button, Qt::KeyboardModifiers modifiers)
{
  QWidget* view = window->View();
  const bool moves = type == QEvent::MouseMove;
  const bool up = type == QEvent::MouseButtonRelease;
  QMouseEvent event(type, at, view->mapToGlobal(at), moves ? Qt::NoButton : button,
    up ? Qt::NoButton : button, modifiers);
  QApplication::sendEvent(view, &event);
  QApplication::processEvents();
}

//------------------------------------------------------------------------------
/// On a circle about the middle of the view, counter-clockwise from the right.
QPoint TestViewerKeys::Around(const Window& window, double degrees)
{
  const double angle = degrees * std::acos(-1.0) / 180.0;
  const QSize size = window->View()->size();
  return { static_cast<int>(std::lround(0.5 * size.width() + 140.0 * std::cos(angle))),
    static_cast<int>(std::lround(0.5 * size.height() - 140.0 * std::sin(angle))) };
}

//------------------------------------------------------------------------------
/// As tab gives it; there may be no window manager to make the window active.
void TestViewerKeys::Focus(const Window& window)
{
  QApplication::setActiveWindow(window.get());
  Find(window.get(), "lights")->setFocus();
  window->View()->setFocus(Qt::TabFocusReason);
  QVERIFY(window->View()->hasFocus());
}

//------------------------------------------------------------------------------
void TestViewerKeys::keysChooseAndMoveLights()
{
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "addLampAction");
  ReliefView* view = window->View();
  QImage before;
  COMPLETE_PICTURE(before, window);
  Focus(window);
  QCOMPARE(window->Opened()->SelectedLightIndex(), 0);
  QImage chosen;
  COMPLETE_PICTURE(chosen, window);
  QVERIFY(chosen != before); // it is seen
  const Place sun = LightAt(window, 0);
  const Place lamp = LightAt(window, 1);
  const QPoint dot = DotAt(window.get(), 0);
  const int steps = window->Opened()->Steps()->count();
  QTest::keyClick(view, Qt::Key_Right, Qt::ShiftModifier);
  QTest::keyClick(view, Qt::Key_Right, Qt::ShiftModifier);
  QVERIFY(std::abs(DotAt(window.get(), 0).x() - dot.x() - 20) <= 1);
  QCOMPARE(LightAt(window, 1), lamp);
  QCOMPARE(window->Opened()->Steps()->count(), steps + 1);
  auto* altitude = Find(window.get(), "sunAltitude")->findChild<QDoubleSpinBox*>();
  const double high = altitude->value();
  QTest::keyClick(view, Qt::Key_PageUp);
  QVERIFY(std::abs(altitude->value() - high - 1.0) < 1e-6);
  QTest::keyClick(view, Qt::Key_PageDown, Qt::ShiftModifier);
  QVERIFY(std::abs(altitude->value() - high + 9.0) < 1e-6);
  // The next light, and back.
  const Place moved = LightAt(window, 0);
  QTest::keyClick(view, Qt::Key_Tab);
  QVERIFY(view->hasFocus());
  QCOMPARE(window->Opened()->SelectedLightIndex(), 1);
  QTest::keyClick(view, Qt::Key_Up);
  QVERIFY(LightAt(window, 1) != lamp);
  QCOMPARE(LightAt(window, 0), moved);
  QTest::keyClick(view, Qt::Key_Backtab, Qt::ShiftModifier);
  QCOMPARE(window->Opened()->SelectedLightIndex(), 0);
  QTest::keyClick(view, Qt::Key_Up);
  QVERIFY(LightAt(window, 0) != moved);
  while (window->Opened()->Steps()->index() > steps)
  {
    Trigger(window.get(), "undo");
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    QVERIFY(std::abs(LightAt(window, 0)[axis] - sun[axis]) < 1e-9);
  }
  // Escape gives the light back to the mouse.
  QTest::keyClick(view, Qt::Key_Escape);
  QVERIFY(!view->HasKeys());
  QTest::keyClick(view, Qt::Key_Up);
  for (int axis = 0; axis < 3; ++axis)
  {
    QVERIFY(std::abs(LightAt(window, 0)[axis] - sun[axis]) < 1e-9);
  }
}

//------------------------------------------------------------------------------
// Behind the last light comes what is beside the view: nobody is caught in it.
void TestViewerKeys::tabLeavesTheView()
{
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "addLampAction");
  Focus(window);
  QImage chosen;
  COMPLETE_PICTURE(chosen, window);
  QTest::keyClick(window->View(), Qt::Key_Tab);
  QVERIFY(window->View()->hasFocus());
  QTest::keyClick(window->View(), Qt::Key_Tab);
  QVERIFY(!window->View()->hasFocus());
  QVERIFY(!window->View()->HasKeys());
  QImage left;
  COMPLETE_PICTURE(left, window);
  QVERIFY(left != chosen);
  // Left to the mouse, it goes through them as well.
  QTest::mouseClick(window->View(), Qt::LeftButton, Qt::NoModifier, QPoint(4, 4));
  window->View()->setFocus();
  QVERIFY(!window->View()->HasKeys());
  QTest::keyClick(window->View(), Qt::Key_Backtab, Qt::ShiftModifier);
  QVERIFY(window->View()->HasKeys());
  QCOMPARE(window->Opened()->SelectedLightIndex(), 1);
  // Without dots there is nothing to go through.
  Trigger(window.get(), "showLights");
  Focus(window);
  QTest::keyClick(window->View(), Qt::Key_Tab);
  QVERIFY(!window->View()->hasFocus());
}

//------------------------------------------------------------------------------
void TestViewerKeys::keysOfTheMenu()
{
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "addLampAction");
  QApplication::setActiveWindow(window.get());
  Find(window.get(), "lights")->setFocus();
  Trigger(window.get(), "nextLight");
  QCOMPARE(window->Opened()->SelectedLightIndex(), 0);
  QVERIFY(window->View()->hasFocus());
  const Place sun = LightAt(window, 0);
  QTest::keyClick(window->View(), Qt::Key_Left);
  QVERIFY(LightAt(window, 0) != sun);
  Trigger(window.get(), "previousLight");
  QCOMPARE(window->Opened()->SelectedLightIndex(), 1);
  QVERIFY(window->View()->HasKeys());
}

//------------------------------------------------------------------------------
void TestViewerKeys::theMouseTakesTheKeysAway()
{
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "addLampAction");
  Focus(window);
  Mouse(window->View(), QEvent::MouseMove, DotAt(window.get(), 1));
  QVERIFY(!window->View()->HasKeys());
  const Place sun = LightAt(window, 0);
  const Place lamp = LightAt(window, 1);
  QTest::keyClick(window->View(), Qt::Key_Right); // the one under the mouse
  QCOMPARE(LightAt(window, 0), sun);
  QVERIFY(LightAt(window, 1) != lamp);
  window->View()->TakeKeys();
  QVERIFY(window->View()->HasKeys());
  Drag(window->View(), QPoint(5, 5), QPoint(9, 9));
  QVERIFY(!window->View()->HasKeys());
}

//------------------------------------------------------------------------------
void TestViewerKeys::highlightGoesWithTheMouse()
{
  const Window window = this->NewWindow(this->Hills());
  QImage before;
  COMPLETE_PICTURE(before, window);
  Mouse(window->View(), QEvent::MouseMove, DotAt(window.get(), 0));
  QImage over;
  COMPLETE_PICTURE(over, window);
  QVERIFY(over != before);
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(window->View(), &leave);
  QImage after;
  COMPLETE_PICTURE(after, window);
  QCOMPARE(after, before);
}

//------------------------------------------------------------------------------
void TestViewerKeys::environmentIsTurned_data()
{
  QTest::addColumn<int>("button");
  QTest::addColumn<int>("modifiers");
  QTest::newRow("right button") << int(Qt::RightButton) << int(Qt::NoModifier);
  QTest::newRow("left button with control") << int(Qt::LeftButton) << int(Qt::ControlModifier);
}

//------------------------------------------------------------------------------
void TestViewerKeys::environmentIsTurned()
{
  QFETCH(int, button);
  QFETCH(int, modifiers);
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "presetSunAndSky");
  const int steps = window->Opened()->Steps()->count();
  QImage before;
  COMPLETE_PICTURE(before, window);
  const double start = Turned(window);
  const auto send = [&](QEvent::Type type, double degrees)
  {
    Send(window, type, Around(window, degrees), Qt::MouseButton(button),
      Qt::KeyboardModifiers(modifiers));
  };
  const QPoint corner = window->View()->ToWidget(0.0, 0.0);
  // A quarter against the clock, beyond the seam of the angles.
  send(QEvent::MouseButtonPress, 135.0);
  for (int i = 1; i <= 9; ++i)
  {
    send(QEvent::MouseMove, 135.0 + 10.0 * i);
    QVERIFY(window->Opened()->InStep());
  }
  send(QEvent::MouseButtonRelease, 225.0);
  QVERIFY(!window->Opened()->InStep());
  QVERIFY2(
    std::abs(Turned(window) - start - 90.0) < 1.0, qPrintable(QString::number(Turned(window))));
  QCOMPARE(window->View()->ToWidget(0.0, 0.0), corner); // the picture has stayed
  // The panel shows it, the status tells it, and it was one step.
  auto* box = Find(window.get(), "environmentTurn")->findChild<QDoubleSpinBox*>();
  QVERIFY(std::abs(box->value() - Turned(window)) < 1e-9);
  QVERIFY(this->Said.last().contains(QString::number(Turned(window))));
  this->Said.clear();
  QImage after;
  COMPLETE_PICTURE(after, window);
  QVERIFY(after != before);
  QCOMPARE(window->Opened()->Steps()->count(), steps + 1);
  Trigger(window.get(), "undo");
  QCOMPARE(Turned(window), start);
  // With the clock it passes 0.
  send(QEvent::MouseButtonPress, 0.0);
  send(QEvent::MouseMove, -30.0);
  send(QEvent::MouseButtonRelease, -30.0);
  QVERIFY(std::abs(Turned(window) - 330.0) < 1.0);
  this->Said.clear();
  // Without the button the mouse turns nothing.
  send(QEvent::MouseMove, 30.0);
  QVERIFY(std::abs(Turned(window) - 330.0) < 1.0);
  QVERIFY(Find(window.get(), "environmentTurn")->toolTip().contains("right button"));
}

//------------------------------------------------------------------------------
void TestViewerKeys::escapeTurnsItBack()
{
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "presetSkyDome");
  const int steps = window->Opened()->Steps()->count();
  Send(window, QEvent::MouseButtonPress, Around(window, 0.0), Qt::RightButton);
  Send(window, QEvent::MouseMove, Around(window, 50.0), Qt::RightButton);
  QVERIFY(Turned(window) > 40.0);
  QTest::keyClick(window->View(), Qt::Key_Escape);
  QCOMPARE(Turned(window), 0.0);
  QVERIFY(!window->Opened()->InStep());
  Send(window, QEvent::MouseMove, Around(window, 70.0), Qt::RightButton);
  Send(window, QEvent::MouseButtonRelease, Around(window, 70.0), Qt::RightButton);
  QCOMPARE(Turned(window), 0.0);
  QCOMPARE(window->Opened()->Steps()->count(), steps);
  this->Said.clear();
}

//------------------------------------------------------------------------------
void TestViewerKeys::nothingToTurn()
{
  const Window window = this->NewWindow(this->Hills());
  Send(window, QEvent::MouseButtonPress, Around(window, 0.0), Qt::RightButton);
  Send(window, QEvent::MouseMove, Around(window, 50.0), Qt::RightButton);
  QVERIFY(!window->Opened()->InStep());
  Send(window, QEvent::MouseButtonRelease, Around(window, 50.0), Qt::RightButton);
  QVERIFY(window->Opened()->Steps()->isClean());
  // Control makes no difference to the left button then.
  const QPoint corner = window->View()->ToWidget(0.0, 0.0);
  Drag(window->View(), QPoint(5, 5), QPoint(45, 25), Qt::ControlModifier);
  QVERIFY(window->View()->ToWidget(0.0, 0.0) != corner);
}

//------------------------------------------------------------------------------
void TestViewerKeys::itGoesWhileItIsTurned()
{
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "presetSkyDome");
  Send(window, QEvent::MouseButtonPress, Around(window, 0.0), Qt::RightButton);
  Send(window, QEvent::MouseMove, Around(window, 50.0), Qt::RightButton);
  Trigger(window.get(), "presetSun");
  Send(window, QEvent::MouseMove, Around(window, 70.0), Qt::RightButton);
  QVERIFY(!window->Opened()->InStep());
  Send(window, QEvent::MouseButtonRelease, Around(window, 70.0), Qt::RightButton);
  QCOMPARE(this->Said.size(), 1);
  this->Said.clear();
  // The mouse is the picture's again.
  const QPoint corner = window->View()->ToWidget(0.0, 0.0);
  Drag(window->View(), QPoint(5, 5), QPoint(45, 25));
  QVERIFY(window->View()->ToWidget(0.0, 0.0) != corner);
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerKeys>(argc, argv);
}

#include "TestViewerKeys.moc"

// SPDX-License-Identifier: BSD-3-Clause

// Lights are dragged over the picture, which follows, and everything can be undone.

#include "ViewerTest.h"

#include "vtkDataArray.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkPointData.h"
#include "vtkReliefImageMapper.h"
#include "vtkReliefStatistics.h"
#include "vtkRenderWindow.h"

#include <QAction>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QListWidget>

#include <algorithm>
#include <array>

using namespace reliefviewer;

class TestViewerLight : public ViewerTest
{
  Q_OBJECT

private slots:
  void dragMovesTheSun();
  void dragGivesUpDetail();
  void escapePutsItBack();
  void undoWhileDragging();
  void shiftDragAndWheel();
  void doubleClickMakesALamp();
  void arrows();
  void dragMovesTheLamp();
  void severalLights();
  void listOfLights();
  void besideTheDots();
  void presets();
  void switchedOff();
  void undoGoesAllTheWay();
  void highResolution();

private:
  using Place = std::array<double, 3>;
  static Place LightAt(const Window& window, int light = 0);
  /// But for rounding.
  static bool Near(const Place& one, const Place& other);
  static vtkLight* Light(const Window& window, int light = 0);
  static int Steps(const Window& window) { return window->Opened()->Steps()->count(); }
};

//------------------------------------------------------------------------------
vtkLight* TestViewerLight::Light(const Window& window, int light)
{
  return vtkLight::SafeDownCast(window->Opened()->Scene()->GetLights()->GetItemAsObject(light));
}

//------------------------------------------------------------------------------
TestViewerLight::Place TestViewerLight::LightAt(const Window& window, int light)
{
  Place place;
  Light(window, light)->GetPosition(place.data());
  return place;
}

//------------------------------------------------------------------------------
bool TestViewerLight::Near(const Place& one, const Place& other)
{
  return std::equal(one.begin(), one.end(), other.begin(),
    [](double a, double b) { return std::abs(a - b) < 1e-12; });
}

//------------------------------------------------------------------------------
void TestViewerLight::dragMovesTheSun()
{
  const Window window = this->NewWindow(this->Hills());
  QImage before;
  COMPLETE_PICTURE(before, window);
  const Place old = LightAt(window);
  const QPoint dot = DotAt(window.get(), 0);
  const QPoint target = window->View()->ToWidget(1300.0, 700.0); // south-east of the middle
  Drag(window->View(), dot, target);
  // The dot is where the mouse went, and the sun where the dot says.
  QVERIFY((DotAt(window.get(), 0) - target).manhattanLength() <= 2);
  const Place sun = LightAt(window);
  QVERIFY(sun != old);
  QVERIFY(sun[0] > 0.0 && sun[1] < 0.1 && sun[2] > 0.0);
  QImage after;
  COMPLETE_PICTURE(after, window);
  QVERIFY(after != before);
  // The panel shows it, and it was one step.
  auto* azimuth = Find(window.get(), "sunAzimuth")->findChild<QDoubleSpinBox*>();
  QVERIFY(azimuth->value() > 80.0 && azimuth->value() < 180.0);
  QCOMPARE(Steps(window), 1);
  QVERIFY(window->isWindowModified());
  Trigger(window.get(), "undo");
  QCOMPARE(LightAt(window), old);
  QVERIFY(!window->isWindowModified());
  QImage undone;
  COMPLETE_PICTURE(undone, window);
  // The dot is the only thing that the mouse may have changed the look of.
  Mouse(window->View(), QEvent::MouseMove, QPoint(3, 3));
  COMPLETE_PICTURE(undone, window);
  QCOMPARE(undone, before);
  Trigger(window.get(), "redo");
  QVERIFY(Near(LightAt(window), sun));
  Mouse(window->View(), QEvent::MouseMove, QPoint(3, 3));
  QImage redone;
  COMPLETE_PICTURE(redone, window);
  QVERIFY(redone != undone);
}

//------------------------------------------------------------------------------
void TestViewerLight::dragGivesUpDetail()
{
  const Window window = this->NewWindow(this->Hills());
  ReliefView* view = window->View();
  const QPoint dot = DotAt(window.get(), 0);
  Mouse(view, QEvent::MouseMove, dot);
  Mouse(view, QEvent::MouseButtonPress, dot);
  for (int i = 1; i < 6; ++i)
  {
    Mouse(view, QEvent::MouseMove, dot + QPoint(5 * i, 3 * i));
    QVERIFY(view->renderWindow()->GetDesiredUpdateRate() >= 1.0);
    QCOMPARE(view->LastFrame().LightsTraced, 1);
  }
  Mouse(view, QEvent::MouseButtonRelease, dot + QPoint(25, 15));
  QVERIFY(view->renderWindow()->GetDesiredUpdateRate() < 1.0);
  QImage picture;
  COMPLETE_PICTURE(picture, window);
  auto* text = Find<QLabel>(window.get(), "frameText");
  QVERIFY2(
    text->text().contains("ms") && text->text().contains("complete"), qPrintable(text->text()));
  // A colour needs no ray.
  window->Opened()->Edit("Colour", [&] { Light(window)->SetDiffuseColor(1.0, 0.5, 0.25); });
  COMPLETE_PICTURE(picture, window);
  QCOMPARE(view->LastFrame().LightsTraced, 0);
}

//------------------------------------------------------------------------------
void TestViewerLight::escapePutsItBack()
{
  const Window window = this->NewWindow(this->Hills());
  ReliefView* view = window->View();
  const Place old = LightAt(window);
  const QPoint dot = DotAt(window.get(), 0);
  Mouse(view, QEvent::MouseMove, dot);
  Mouse(view, QEvent::MouseButtonPress, dot);
  Mouse(view, QEvent::MouseMove, dot + QPoint(60, 40));
  QVERIFY(LightAt(window) != old);
  QTest::keyClick(view, Qt::Key_Escape);
  QCOMPARE(LightAt(window), old);
  Mouse(view, QEvent::MouseButtonRelease, dot + QPoint(60, 40));
  QCOMPARE(LightAt(window), old);
  QCOMPARE(Steps(window), 0);
  QVERIFY(!window->Opened()->InStep());
}

//------------------------------------------------------------------------------
// Keys work while the button is down: the drag ends, or goes on with what is there then.
void TestViewerLight::undoWhileDragging()
{
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "addLampAction");
  ReliefView* view = window->View();
  const QPoint dot = DotAt(window.get(), 1);
  Mouse(view, QEvent::MouseMove, dot);
  Mouse(view, QEvent::MouseButtonPress, dot);
  Mouse(view, QEvent::MouseMove, dot + QPoint(30, 20));
  Trigger(window.get(), "undo"); // the lamp that is dragged is gone
  QCOMPARE(window->Opened()->Scene()->GetLights()->GetNumberOfItems(), 1);
  Mouse(view, QEvent::MouseMove, dot + QPoint(60, 40));
  Mouse(view, QEvent::MouseButtonRelease, dot + QPoint(60, 40));
  QVERIFY(!window->Opened()->InStep());
  QVERIFY(!window->isWindowModified());
  QVERIFY(view->renderWindow()->GetDesiredUpdateRate() < 1.0);
  Trigger(window.get(), "redo");
  QCOMPARE(window->Opened()->Scene()->GetLights()->GetNumberOfItems(), 2);
}

//------------------------------------------------------------------------------
void TestViewerLight::shiftDragAndWheel()
{
  const Window window = this->NewWindow(this->Hills());
  auto* altitude = Find(window.get(), "sunAltitude")->findChild<QDoubleSpinBox*>();
  const QPoint dot = DotAt(window.get(), 0);
  Drag(window->View(), dot, dot + QPoint(0, -50), Qt::ShiftModifier);
  QVERIFY(std::abs(altitude->value() - 55.0) < 1e-6);
  const double before = altitude->value();
  Wheel(window->View(), DotAt(window.get(), 0), -1);
  QVERIFY(std::abs(altitude->value() - (before - 1.0)) < 1e-6);
  Wheel(window->View(), DotAt(window.get(), 0), -1);
  QVERIFY(std::abs(altitude->value() - (before - 2.0)) < 1e-6);
  Trigger(window.get(), "undo");
  Trigger(window.get(), "undo");
  QVERIFY(std::abs(altitude->value() - 45.0) < 1e-9);
}

//------------------------------------------------------------------------------
void TestViewerLight::doubleClickMakesALamp()
{
  const Window window = this->NewWindow(this->Hills());
  ReliefView* view = window->View();
  const auto doubleClick = [&]
  {
    const QPoint dot = DotAt(window.get(), 0);
    Mouse(view, QEvent::MouseMove, dot);
    Mouse(view, QEvent::MouseButtonPress, dot);
    Mouse(view, QEvent::MouseButtonRelease, dot);
    Mouse(view, QEvent::MouseButtonDblClick, dot);
    Mouse(view, QEvent::MouseButtonRelease, dot);
  };
  doubleClick();
  QVERIFY(Light(window)->GetPositional());
  QVERIFY(Find(window.get(), "lampDistance")->isVisible());
  QVERIFY(!Find(window.get(), "sunAltitude")->isVisible());
  QCOMPARE(Steps(window), 1);
  doubleClick();
  QVERIFY(!Light(window)->GetPositional());
  Trigger(window.get(), "switchLight");
  QVERIFY(Light(window)->GetPositional());
  Trigger(window.get(), "undo");
  QVERIFY(!Light(window)->GetPositional());
}

//------------------------------------------------------------------------------
void TestViewerLight::arrows()
{
  const Window window = this->NewWindow(this->Hills());
  ReliefView* view = window->View();
  const QPoint dot = DotAt(window.get(), 0);
  Mouse(view, QEvent::MouseMove, dot);
  QTest::keyClick(view, Qt::Key_Right, Qt::ShiftModifier);
  QVERIFY(std::abs(DotAt(window.get(), 0).x() - dot.x() - 10) <= 1);
  QTest::keyClick(view, Qt::Key_Up);
  QVERIFY(std::abs(DotAt(window.get(), 0).y() - dot.y() + 1) <= 1);
  // Keys that VTK's interactors have for themselves do nothing: the window lives.
  for (const char key : { 'q', 'e', '3', 'r', 'i' })
  {
    QTest::keyClick(view, key);
  }
  QVERIFY(window->isVisible());
  QVERIFY(!view->renderWindow()->GetStereoRender());
}

//------------------------------------------------------------------------------
void TestViewerLight::dragMovesTheLamp()
{
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "switchLight");
  const Place old = LightAt(window);
  const QPoint target = window->View()->ToWidget(600.0, 450.0);
  Drag(window->View(), DotAt(window.get(), 0), target);
  const Place lamp = LightAt(window);
  QCOMPARE(lamp[2], old[2]);
  // Within two pixels.
  const double pixel = 64.0 * 30.0 / window->View()->width() * 2.0;
  QVERIFY(std::abs(lamp[0] - 600.0) < 2.0 * pixel && std::abs(lamp[1] - 450.0) < 2.0 * pixel);
  // The panel has it in coordinates of the map.
  auto* x = Find(window.get(), "lampX")->findChild<QDoubleSpinBox*>();
  QVERIFY(std::abs(x->value() - (lamp[0] + 1015.0)) < 1e-3);
}

//------------------------------------------------------------------------------
void TestViewerLight::severalLights()
{
  const Window window = this->NewWindow(this->Hills());
  Trigger(window.get(), "addLampAction");
  Trigger(window.get(), "addSunAction");
  QCOMPARE(window->Opened()->SelectedLightIndex(), 2);
  // Both suns are at one place: the first to be dragged uncovers the other.
  Drag(window->View(), DotAt(window.get(), 0), window->View()->ToWidget(1500.0, 1000.0));
  const Place lamp = LightAt(window, 1);
  QVERIFY(LightAt(window, 0) != LightAt(window, 2));
  Drag(window->View(), DotAt(window.get(), 1), window->View()->ToWidget(900.0, 300.0));
  QVERIFY(LightAt(window, 1) != lamp);
  QCOMPARE(window->Opened()->SelectedLightIndex(), 1);
  Trigger(window.get(), "nextLight");
  QCOMPARE(window->Opened()->SelectedLightIndex(), 2);
  Trigger(window.get(), "nextLight");
  QCOMPARE(window->Opened()->SelectedLightIndex(), 0);
  QImage picture;
  COMPLETE_PICTURE(picture, window);
  // One moves, one is traced.
  QPoint dot = DotAt(window.get(), 1);
  Mouse(window->View(), QEvent::MouseMove, dot);
  Mouse(window->View(), QEvent::MouseButtonPress, dot);
  Mouse(window->View(), QEvent::MouseMove, dot + QPoint(9, 9));
  Mouse(window->View(), QEvent::MouseMove, dot + QPoint(19, 19));
  QVERIFY(window->View()->LastFrame().LightsTraced >= 1);
  Mouse(window->View(), QEvent::MouseButtonRelease, dot + QPoint(19, 19));
}

//------------------------------------------------------------------------------
void TestViewerLight::listOfLights()
{
  const Window window = this->NewWindow(this->Hills());
  auto* list = Find<QListWidget>(window.get(), "lights");
  QTest::mouseClick(Find(window.get(), "addLamp"), Qt::LeftButton);
  QCOMPARE(list->count(), 2);
  QCOMPARE(list->currentRow(), 1);
  QVERIFY(Find(window.get(), "lampX")->isVisible());
  QTest::mouseClick(
    list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(0)).center());
  QCOMPARE(window->Opened()->SelectedLightIndex(), 0);
  QVERIFY(Find(window.get(), "sunAzimuth")->isVisible());
  QTest::mouseClick(Find(window.get(), "addSun"), Qt::LeftButton);
  QCOMPARE(list->count(), 3);
  QTest::mouseClick(Find(window.get(), "removeLight"), Qt::LeftButton);
  QTest::mouseClick(Find(window.get(), "removeLight"), Qt::LeftButton);
  QTest::mouseClick(Find(window.get(), "removeLight"), Qt::LeftButton);
  QCOMPARE(window->Opened()->Scene()->GetLights()->GetNumberOfItems(), 0);
  QVERIFY(!Find(window.get(), "removeLight")->isEnabled());
  QVERIFY(!Find(window.get(), "lightIntensity")->isVisible());
  QVERIFY(list->item(0)->text().contains("default sun"));
  for (int i = 0; i < 5; ++i)
  {
    Trigger(window.get(), "undo");
  }
  QCOMPARE(list->count(), 1);
  QVERIFY(list->item(0)->flags().testFlag(Qt::ItemIsUserCheckable));
  QVERIFY(list->item(0)->flags().testFlag(Qt::ItemIsEnabled));
  QVERIFY(!window->isWindowModified());
}

//------------------------------------------------------------------------------
void TestViewerLight::besideTheDots()
{
  const Window window = this->NewWindow(this->Hills());
  ReliefView* view = window->View();
  const Place old = LightAt(window);
  const QPoint at(view->width() / 4, view->height() * 3 / 4);
  const QPoint before = view->ToWidget(0.0, 0.0);
  Drag(view, at, at + QPoint(40, -30));
  const QPoint moved = view->ToWidget(0.0, 0.0);
  QVERIFY((moved - before - QPoint(40, -30)).manhattanLength() <= 2);
  // What is under the mouse stays there.
  const QPoint far = view->ToWidget(1800.0, 1400.0);
  Wheel(view, moved, 2);
  QVERIFY((view->ToWidget(0.0, 0.0) - moved).manhattanLength() <= 2);
  QVERIFY(
    (view->ToWidget(1800.0, 1400.0) - moved).manhattanLength() > (far - moved).manhattanLength());
  Trigger(window.get(), "fit");
  QVERIFY((view->ToWidget(0.0, 0.0) - before).manhattanLength() <= 1);
  Trigger(window.get(), "samples");
  QVERIFY(std::abs(view->ToWidget(300.0, 0.0).x() - view->ToWidget(0.0, 0.0).x() - 10) <= 1);
  Trigger(window.get(), "fit");
  // Fitted once, it stays so.
  window->resize(700, 500);
  QTest::qWait(50);
  const QPoint corner = view->ToWidget(0.0, 0.0);
  QVERIFY(view->rect().contains(corner) && view->rect().contains(view->ToWidget(1890.0, 1410.0)));
  QCOMPARE(LightAt(window), old);
  QCOMPARE(Steps(window), 0);
  // The status bar knows what is under the mouse.
  Mouse(view, QEvent::MouseMove, view->ToWidget(0.0, 0.0));
  vtkDataArray* heights =
    window->Opened()->OpenedField().Heights.Heights->GetPointData()->GetScalars();
  const QString first = "height " + QString::number(heights->GetComponent(0, 0), 'g', 7);
  QVERIFY(Find<QLabel>(window.get(), "sampleText")->text().contains(first));
  Mouse(view, QEvent::MouseMove, QPoint(1, 1));
  QVERIFY(Find<QLabel>(window.get(), "sampleText")->text().isEmpty());
}

//------------------------------------------------------------------------------
void TestViewerLight::presets()
{
  const Window window = this->NewWindow(this->Hills());
  vtkReliefScene* scene = window->Opened()->Scene();
  Trigger(window.get(), "presetMultidirectional");
  QCOMPARE(scene->GetLights()->GetNumberOfItems(), 4);
  QVERIFY(window->View()->Dot(3) && !window->View()->Dot(4));
  Trigger(window.get(), "presetSkyDome");
  QCOMPARE(scene->GetLights()->GetNumberOfItems(), 0);
  QVERIFY(scene->GetEnvironment());
  QVERIFY(!window->View()->Dot(0));
  QImage dome;
  COMPLETE_PICTURE(dome, window);
  Trigger(window.get(), "presetSunAndSky");
  QImage sky;
  COMPLETE_PICTURE(sky, window);
  QVERIFY(sky != dome);
  Trigger(window.get(), "presetSun");
  QVERIFY(!scene->GetEnvironment());
  QCOMPARE(scene->GetLights()->GetNumberOfItems(), 1);
}

//------------------------------------------------------------------------------
void TestViewerLight::switchedOff()
{
  const Window window = this->NewWindow(this->Hills());
  auto* list = Find<QListWidget>(window.get(), "lights");
  QImage on;
  COMPLETE_PICTURE(on, window);
  list->item(0)->setCheckState(Qt::Unchecked);
  QVERIFY(!Light(window)->GetSwitch());
  QImage off;
  COMPLETE_PICTURE(off, window);
  QVERIFY(off != on);
  Trigger(window.get(), "undo");
  QVERIFY(Light(window)->GetSwitch());
  QCOMPARE(list->item(0)->checkState(), Qt::Checked);
  // Dots may be hidden, and then nothing can be dragged by accident.
  const QPoint dot = DotAt(window.get(), 0);
  Trigger(window.get(), "showLights");
  const Place old = LightAt(window);
  Drag(window->View(), dot, dot + QPoint(30, 30));
  QCOMPARE(LightAt(window), old);
}

//------------------------------------------------------------------------------
void TestViewerLight::undoGoesAllTheWay()
{
  const Window window = this->NewWindow(this->Hills());
  Document* document = window->Opened();
  std::vector<std::string> texts{ document->Text() };
  const auto done = [&] { texts.push_back(document->Text()); };
  Drag(window->View(), DotAt(window.get(), 0), DotAt(window.get(), 0) + QPoint(20, 30));
  done();
  Trigger(window.get(), "addLampAction");
  done();
  Drag(window->View(), DotAt(window.get(), 1), DotAt(window.get(), 1) + QPoint(33, 44));
  done();
  Trigger(window.get(), "presetSunAndSky");
  done();
  Type(Find(window.get(), "heightScale"), "1.25");
  done();
  Trigger(window.get(), "removeLightAction");
  done();
  QCOMPARE(Steps(window), static_cast<int>(texts.size()) - 1);
  for (std::size_t i = texts.size() - 1; i-- > 0;)
  {
    Trigger(window.get(), "undo");
    QVERIFY(document->Text() == texts[i]);
  }
  for (std::size_t i = 1; i < texts.size(); ++i)
  {
    Trigger(window.get(), "redo");
    QVERIFY(document->Text() == texts[i]);
  }
}

//------------------------------------------------------------------------------
// On a screen of twice the resolution the dot is where it is seen.
void TestViewerLight::highResolution()
{
  const Window window = this->NewWindow(this->Hills());
  window->View()->setCustomDevicePixelRatio(2.0);
  window->resize(901, 641);
  QImage picture;
  COMPLETE_PICTURE(picture, window);
  const Place old = LightAt(window);
  const QPoint target = window->View()->ToWidget(1300.0, 700.0);
  Drag(window->View(), DotAt(window.get(), 0), target);
  QVERIFY(LightAt(window) != old);
  QVERIFY((DotAt(window.get(), 0) - target).manhattanLength() <= 2);
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerLight>(argc, argv);
}

#include "TestViewerLight.moc"

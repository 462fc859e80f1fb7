// SPDX-License-Identifier: BSD-3-Clause

// Whatever is done in whatever order: nothing is complained of, and all of it can be undone and
// done again. RELIEF_SEED repeats a run.

#include "Section.h"
#include "ViewerTest.h"

#include "vtkLightCollection.h"
#include "vtkReliefLightRepresentation.h"

#include <QAction>
#include <QComboBox>
#include <QRandomGenerator>

#include <algorithm>
#include <iterator>

using namespace reliefviewer;

class TestViewerRandom : public ViewerTest
{
  Q_OBJECT

private slots:
  void everythingIsUndone();

private:
  void Something(MainWindow* window);
  int Below(int bound) { return static_cast<int>(this->Random.bounded(bound)); }
  template <class Widget>
  Widget* AnyVisible(MainWindow* window);

  QRandomGenerator Random;
};

//------------------------------------------------------------------------------
template <class Widget>
Widget* TestViewerRandom::AnyVisible(MainWindow* window)
{
  QList<Widget*> visible;
  for (auto* widget : window->findChildren<Widget*>())
  {
    if (widget->isVisible())
    {
      visible += widget;
    }
  }
  return visible.isEmpty() ? nullptr : visible[this->Below(visible.size())];
}

//------------------------------------------------------------------------------
void TestViewerRandom::Something(MainWindow* window)
{
  const char* const actions[] = { "addSunAction", "addLampAction", "switchLight", "nextLight",
    "removeLightAction", "presetSun", "presetSunAndSky", "presetSkyDome", "presetMultidirectional",
    "presetCombined", "presetIgor", "undo", "undo", "undo", "redo", "redo", "fitHeights", "fit",
    "samples", "zoomIn", "zoomOut", "showLights" };
  ReliefView* view = window->View();
  const QPoint anywhere(this->Below(view->width()), this->Below(view->height()));
  const int lights = window->Opened()->Scene()->GetLights()->GetNumberOfItems();
  switch (this->Below(8))
  {
    case 0:
    case 1:
      Trigger(window, actions[this->Below(static_cast<int>(std::size(actions)))]);
      break;
    case 2:
    {
      double at[3];
      vtkReliefLightRepresentation* dot = view->Dot(this->Below(std::max(lights, 1)));
      if (dot && dot->GetDotPosition(at))
      {
        Drag(view, view->ToWidget(at[0], at[1]), anywhere,
          this->Below(2) ? Qt::ShiftModifier : Qt::NoModifier);
      }
      break;
    }
    case 3:
    case 4:
      if (auto* row = this->AnyVisible<NumberRow>(window))
      {
        DragSlider(row, this->Random.generateDouble());
      }
      break;
    case 5:
      if (auto* box = this->AnyVisible<QComboBox>(window))
      {
        box->setFocus();
        // Not as far as the picture, which asks for a file.
        QTest::keyClick(
          box, this->Below(2) && box->currentIndex() == 0 ? Qt::Key_Down : Qt::Key_Up);
      }
      break;
    case 6:
      window->resize(500 + this->Below(500), 400 + this->Below(400));
      Wheel(view, anywhere, this->Below(2) ? 1 : -1);
      break;
    default:
      QVERIFY(window->Open(this->Path(this->Below(2) ? "hills.asc" : "small.asc")));
  }
}

//------------------------------------------------------------------------------
void TestViewerRandom::everythingIsUndone()
{
  const QByteArray given = qgetenv("RELIEF_SEED");
  const quint32 seed = given.isEmpty() ? QRandomGenerator::global()->generate() : given.toUInt();
  qInfo() << "RELIEF_SEED" << seed;
  this->Random.seed(seed);
  this->Hills("small.asc", 23, 31);
  const Window window = this->NewWindow(this->Hills());
  for (Section* section : window->findChildren<Section*>())
  {
    section->SetOpen(true);
  }
  Document* document = window->Opened();
  const std::string first = document->Text();
  for (int i = 0; i < 150; ++i)
  {
    this->Something(window.get());
    QVERIFY(!document->InStep());
  }
  const std::string last = document->Text();
  const int steps = document->Steps()->index();
  while (document->Steps()->canUndo())
  {
    document->Steps()->undo();
  }
  QVERIFY(document->Text() == first);
  for (int i = 0; i < steps; ++i)
  {
    document->Steps()->redo();
  }
  QVERIFY(document->Text() == last);
  QImage picture;
  COMPLETE_PICTURE(picture, window);
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerRandom>(argc, argv);
}

#include "TestViewerRandom.moc"

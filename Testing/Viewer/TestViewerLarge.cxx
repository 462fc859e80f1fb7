// SPDX-License-Identifier: BSD-3-Clause

// A field of 4096 x 4096 samples is opened, lit and saved. Times are printed, not tested.

#include "ViewerTest.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkOpenImageIOWriter.h"
#include "vtkPointData.h"

#include <QElapsedTimer>

#include <algorithm>
#include <cmath>

using namespace reliefviewer;

class TestViewerLarge : public ViewerTest
{
  Q_OBJECT

private slots:
  void openDragSave();
};

//------------------------------------------------------------------------------
void TestViewerLarge::openDragSave()
{
  constexpr int samples = 4096;
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(samples, samples, 1);
    vtkNew<vtkFloatArray> heights;
    heights->SetNumberOfValues(static_cast<vtkIdType>(samples) * samples);
    float* height = heights->GetPointer(0);
    for (int j = 0; j < samples; ++j)
    {
      for (int i = 0; i < samples; ++i)
      {
        *height++ = static_cast<float>(60.0 * std::sin(0.011 * i) * std::cos(0.013 * j) +
          9.0 * std::sin(0.11 * i + 3.0 * std::sin(0.007 * j)) + 0.3 * ((i * 7 + j * 13) % 5));
      }
    }
    image->GetPointData()->SetScalars(heights);
    vtkNew<vtkOpenImageIOWriter> writer;
    writer->SetFileName(qPrintable(this->Path("large.tif")));
    writer->SetInputData(image);
    writer->Write();
  }
  QElapsedTimer time;
  time.start();
  const Window window = this->NewWindow(this->Path("large.tif"));
  qInfo() << "opened and complete after" << time.elapsed() << "ms";
  QCOMPARE(window->Opened()->OpenedField().Samples[0], samples);
  Type(Find(window.get(), "subsurfaceDepth"), "3");
  QImage before;
  COMPLETE_PICTURE(before, window);

  ReliefView* view = window->View();
  int frames = 0;
  double slowest = 0.0;
  connect(view, &ReliefView::frameShown, this,
    [&]
    {
      ++frames;
      slowest = std::max(slowest, view->LastFrame().Seconds);
    });
  const QPoint dot = DotAt(window.get(), 0);
  Mouse(view, QEvent::MouseMove, dot);
  Mouse(view, QEvent::MouseButtonPress, dot);
  frames = 0;
  slowest = 0.0;
  time.restart();
  constexpr int moves = 20;
  for (int i = 1; i <= moves; ++i)
  {
    Mouse(view, QEvent::MouseMove, dot + QPoint(4 * i, 3 * i));
    QCOMPARE(view->LastFrame().LightsTraced, 1);
  }
  QCOMPARE(frames, moves);
  qInfo() << "dragging:" << time.elapsed() / moves << "ms a frame, the slowest"
          << static_cast<int>(1000.0 * slowest) << "ms";
  time.restart();
  Mouse(view, QEvent::MouseButtonRelease, dot + QPoint(4 * moves, 3 * moves));
  QImage after;
  COMPLETE_PICTURE(after, window);
  qInfo() << "complete" << time.elapsed() << "ms after the release";
  QVERIFY(after != before);

  time.restart();
  Trigger(window.get(), "samples");
  QImage close;
  COMPLETE_PICTURE(close, window);
  qInfo() << "one sample per pixel, complete after" << time.elapsed() << "ms";
  QVERIFY(close != after);
  time.restart();
  Trigger(window.get(), "undo");
  COMPLETE_PICTURE(after, window);
  qInfo() << "undone and complete after" << time.elapsed() << "ms";

  time.restart();
  QVERIFY(window->SavePicture(this->Path("large.png")));
  qInfo() << "picture saved after" << time.elapsed() << "ms";
  QCOMPARE(QImage(this->Path("large.png")).size(), QSize(samples, samples));
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerLarge>(argc, argv);
}

#include "TestViewerLarge.moc"

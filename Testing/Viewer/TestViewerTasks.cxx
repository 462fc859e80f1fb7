// SPDX-License-Identifier: BSD-3-Clause

// What takes long runs beside the window: it can be cancelled, and what is reported there and here
// is told to whom it concerns.

#include "ViewerTest.h"

#include "Failure.h"
#include "LongTask.h"
#include "MessageLog.h"
#include "Watch.h"

#include "vtkOutputWindow.h"
#include "vtkRenderWindow.h"

#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QMimeData>
#include <QProgressDialog>
#include <QPushButton>

#include <atomic>
#include <stdexcept>

using namespace reliefviewer;

class TestViewerTasks : public ViewerTest
{
  Q_OBJECT

private slots:
  void theWindowWaitsForWhatIsCancelled_data();
  void theWindowWaitsForWhatIsCancelled();
  void oneTaskAtATime();
  void nothingIsLeftOfACancel();
  void errorsOfFramesAreNotTheTasks();
  void errorsOfTasksAreNotTheFrames();
  void whatATaskLeavesIsTold();
};

namespace
{
/// Until the user cancels, and then for as long as `after` says.
void workUntilCancelled(const std::atomic<bool>& after)
{
  while (!reliefshade::interrupted())
  {
    QThread::msleep(1);
  }
  while (after)
  {
    QThread::msleep(1);
  }
  reliefshade::stopIfInterrupted();
}
}

//------------------------------------------------------------------------------
void TestViewerTasks::theWindowWaitsForWhatIsCancelled_data()
{
  QTest::addColumn<QString>("way");
  QTest::newRow("the button") << "button";
  QTest::newRow("escape") << "escape";
  QTest::newRow("the window's cross") << "close";
}

//------------------------------------------------------------------------------
// A task that has been cancelled may take a while to find out. Meanwhile the user can do nothing
// that would meet it.
void TestViewerTasks::theWindowWaitsForWhatIsCancelled()
{
  QFETCH(QString, way);
  const Window window = this->NewWindow();
  std::atomic<bool> busy{ true };
  bool stayed = false;
  bool told = false;
  InDialog<QProgressDialog>(
    [&](QProgressDialog* dialog)
    {
      QApplication::setActiveWindow(dialog); // there may be no window manager to do it
      if (way == "button")
      {
        QTest::mouseClick(dialog->findChild<QPushButton*>(), Qt::LeftButton);
      }
      else if (way == "escape")
      {
        QTest::keyClick(dialog, Qt::Key_Escape);
      }
      else
      {
        dialog->close();
      }
      QTest::qWait(200);
      told = reliefshade::interrupted();
      reliefshade::interrupt(true); // lest it runs for ever
      stayed = dialog->isVisible() && QApplication::activeModalWidget() == dialog &&
        !dialog->findChild<QPushButton*>()->isEnabled();
      busy = false;
    });
  QVERIFY(
    !runLongTask(window.get(), "Working", [&busy](const Progress&) { workUntilCancelled(busy); }));
  QVERIFY(told && stayed);
  // The next one is whole.
  QVERIFY(window->Open(this->Hills()));
  QVERIFY(window->Opened()->HasField());
}

//------------------------------------------------------------------------------
// Whatever begins while a task runs is refused with a word, and the task does not notice.
void TestViewerTasks::oneTaskAtATime()
{
  const Window window = this->NewWindow();
  const QString file = this->Hills();
  std::atomic<bool> go{ false };
  bool opened = true;
  bool dropped = true;
  bool closed = true;
  QString message;
  QTimer::singleShot(20, window.get(),
    [&]
    {
      // Before there is a dialog, what does not come from mouse and keys comes all the same.
      QMimeData data;
      data.setUrls({ QUrl::fromLocalFile(file) });
      QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
      enter.ignore();
      QApplication::sendEvent(window.get(), &enter);
      dropped = enter.isAccepted();
      closed = window->close();
      Answer(QMessageBox::Ok, &message);
      opened = window->Open(file);
      go = true;
    });
  QVERIFY(runLongTask(window.get(), "Working",
    [&go](const Progress&)
    {
      while (!go)
      {
        QThread::msleep(1);
      }
    }));
  QVERIFY(!opened && !dropped && !closed);
  QVERIFY2(message.contains("hills.asc"), qPrintable(message));
  QVERIFY(window->Open(file));
}

//------------------------------------------------------------------------------
void TestViewerTasks::nothingIsLeftOfACancel()
{
  const Window window = this->NewWindow();
  // A cancel that comes when all is done, or from nowhere.
  reliefshade::interrupt(true);
  QVERIFY(window->Open(this->Hills()));
  QVERIFY(!reliefshade::interrupted());
  // One that ends in another error than the interruption is told.
  InDialog<QProgressDialog>([](QProgressDialog* dialog)
    { QTest::mouseClick(dialog->findChild<QPushButton*>(), Qt::LeftButton); });
  QVERIFY_EXCEPTION_THROWN(runLongTask(window.get(), "Working",
                             [](const Progress&)
                             {
                               while (!reliefshade::interrupted())
                               {
                                 QThread::msleep(1);
                               }
                               throw reliefshade::Failure("file", "broken");
                             }),
    reliefshade::Failure);
  QVERIFY(!reliefshade::interrupted() && !longTaskRuns());
}

//------------------------------------------------------------------------------
void TestViewerTasks::errorsOfFramesAreNotTheTasks()
{
  const Window window = this->NewWindow(this->Hills());
  std::atomic<bool> reported{ false };
  QTimer::singleShot(10, window.get(),
    [&]
    {
      vtkOutputWindow::GetInstance()->DisplayErrorText("of the frame");
      reported = true;
    });
  bool saw = true;
  QVERIFY(runLongTask(window.get(), "Working",
    [&](const Progress&)
    {
      while (!reported)
      {
        QThread::msleep(1);
      }
      saw = reliefshade::hasError() || !reliefshade::takeError().empty();
    }));
  QVERIFY(!saw);
  window->View()->renderWindow()->Render();
  QCOMPARE(this->Said.takeFirst(), QString("of the frame"));
}

//------------------------------------------------------------------------------
void TestViewerTasks::errorsOfTasksAreNotTheFrames()
{
  const Window window = this->NewWindow(this->Hills());
  std::atomic<bool> reported{ false };
  std::atomic<bool> rendered{ false };
  std::string told;
  QTimer timer;
  connect(&timer, &QTimer::timeout,
    [&]
    {
      if (reported && !rendered)
      {
        window->View()->renderWindow()->Render();
        rendered = true;
      }
    });
  timer.start(5);
  QVERIFY(runLongTask(window.get(), "Working",
    [&](const Progress&)
    {
      vtkOutputWindow::GetInstance()->DisplayErrorText("of the task");
      reported = true;
      while (!rendered)
      {
        QThread::msleep(1);
      }
      told = reliefshade::takeError();
    }));
  QCOMPARE(told, std::string("of the task"));
  QVERIFY(this->Said.isEmpty());
  // What leads to a failure is in its message, and nowhere else.
  QVERIFY_EXCEPTION_THROWN(runLongTask(window.get(), "Working",
                             [](const Progress&)
                             {
                               vtkOutputWindow::GetInstance()->DisplayErrorText("of the task");
                               throw std::runtime_error("broken");
                             }),
    std::runtime_error);
  window->View()->renderWindow()->Render();
  QVERIFY(this->Said.isEmpty());
}

//------------------------------------------------------------------------------
// What a task that succeeds has not taken itself is not lost.
void TestViewerTasks::whatATaskLeavesIsTold()
{
  const Window window = this->NewWindow(this->Hills());
  QVERIFY(runLongTask(window.get(), "Working",
    [](const Progress&) { vtkOutputWindow::GetInstance()->DisplayWarningText("a warning"); }));
  window->View()->renderWindow()->Render();
  QCOMPARE(this->Said.takeFirst(), QString("a warning"));
}

int main(int argc, char* argv[])
{
  return ViewerTest::Run<TestViewerTasks>(argc, argv);
}

#include "TestViewerTasks.moc"

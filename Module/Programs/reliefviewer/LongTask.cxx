// SPDX-License-Identifier: BSD-3-Clause
#include "LongTask.h"

#include "Failure.h"
#include "MessageLog.h"
#include "Watch.h"

#include <QCloseEvent>
#include <QEventLoop>
#include <QProgressDialog>
#include <QPushButton>
#include <QThread>
#include <QTimer>

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>

namespace reliefviewer
{

namespace
{
constexpr int Soon = 300;   // ms: what takes no longer shows no dialog
constexpr int Between = 50; // ms between two looks at the progress

bool running = false;

//------------------------------------------------------------------------------
/// The progress, and the way to cancel. It stays until the task has ended, so that nothing else
/// begins while the task only knows that it is to stop.
class TaskDialog : public QProgressDialog
{
public:
  TaskDialog(const QString& what, QWidget* window)
    : QProgressDialog(what, QObject::tr("Cancel"), 0, 1000, window)
  {
    this->setWindowModality(Qt::ApplicationModal);
    this->setAutoClose(false);
    this->setAutoReset(false);
    this->setMinimumDuration(0);
    QObject::disconnect(this, &QProgressDialog::canceled, this, nullptr); // it would hide
    QObject::connect(this, &QProgressDialog::canceled, this, [this] { this->Cancel(); });
  }

  void reject() override { this->Cancel(); }

protected:
  void closeEvent(QCloseEvent* event) override
  {
    event->ignore();
    this->Cancel();
  }

private:
  void Cancel()
  {
    reliefshade::interrupt(true);
    this->findChild<QPushButton*>()->setEnabled(false);
    this->setLabelText(QObject::tr("Cancelling \u2026"));
  }
};

//------------------------------------------------------------------------------
/// While one lives, a task runs, and nobody has cancelled it yet.
struct Run
{
  Run()
  {
    running = true;
    reliefshade::interrupt(false);
  }
  ~Run()
  {
    reliefshade::interrupt(false);
    running = false;
  }
  Run(const Run&) = delete;
  void operator=(const Run&) = delete;
};

}

//------------------------------------------------------------------------------
bool longTaskRuns()
{
  return running;
}

//------------------------------------------------------------------------------
bool runLongTask(
  QWidget* window, const QString& what, const std::function<void(const Progress&)>& task)
{
  if (running)
  {
    throw reliefshade::Failure(
      "", QObject::tr("%1: wait until the file before is done").arg(what).toStdString());
  }
  const Run run;
  std::atomic<double> done{ 0.0 };
  std::exception_ptr thrown;
  const std::unique_ptr<QThread> thread(QThread::create(
    [&]
    {
      reliefshade::OwnMessages messages;
      try
      {
        task([&done](double share) { done = share; });
      }
      catch (...)
      {
        thrown = std::current_exception();
        messages.Forget(); // what led to it, and what followed from it
      }
    }));
  QEventLoop loop;
  bool ended = false;
  QObject::connect(thread.get(), &QThread::finished, &loop,
    [&]
    {
      ended = true;
      loop.quit();
    });
  QTimer::singleShot(Soon, &loop, &QEventLoop::quit);
  thread->start();
  loop.exec(QEventLoop::ExcludeUserInputEvents);

  if (!ended)
  {
    TaskDialog dialog(what, window);
    QTimer look;
    // Beyond its end it would count as finished.
    QObject::connect(&look, &QTimer::timeout, &dialog,
      [&] { dialog.setValue(std::min(static_cast<int>(1000.0 * done), 999)); });
    look.start(Between);
    dialog.show();
    // It may end while the dialog makes its way to the screen.
    while (!ended)
    {
      loop.exec();
    }
  }
  thread->wait();
  if (thrown)
  {
    try
    {
      std::rethrow_exception(thrown);
    }
    catch (const reliefshade::Failure& failure)
    {
      if (failure.Code == reliefshade::Interrupted)
      {
        return false;
      }
      throw;
    }
  }
  return true;
}

}

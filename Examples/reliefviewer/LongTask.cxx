// SPDX-License-Identifier: BSD-3-Clause
#include "LongTask.h"

#include "Failure.h"
#include "Watch.h"

#include <QEventLoop>
#include <QProgressDialog>
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
}

//------------------------------------------------------------------------------
bool runLongTask(
  QWidget* window, const QString& what, const std::function<void(const Progress&)>& task)
{
  std::atomic<double> done{ 0.0 };
  std::exception_ptr thrown;
  const std::unique_ptr<QThread> thread(QThread::create(
    [&]
    {
      try
      {
        task([&done](double share) { done = share; });
      }
      catch (...)
      {
        thrown = std::current_exception();
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
    QProgressDialog dialog(what, QObject::tr("Cancel"), 0, 1000, window);
    dialog.setWindowModality(Qt::ApplicationModal);
    dialog.setAutoClose(false);
    dialog.setAutoReset(false);
    dialog.setMinimumDuration(0);
    QObject::connect(&dialog, &QProgressDialog::canceled, [] { reliefshade::interrupt(true); });
    QTimer look;
    QObject::connect(&look, &QTimer::timeout, &dialog,
      [&dialog, &done]
      {
        // Beyond its end it would count as finished.
        if (!dialog.wasCanceled())
        {
          dialog.setValue(std::min(static_cast<int>(1000.0 * done), 999));
        }
      });
    look.start(Between);
    dialog.show();
    loop.exec();
  }
  thread->wait();
  reliefshade::interrupt(false);
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

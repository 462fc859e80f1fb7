// SPDX-License-Identifier: BSD-3-Clause
#ifndef LongTask_h
#define LongTask_h

#include <QString>

#include <functional>

class QWidget;

namespace reliefviewer
{

/// Tells how far a task is, from 0 to 1. From any thread.
using Progress = std::function<void(double)>;

/// Runs a task in a thread of its own. If it takes long a dialog shows its progress and lets the
/// user cancel it, by reliefshade::interrupt(): then it returns false. What the task throws, it
/// throws. The window does nothing else until the task has ended, cancelled or not, and what VTK
/// reports there meanwhile is no concern of the task's. Throws a Failure while another task runs.
bool runLongTask(
  QWidget* window, const QString& what, const std::function<void(const Progress&)>& task);

/// Whether one runs.
bool longTaskRuns();

}

#endif

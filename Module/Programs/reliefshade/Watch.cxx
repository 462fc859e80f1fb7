// SPDX-License-Identifier: BSD-3-Clause
#include "Watch.h"

#include "Failure.h"
#include "MessageLog.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkNew.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace
{

std::atomic<bool> stopped{ false };
static_assert(std::atomic<bool>::is_always_lock_free, "a signal's handler sets it");

extern "C" void noteSignal(int number)
{
  stopped = true;
  std::signal(number, SIG_DFL);
}

/// A bar on the standard error stream, with the time that is left of what takes longer.
class Bar
{
public:
  void Draw(const char* what, double share)
  {
    const int percent = static_cast<int>(100.0 * share);
    if (percent == this->Percent && what == this->What && this->Drawn)
    {
      return;
    }
    const Clock::time_point now = Clock::now();
    if (what != this->What || percent < this->Percent)
    {
      this->Begin = now; // a run that goes on begins amid its way
      this->First = share;
    }
    this->What = what;
    this->Percent = percent;
    this->Drawn = true;
    const int filled = Width * percent / 100;
    const std::string bar = std::string(filled, '=') + std::string(Width - filled, ' ');
    std::fprintf(stderr, "\r%s [%s] %3d %%%-12s", what, bar.c_str(), percent,
      this->TimeLeft(share, std::chrono::duration<double>(now - this->Begin).count()).c_str());
  }

  /// What is drawn next may be more of the same: the filter ends with every piece.
  void Clear()
  {
    if (this->Drawn)
    {
      std::fprintf(stderr, "\r%*s\r", Width + 36, "");
      this->Drawn = false;
    }
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr int Width = 50;

  std::string TimeLeft(double share, double seconds) const
  {
    constexpr double soon = 5.0;
    const double left = share > this->First ? seconds * (1.0 - share) / (share - this->First) : 0.0;
    if (seconds < soon || left < soon)
    {
      return "";
    }
    return left < 100.0 ? ", " + std::to_string(static_cast<int>(left)) + " s left"
      : left < 6000.0   ? ", " + std::to_string(static_cast<int>(left / 60.0)) + " min left"
                        : ", " + std::to_string(static_cast<int>(left / 3600.0)) + " h left";
  }

  std::string What;
  int Percent = -1;
  bool Drawn = false;
  double First = 0.0;
  Clock::time_point Begin;
};

Bar& bar()
{
  static Bar one;
  return one;
}

class vtkWatch : public vtkCommand
{
public:
  static vtkWatch* New() { return new vtkWatch; }

  void Execute(vtkObject* caller, unsigned long event, void*) override
  {
    auto* algorithm = static_cast<vtkAlgorithm*>(caller);
    if (stopped)
    {
      algorithm->SetAbortExecute(1);
    }
    if (!this->Shown)
    {
      return;
    }
    if (event == vtkCommand::EndEvent)
    {
      // The bar has done its work: the line is cleared for what the program says next.
      bar().Clear();
      return;
    }
    bar().Draw(this->What, algorithm->GetProgress());
  }

  bool Shown = false;
  const char* What = "";
};

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void catchSignals()
{
  std::signal(SIGINT, noteSignal);
  std::signal(SIGTERM, noteSignal);
}

//------------------------------------------------------------------------------
void interrupt(bool on)
{
  stopped = on;
}

//------------------------------------------------------------------------------
bool interrupted()
{
  return stopped;
}

//------------------------------------------------------------------------------
void stopIfInterrupted()
{
  if (interrupted())
  {
    throw Failure("", "interrupted", Interrupted);
  }
}

//------------------------------------------------------------------------------
void showProgress(bool shown, const char* what, double share)
{
  if (shown && share < 1.0)
  {
    bar().Draw(what, share);
  }
  else if (shown)
  {
    bar().Clear();
  }
}

//------------------------------------------------------------------------------
void runToEnd(vtkAlgorithm* algorithm)
{
  watch(algorithm, false);
  algorithm->Update();
  stopIfInterrupted();
  if (hasError())
  {
    throw std::runtime_error(takeError());
  }
}

//------------------------------------------------------------------------------
void watch(vtkAlgorithm* algorithm, bool shown, const char* what)
{
  vtkNew<vtkWatch> command;
  command->Shown = shown;
  command->What = what;
  algorithm->AddObserver(vtkCommand::ProgressEvent, command);
  algorithm->AddObserver(vtkCommand::EndEvent, command);
}

//------------------------------------------------------------------------------
bool terminal()
{
#ifdef _WIN32
  return _isatty(_fileno(stderr)) != 0;
#else
  return isatty(STDERR_FILENO) != 0;
#endif
}

}

// SPDX-License-Identifier: BSD-3-Clause
#include "Watch.h"

#include "Failure.h"
#include "MessageLog.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkNew.h"

#include <atomic>
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
    if (!this->Bar)
    {
      return;
    }
    if (event == vtkCommand::EndEvent)
    {
      // The bar has done its work: the line is cleared for what the program says next.
      std::fprintf(stderr, "\r%*s\r", Width + 24, "");
      this->Percent = -1;
      return;
    }
    const int percent = static_cast<int>(100.0 * algorithm->GetProgress());
    if (percent != this->Percent)
    {
      this->Percent = percent;
      const int filled = Width * percent / 100;
      const std::string bar = std::string(filled, '=') + std::string(Width - filled, ' ');
      std::fprintf(stderr, "\r%s [%s] %3d %%", this->What, bar.c_str(), percent);
    }
  }

  bool Bar = false;
  const char* What = "";

private:
  static constexpr int Width = 50;
  int Percent = -1;
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
void watch(vtkAlgorithm* algorithm, bool bar, const char* what)
{
  vtkNew<vtkWatch> command;
  command->Bar = bar;
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

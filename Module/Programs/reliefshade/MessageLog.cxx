// SPDX-License-Identifier: BSD-3-Clause
#include "MessageLog.h"

#include "Failure.h"
#include "FileGuard.h"

#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <new>
#include <sstream>
#include <utility>

#ifndef _WIN32
#include <fcntl.h>
#include <unistd.h>
#endif

namespace
{

struct Messages
{
  std::string FirstError;
  std::vector<std::string> Warnings;
};

std::mutex messageMutex;
Messages common;
thread_local Messages* own = nullptr;

Messages& messages()
{
  return own ? *own : common;
}

// VTK's form: "ERROR: In <source>, line <n>\n<class> (0x<address>): <message>\n\n".
std::string undecorated(std::string text)
{
  if (text.compare(0, 7, "ERROR: ") == 0 || text.compare(0, 9, "Warning: ") == 0)
  {
    text.erase(0, text.find('\n'));
  }
  const std::size_t address = text.find(" (0x");
  const std::size_t end = text.find("): ");
  if (address != std::string::npos && end != std::string::npos && address < end)
  {
    text.erase(0, end + 3);
  }
  return reliefshade::oneLine(text); // brief only when it is said: names in it are looked for
}

void addWarning(const char* text)
{
  std::lock_guard<std::mutex> lock(messageMutex);
  const std::string warning = undecorated(text ? text : "");
  std::vector<std::string>& warnings = messages().Warnings;
  if (!warning.empty() && std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
  {
    warnings.push_back(warning);
  }
}

/// An error event of one object would miss those of the executives behind it; this is where all of
/// them arrive.
class vtkMessageLog : public vtkOutputWindow
{
public:
  static vtkMessageLog* New();
  vtkTypeMacro(vtkMessageLog, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayWarningText(const char* text) override { addWarning(text); }
  void DisplayGenericWarningText(const char* text) override { addWarning(text); }
  void DisplayErrorText(const char* text) override
  {
    // The first error is the cause; what follows are its consequences up the pipeline.
    std::lock_guard<std::mutex> lock(messageMutex);
    if (messages().FirstError.empty() && text)
    {
      messages().FirstError = text;
    }
  }

protected:
  vtkMessageLog() = default;
  ~vtkMessageLog() override = default;

private:
  vtkMessageLog(const vtkMessageLog&) = delete;
  void operator=(const vtkMessageLog&) = delete;
};

vtkStandardNewMacro(vtkMessageLog);

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void catchMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<vtkMessageLog> log;
  vtkOutputWindow::SetInstance(log);
}

//------------------------------------------------------------------------------
bool hasError()
{
  std::lock_guard<std::mutex> lock(messageMutex);
  return !messages().FirstError.empty();
}

//------------------------------------------------------------------------------
std::string takeError()
{
  std::string text;
  {
    std::lock_guard<std::mutex> lock(messageMutex);
    text.swap(messages().FirstError);
  }
  return undecorated(text);
}

//------------------------------------------------------------------------------
std::vector<std::string> takeWarnings()
{
  std::lock_guard<std::mutex> lock(messageMutex);
  return std::exchange(messages().Warnings, {});
}

//------------------------------------------------------------------------------
struct OwnMessages::Kept : Messages
{
};

//------------------------------------------------------------------------------
OwnMessages::OwnMessages()
  : Mine(new Kept)
{
  own = this->Mine.get();
}

//------------------------------------------------------------------------------
OwnMessages::~OwnMessages()
{
  own = nullptr;
  if (!this->Mine->FirstError.empty())
  {
    vtkOutputWindow::GetInstance()->DisplayErrorText(this->Mine->FirstError.c_str());
  }
  for (const std::string& warning : this->Mine->Warnings)
  {
    addWarning(warning.c_str());
  }
}

//------------------------------------------------------------------------------
void OwnMessages::Forget()
{
  *this->Mine = Kept();
}

//------------------------------------------------------------------------------
std::string withoutName(std::string text, const std::string& file)
{
  const std::string shortened = relief::io::Shortened(file, relief::io::LongestName);
  for (const std::string& beginning : { file + ": ", "Cannot read \"" + file + "\": ",
         "Cannot write \"" + file + "\": ", "Cannot write \"" + shortened + "\": " })
  {
    if (text.compare(0, beginning.size(), beginning) == 0)
    {
      text.erase(0, beginning.size());
    }
  }
  // A long name comes without its middle.
  const std::size_t end = text.find("\": ");
  const bool named =
    text.compare(0, 13, "Cannot read \"") == 0 || text.compare(0, 14, "Cannot write \"") == 0;
  if (file.size() > 30 && named && end != std::string::npos)
  {
    text.erase(0, end + 3);
  }
  if (!text.empty() && text.back() == '.')
  {
    text.pop_back();
  }
  return text;
}

//------------------------------------------------------------------------------
Silence::Silence()
{
#ifndef _WIN32
  std::fflush(stderr);
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0)
  {
    this->Saved = dup(STDERR_FILENO);
    if (this->Saved >= 0)
    {
      dup2(nowhere, STDERR_FILENO);
    }
    close(nowhere);
  }
#endif
}

//------------------------------------------------------------------------------
Silence::~Silence()
{
#ifndef _WIN32
  if (this->Saved >= 0)
  {
    std::fflush(stderr);
    dup2(this->Saved, STDERR_FILENO);
    close(this->Saved);
  }
#endif
}

//------------------------------------------------------------------------------
std::string oneLine(const std::string& text)
{
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;)
  {
    line += line.empty() ? word : " " + word;
  }
  return line;
}

//------------------------------------------------------------------------------
void aboutFile(const std::string& file, const std::function<void()>& step)
{
  try
  {
    step();
  }
  catch (const Failure&)
  {
    throw;
  }
  catch (const relief::io::Aborted&)
  {
    throw Failure("", "interrupted", Interrupted);
  }
  catch (const std::bad_alloc&)
  {
    throw Failure(file, "not enough memory");
  }
  catch (const std::exception& error)
  {
    throw Failure(file, withoutName(oneLine(error.what()), file));
  }
}

}

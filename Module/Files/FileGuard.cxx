// SPDX-License-Identifier: BSD-3-Clause
#include "FileGuard.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <new>
#include <sstream>

#ifdef _WIN32
#include <windows.h>
#else
#include <unistd.h>
#endif

namespace relief::io
{
using vtksys::SystemTools;

//------------------------------------------------------------------------------
void Advance(const StepWatcher& watcher, double share)
{
  if (watcher && !watcher(share))
  {
    throw Aborted();
  }
}

//------------------------------------------------------------------------------
std::string Brief(const std::string& message, std::size_t longest)
{
  std::string brief = message;
  for (const std::size_t word : { 80, 60, 40, 30 })
  {
    if (brief.size() <= longest)
    {
      return brief;
    }
    brief.clear();
    for (std::size_t begin = 0; begin < message.size();)
    {
      const std::size_t end = std::min(message.find(' ', begin), message.size());
      brief += Shortened(message.substr(begin, end - begin), word);
      brief += end < message.size() ? " " : "";
      begin = end + 1;
    }
  }
  return Shortened(brief, longest);
}

//------------------------------------------------------------------------------
std::string OneLine(const std::string& text)
{
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);)
  {
    line.erase(line.find_last_not_of(" .\r") + 1);
    if (!line.empty())
    {
      result += (result.empty() ? "" : "; ") + line;
    }
  }
  return result.empty() ? "no reason is given" : Brief(result);
}

//------------------------------------------------------------------------------
unsigned long Guard(const std::function<void()>& step, std::string& reason)
{
  try
  {
    step();
    return vtkErrorCode::NoError;
  }
  catch (const Failure& failure)
  {
    reason = Brief(failure.what());
    return failure.Code;
  }
  catch (const Aborted&)
  {
    return vtkErrorCode::UserError;
  }
  catch (const std::bad_alloc&)
  {
    reason = "there is not enough memory";
  }
  catch (const std::exception& exception)
  {
    reason = OneLine(exception.what());
  }
  catch (...)
  {
    reason = "an unknown exception was thrown";
  }
  return vtkErrorCode::UnknownError;
}

//------------------------------------------------------------------------------
bool HasInput(vtkAlgorithm* writer, const char* fileName)
{
  if (writer->GetNumberOfInputConnections(0) < 1)
  {
    vtkErrorWithObjectMacro(writer,
      "Cannot write \"" << Shortened(fileName ? fileName : "", LongestName)
                        << "\": there is no input.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
unsigned long GuardWriting(
  vtkAlgorithm* writer, const std::string& fileName, const std::function<void()>& step)
{
  std::string reason;
  const unsigned long code = Guard(step, reason);
  if (!reason.empty())
  {
    vtkErrorWithObjectMacro(writer,
      "Cannot write \"" << Shortened(fileName, LongestName) << "\": " << Brief(reason) << ".");
  }
  return code;
}

//------------------------------------------------------------------------------
void CheckImage(const std::string& fileName, vtkImageData* image, bool scalarsNeeded)
{
  if (fileName.empty())
  {
    throw Failure(vtkErrorCode::NoFileNameError, "no file name is set");
  }
  if (!image || image->GetNumberOfPoints() < 1)
  {
    throw Failure(vtkErrorCode::UnknownError, "the input image is empty");
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (scalarsNeeded && (!scalars || scalars->GetNumberOfTuples() < image->GetNumberOfPoints()))
  {
    throw Failure(vtkErrorCode::UnknownError, "the input image has no scalars");
  }
  int dimensions[3];
  image->GetDimensions(dimensions);
  if (dimensions[2] != 1)
  {
    throw Failure(vtkErrorCode::UnknownError,
      "the input image has " + std::to_string(dimensions[2]) + " slices; one is written");
  }
}

//------------------------------------------------------------------------------
std::string LowerExtension(const std::string& fileName)
{
  return SystemTools::LowerCase(SystemTools::GetFilenameLastExtension(fileName));
}

//------------------------------------------------------------------------------
bool IsTiff(const std::string& fileName)
{
  const std::string extension = LowerExtension(fileName);
  return extension == ".tif" || extension == ".tiff";
}

//------------------------------------------------------------------------------
// Asked of the system itself: vtksys::SystemInformation looks at the whole machine first, which
// takes longer than the start of a program may.
vtkTypeInt64 PhysicalMemory()
{
  vtkTypeInt64 memory = 0;
#ifdef _WIN32
  MEMORYSTATUSEX status;
  status.dwLength = sizeof(status);
  memory =
    GlobalMemoryStatusEx(&status) ? static_cast<vtkTypeInt64>(status.ullTotalPhys / 1024) : 0;
#else
  memory = static_cast<vtkTypeInt64>(sysconf(_SC_PHYS_PAGES)) * (sysconf(_SC_PAGESIZE) / 1024);
#endif
  return memory > 0 ? memory : vtkTypeInt64(64) << 20; // where the system does not tell
}
}

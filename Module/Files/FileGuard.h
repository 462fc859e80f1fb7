// SPDX-License-Identifier: BSD-3-Clause
#ifndef FileGuard_h
#define FileGuard_h

/// @file
/// What everything that opens files shares: why one failed, the boundary that no exception of
/// another library passes, long steps that can be ended, and the memory that the machine has. Not
/// installed.

#include "Core/ShortText.h"

#include "vtkType.h" // For vtkTypeInt64

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

// Each library has this code for itself, but what is thrown in one may be caught in another.
#if defined(__GNUC__)
#define RELIEF_THROWN __attribute__((visibility("default")))
#else
#define RELIEF_THROWN
#endif

class vtkAlgorithm;
class vtkImageData;

namespace relief::io
{
/// Why a file cannot be read or written; it ends in one message, at the boundary to VTK.
struct RELIEF_THROWN Failure : std::runtime_error
{
  Failure(unsigned long code, const std::string& reason)
    : std::runtime_error(reason)
    , Code(code)
  {
  }
  unsigned long Code; // of vtkErrorCode
};

/// AbortExecute was set, or a step was told not to go on: no error, but nothing is to be left
/// behind either.
struct RELIEF_THROWN Aborted
{
};

/// Told how much of a long step is done, from 0 to 1; returns whether to go on. Empty for a step
/// that is nobody's concern.
using StepWatcher = std::function<bool(double)>;

/// Throws Aborted unless the step may go on.
void Advance(const StepWatcher& watcher, double share);

/// A message of a length that can be read: the middle of long words, such as keys and names of
/// files, gives way to "...", and that of the whole if it is still longer than so many bytes.
std::string Brief(const std::string& message, std::size_t longest = 200);

/// A library's text as part of a sentence: several lines become one, brief, and the full stop goes.
/// Where there is no text, that is said.
std::string OneLine(const std::string& text);

/// How much of a file's name a message shows.
constexpr std::size_t LongestName = 100;

/// Runs a step behind which no exception may pass. Returns NoError, or the code of a Failure,
/// UserError after Aborted, UnknownError for anything else that was thrown. The reason is empty
/// unless there is an error to report.
unsigned long Guard(const std::function<void()>& step, std::string& reason);

/// Whether a writer has an input; reports an error in its name if not.
bool HasInput(vtkAlgorithm* writer, const char* fileName);

/// Guards a writer's step and reports in its name what is wrong. Returns the error code, to be
/// assigned and not set: SetErrorCode would mark the writer as modified.
unsigned long GuardWriting(
  vtkAlgorithm* writer, const std::string& fileName, const std::function<void()>& step);

/// Throws a Failure unless there is a name, and one slice of points to write under it: with
/// scalars, unless another array is meant.
void CheckImage(const std::string& fileName, vtkImageData* image, bool scalarsNeeded = true);

/// The extension of a file's name with its dot, in lower case.
std::string LowerExtension(const std::string& fileName);

/// Whether a file's name ends as TIFF's do.
bool IsTiff(const std::string& fileName);

/// The memory that the machine has, in kibibytes.
vtkTypeInt64 PhysicalMemory();
}

#endif

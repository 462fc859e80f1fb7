// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageFileAccess_h
#define ImageFileAccess_h

/// @file
/// What the readers and writers of image files share: why one failed, the boundary that no
/// exception of another library passes, and files that appear whole or not at all. Private to the
/// module.

#include "vtkType.h" // For vtkTypeInt64

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/typedesc.h>

#include <cstdio>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>

class vtkImageData;

namespace relief::io
{
/// Why a file cannot be read or written; it ends in one message, at the boundary to VTK.
struct Failure : std::runtime_error
{
  Failure(unsigned long code, const std::string& reason)
    : std::runtime_error(reason)
    , Code(code)
  {
  }
  unsigned long Code; // of vtkErrorCode
};

/// AbortExecute was set: no error, but nothing is to be left behind either.
struct Aborted
{
};

/// A library's text as part of a sentence: several lines become one, of a length that can be read,
/// and the full stop goes.
std::string OneLine(const std::string& text);

/// Runs a step behind which no exception may pass. Returns NoError, or the code of a Failure,
/// UserError after Aborted, UnknownError for anything else that was thrown. The reason is empty
/// unless there is an error to report.
unsigned long Guard(const std::function<void()>& step, std::string& reason);

/// Throws a Failure unless there is a name, and one slice of points with scalars to write under it.
void CheckImage(const std::string& fileName, vtkImageData* image);

/// The memory that the machine has, in kibibytes.
vtkTypeInt64 PhysicalMemory();

/// The type of VTK that holds numbers of a type of OpenImageIO, half as float; VTK_VOID where there
/// is none.
int VTKType(OIIO::TypeDesc type);

/// OpenImageIO's name for a type of VTK; UNKNOWN where there is none.
OIIO::TypeDesc FileType(int vtkType);

/// A new file under a name of its own, `.<name>.<process>-<count>.tmp.<extension>` beside the
/// target, that takes the target's place when it is whole and is removed if it never does.
/// OpenImageIO's formats write through it where they can: closing a file themselves, they do not
/// tell that its last bytes found no room on the disk.
class TemporaryFile : public OIIO::Filesystem::IOProxy
{
public:
  /// A link is followed. Throws a Failure, CannotOpenFileError, where nothing can be written.
  explicit TemporaryFile(const std::string& target);
  ~TemporaryFile() override;
  TemporaryFile(const TemporaryFile&) = delete;
  void operator=(const TemporaryFile&) = delete;

  /// A message about the file as one about the target, in one line.
  std::string Reword(const std::string& text) const;

  /// Closes the file. Returns the system's error number of the first write that failed, 0 if none
  /// did.
  int Finish();
  /// Gives the file, finished, the target's name and, if there is one already, its permissions.
  void Rename();

  const char* proxytype() const override { return "temporary file"; }
  void close() override {} // Finish does, so that the result is seen
  bool opened() const override { return this->File != nullptr; }
  bool seek(int64_t offset) override;
  size_t read(void* buffer, size_t size) override; // TIFF reads its directories back
  size_t write(const void* buffer, size_t size) override;
  size_t pwrite(const void* buffer, size_t size, int64_t offset) override;
  size_t size() const override { return static_cast<size_t>(this->Size); }

private:
  bool MoveTo(int64_t offset);
  size_t Put(const void* buffer, size_t size, int64_t offset);

  std::string Target;
  FILE* File = nullptr;
  int Error = 0;
  int64_t Size = 0;
  bool Renamed = false;
  std::mutex Mutex;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef TemporaryFile_h
#define TemporaryFile_h

#include "StagedFile.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace relief::io
{
/// A new file that is written here, remembers the first write that failed, takes its target's place
/// when it is whole and is removed if it never does. Libraries write through it where they can:
/// closing a file themselves, they do not tell that its last bytes found no room on the disk.
class TemporaryFile
{
public:
  /// With `staged` under a name of its own, see StagedFile; without, for targets that are such a
  /// name already, under the target's. Throws a Failure, CannotOpenFileError, where nothing can be
  /// written.
  explicit TemporaryFile(const std::string& target, bool staged = true);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  void operator=(const TemporaryFile&) = delete;

  /// The name that it is written under.
  const std::string& Name() const { return this->Place ? this->Place->Name() : this->Target; }
  /// A message about the file as one about the target, in one line.
  std::string Reword(const std::string& text) const;

  bool IsOpen() const { return this->File != nullptr; }
  /// The size of what has been written.
  std::int64_t Size() const { return this->End; }
  std::int64_t Tell() const { return this->Offset; }
  /// All of these continue where the file is, and go on from where they end.
  bool Seek(std::int64_t offset);
  std::size_t Read(void* buffer, std::size_t size);
  std::size_t Write(const void* buffer, std::size_t size);

  /// Closes the file. Returns the system's error number of the first write that failed, 0 if none
  /// did.
  int Finish();
  /// Gives the file, finished, the target's name. Throws a Failure.
  void Keep();

private:
  std::string Target;
  std::unique_ptr<StagedFile> Place;
  FILE* File = nullptr;
  int Error = 0;
  std::int64_t Offset = 0;
  std::int64_t End = 0;
  bool Kept = false;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef RunFolder_h
#define RunFolder_h

#include "vtkIOReliefStreamingModule.h" // For export macro

#include <filesystem>
#include <memory>
#include <string>

namespace relief::streaming
{
/// A folder that a long run works in, and goes on in when it was ended before its time. What run it
/// is stands in `run.txt`; `lock` keeps other processes out while one works there, and goes with
/// it. Not installed.
class VTKIORELIEFSTREAMING_EXPORT RunFolder
{
public:
  enum Part
  {
    Alone, ///< of one process, or of the first of several: makes the folder and locks it
    Joined ///< of the others, once the first is there: the folder and its key are looked at
  };

  /// Makes the folder in one that is there, and locks it until this object or its process ends. The
  /// key, some lines, says what run it is: whatever its results depend on. Throws a Failure that
  /// names the folder: where it cannot be made or written, another process has it, or it is that of
  /// another run, with the first line that differs.
  RunFolder(const std::string& folder, const std::string& key, Part part = Alone);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  void operator=(const RunFolder&) = delete;

  /// The folder as it was given, for messages and names.
  const std::filesystem::path& Path() const { return this->Folder; }
  /// Whether this object has the lock, and does for all what is done once.
  bool IsFirst() const { return this->Locked != nullptr; }

  /// The name of the file in whose place a StagedFile's name would have come if its process had not
  /// been killed; empty for any other name.
  static std::string UnfinishedOf(const std::string& name);

  /// Removes what processes that were killed have left of a file that they wrote as a StagedFile:
  /// it may be as large as that. What one that runs on this machine writes stays.
  static void RemoveUnfinished(const std::string& file);
  static constexpr const char* KeyName = "run.txt";

  /// Removes the key and the lock, and the folder if nothing else is in it. Nothing is done with
  /// this object then.
  void Remove();

private:
  class Lock;

  void CheckKey(const std::string& key, bool write) const;

  std::filesystem::path Folder;
  std::unique_ptr<Lock> Locked;
};
}

#endif

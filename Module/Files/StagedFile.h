// SPDX-License-Identifier: BSD-3-Clause
#ifndef StagedFile_h
#define StagedFile_h

#include <string>
#include <vector>

namespace relief::io
{
/// A file that is written under a name of its own, `.<name>.<process>-<count>.tmp.<extension>`
/// beside the target, and gone when this object goes unless it has taken the target's place.
class StagedFile
{
public:
  /// A link is followed, also where nothing is at its end yet. Throws a Failure,
  /// CannotOpenFileError, if nothing can stand at the target: it is a directory or a device, or
  /// lies in no directory.
  explicit StagedFile(const std::string& target);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  void operator=(const StagedFile&) = delete;

  /// The target as the user wrote it, for messages.
  const std::string& Target() const { return this->Given; }
  /// Where to write: in the target's directory, with its extension.
  const std::string& Name() const { return this->Staged; }

  /// A message about the file as one about the target, in one line.
  std::string Reword(std::string text) const;

  /// Gives the file the target's place and, if there is one already, its permissions. Throws a
  /// Failure.
  void Keep();

  /// Lets all take their targets' places or none: what was there before stays if one of them
  /// cannot. Returns null, or the one that cannot, and why.
  static StagedFile* KeepAll(const std::vector<StagedFile*>& files, std::string& reason);

private:
  void KeepOld();
  void Undo();

  std::string Given;
  std::string Place; // of the target
  std::string Staged;
  std::string Backup; // the old target, until all is done
  bool Existed = false;
  bool Kept = false;
};

/// Throws a Failure, CannotOpenFileError, unless a file of that name can be made, and leaves it
/// there, empty.
void CheckPlace(const std::string& name);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef StagedFile_h
#define StagedFile_h

#include <filesystem>
#include <string>
#include <vector>

namespace reliefshade
{

/// A file that is written under a name of its own beside the target, and gone when this object goes
/// unless it has taken the target's place.
class StagedFile
{
public:
  /// Follows a link. Throws a Failure that names the target if nothing can stand there: it is a
  /// directory, or lies in none.
  explicit StagedFile(const std::string& target);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  void operator=(const StagedFile&) = delete;

  /// The target as the user wrote it, for messages.
  const std::string& Target() const { return this->Given; }
  /// Where to write: in the target's directory, with its extension.
  std::string Name() const { return this->Path.string(); }

  /// What a writer says against the file, without any name that it may begin with.
  std::string Reword(std::string text) const;

  /// Lets all take their targets' places, and permissions, or none: what was there before stays if
  /// one of them cannot. Throws a Failure that names this one.
  static void KeepAll(const std::vector<StagedFile*>& files);

private:
  void Keep();
  void Undo();

  std::string Given;
  std::filesystem::path Place; // of the target
  std::filesystem::path Path;
  std::filesystem::path Backup; // the old target, until all is done
  bool Existed = false;
  bool Kept = false;
};

}

#endif

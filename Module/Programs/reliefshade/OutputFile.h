// SPDX-License-Identifier: BSD-3-Clause
#ifndef OutputFile_h
#define OutputFile_h

#include "StagedFile.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace reliefshade
{

/// A file of a run, and what it is there for: "INPUT", "the scene".
struct NamedFile
{
  std::string Name;
  std::string Role;
};

/// Throws a Failure, UsageFailure, if writing the outputs would replace anything that an input is
/// read from, or one of them another. No name is empty.
void keepApart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// A file that is written under a name of its own beside the target, and gone when this object goes
/// unless it has taken the target's place.
class OutputFile
{
public:
  /// Throws a Failure that names the target if nothing can stand there.
  explicit OutputFile(const std::string& target);

  /// The target as the user wrote it, for messages.
  const std::string& Target() const { return this->Staged->Target(); }
  /// Where to write: in the target's directory, with its extension.
  const std::string& Name() const { return this->Staged->Name(); }

  /// What a writer says against the file, without any name that it may begin with.
  std::string Reword(const std::string& text) const;

  /// Runs a step that writes there. What stops it is thrown as a Failure that names the target.
  void Try(const std::function<void()>& step) const;

  /// Writes a text there. Throws a Failure that names the target.
  void WriteText(const std::string& text) const;

  /// Lets all take their targets' places, and permissions, or none: what was there before stays if
  /// one of them cannot. Throws a Failure that names this one.
  static void KeepAll(const std::vector<OutputFile*>& files);

private:
  std::unique_ptr<relief::io::StagedFile> Staged;
};

}

#endif

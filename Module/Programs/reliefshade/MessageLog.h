// SPDX-License-Identifier: BSD-3-Clause
#ifndef MessageLog_h
#define MessageLog_h

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace reliefshade
{

/// Keeps what VTK's classes report, as single lines, in place of VTK's own printing of several
/// lines with source files and addresses. Call it once, before anything is reported.
void catchMessages();

/// The first error since the last call, without VTK's decoration; empty if there was none.
std::string takeError();

/// The warnings since the last call, each once.
std::vector<std::string> takeWarnings();

/// Whether there has been an error since the last takeError().
bool hasError();

/// While one lives, what its thread reports is kept apart, and the functions above tell that thread
/// of nothing else. What it has not taken in the end joins what all others report.
class OwnMessages
{
public:
  OwnMessages();
  ~OwnMessages();
  OwnMessages(const OwnMessages&) = delete;
  void operator=(const OwnMessages&) = delete;

  /// What there is now is told otherwise.
  void Forget();

private:
  struct Kept;
  std::unique_ptr<Kept> Mine;
};

/// A reader's or writer's error without the beginning that names the file, and the full stop behind
/// it.
std::string withoutName(std::string text, const std::string& file);

/// While one lives, nothing appears on the standard error stream. libpng, beneath OpenImageIO,
/// prints there what is reported as well.
class Silence
{
public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  void operator=(const Silence&) = delete;

private:
  int Saved = -1;
};

/// The text as one line: runs of white space become single blanks.
std::string oneLine(const std::string& text);

/// Runs a step that is about a file. Whatever stops it comes out as a Failure; one that names no
/// other file names this one.
void aboutFile(const std::string& file, const std::function<void()>& step);

}

#endif

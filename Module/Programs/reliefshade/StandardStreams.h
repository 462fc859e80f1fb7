// SPDX-License-Identifier: BSD-3-Clause
#ifndef StandardStreams_h
#define StandardStreams_h

#include <filesystem>
#include <string>

namespace reliefshade
{

/// Whether a raster's name says that its bytes come through the standard input: "-", "/dev/stdin",
/// or GDAL's "/vsistdin/", also within another name ("/vsigzip//vsistdin/").
bool isStandardInput(const std::string& name);

/// Whether a picture is to go to the standard output: "-", "/dev/stdout" or GDAL's "/vsistdout/".
bool isStandardOutput(const std::string& name);

/// The file that the shell has put behind one of these streams, 0 or 1; empty for pipes and all
/// else that has no name.
std::string fileOfStream(int stream);

/// Names for the standard streams. Readers go back and forth in a file and so do writers, and a
/// picture is to come whole or not at all: both streams are kept in a folder of their own among the
/// temporary files, which goes with this object.
class StandardStreams
{
public:
  /// Throws a Failure if there is no place for the folder.
  StandardStreams();
  ~StandardStreams();
  StandardStreams(const StandardStreams&) = delete;
  void operator=(const StandardStreams&) = delete;

  /// Reads the standard input to its end. Returns the name of the raster with what is now a file in
  /// place of the stream. Throws a Failure, also if nothing came.
  std::string Receive(const std::string& name);

  /// From now on everything that is printed goes to the standard error stream: the standard output
  /// is the picture's alone. Returns the name of the file to write it to. Throws a Failure.
  std::string Reserve(const std::string& extension);

  /// The file that the shell has put behind the standard output; empty for a pipe.
  const std::string& GetFile() const { return this->Behind; }

  /// Copies that file to the standard output. Throws a Failure, also if nobody reads it.
  void Send() const;

private:
  std::filesystem::path Folder;
  std::filesystem::path Picture;
  std::string Behind;
  int Output = -1; // what was the standard output
};

/// Puts one line of a message on the standard error stream, with the streams' names in place of
/// their files'.
void say(const std::string& text);

}

#endif

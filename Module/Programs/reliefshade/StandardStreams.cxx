// SPDX-License-Identifier: BSD-3-Clause
#include "StandardStreams.h"

#include "Failure.h"
#include "FileGuard.h"
#include "MessageLog.h"
#include "SameFile.h"
#include "TemporaryFile.h"
#include "Watch.h"

#include <vtksys/FStream.hxx>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <random>
#include <system_error>
#include <vector>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#else
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace fs = std::filesystem;

namespace
{

using namespace reliefshade;

const char* const InputName = "/vsistdin/";
const char* const OutputName = "/vsistdout/";
const char* const InputFile = "vsistdin";
const char* const OutputFile = "vsistdout";
const char* const FolderBeginning = "reliefshade-";
constexpr std::size_t ChunkBytes = 1 << 20;

#ifdef _WIN32
constexpr int StandardInput = 0;
constexpr int StandardOutput = 1;
constexpr int StandardError = 2;

bool isTerminal(int stream)
{
  return _isatty(stream) != 0;
}

void wait(int, bool) {}

long readSome(int stream, char* buffer, std::size_t size)
{
  return _read(stream, buffer, static_cast<unsigned int>(size));
}

long writeSome(int stream, const char* buffer, std::size_t size)
{
  return _write(stream, buffer, static_cast<unsigned int>(size));
}

int copyOf(int stream)
{
  return _dup(stream);
}

void replace(int stream, int by)
{
  _dup2(by, stream);
}

void makeBinary(int stream)
{
  _setmode(stream, _O_BINARY);
}

std::size_t writableBytes(int)
{
  return ChunkBytes;
}
#else
constexpr int StandardInput = STDIN_FILENO;
constexpr int StandardOutput = STDOUT_FILENO;
constexpr int StandardError = STDERR_FILENO;

bool isTerminal(int stream)
{
  return isatty(stream) != 0;
}

/// Until a stream can be read or written, or the run is interrupted: reading and writing
/// themselves go on waiting then.
void wait(int stream, bool forWriting)
{
  pollfd polled{ stream, static_cast<short>(forWriting ? POLLOUT : POLLIN), 0 };
  const int milliseconds = 200;
  do
  {
    stopIfInterrupted();
  } while (poll(&polled, 1, milliseconds) <= 0);
  stopIfInterrupted();
}

long readSome(int stream, char* buffer, std::size_t size)
{
  return read(stream, buffer, size);
}

long writeSome(int stream, const char* buffer, std::size_t size)
{
  return write(stream, buffer, size);
}

int copyOf(int stream)
{
  return dup(stream);
}

void replace(int stream, int by)
{
  dup2(by, stream);
}

void makeBinary(int) {}

/// How much can be written without being held up once it can be written to.
std::size_t writableBytes(int stream)
{
  struct stat status;
  const bool isFile = fstat(stream, &status) == 0 && S_ISREG(status.st_mode);
  return isFile ? ChunkBytes : 4096; // of a pipe, see PIPE_BUF
}
#endif

//------------------------------------------------------------------------------
/// A new folder that nobody else uses.
fs::path makeFolder()
{
  std::error_code code;
  const fs::path place = fs::temp_directory_path(code);
  std::random_device random;
  for (int attempt = 0; attempt < 100 && !code; ++attempt)
  {
    const fs::path folder = place / (FolderBeginning + std::to_string(random()));
    if (fs::create_directory(folder, code))
    {
      fs::permissions(folder, fs::perms::owner_all, code);
      return folder;
    }
  }
  const char* const wanted = std::getenv("TMPDIR");
  throw Failure(wanted ? wanted : place.string(),
    "no folder for temporary files can be made there" + (code ? ": " + code.message() : "") +
      "; TMPDIR names another place");
}

//------------------------------------------------------------------------------
void copyStream(int stream, relief::io::TemporaryFile& file)
{
  std::vector<char> chunk(ChunkBytes);
  for (;;)
  {
    wait(stream, false);
    const long count = readSome(stream, chunk.data(), chunk.size());
    if (count < 0 && errno == EINTR)
    {
      continue;
    }
    if (count < 0)
    {
      throw Failure(InputName, std::string("cannot be read: ") + std::strerror(errno));
    }
    if (count == 0)
    {
      return;
    }
    if (file.Write(chunk.data(), static_cast<std::size_t>(count)) !=
      static_cast<std::size_t>(count))
    {
      return; // Finish() tells why
    }
  }
}

//------------------------------------------------------------------------------
/// Whether a word of a message is the name of a file in the streams' folder, perhaps without its
/// middle.
bool names(const std::string& word, const char* file)
{
  const std::size_t at = word.rfind(file);
  return at != std::string::npos &&
    (word.find(FolderBeginning) < at || word.find("...") < at ||
      word.find(".vsistd") != std::string::npos);
}

//------------------------------------------------------------------------------
/// Whether a name leads to one of GDAL's streams, perhaps through others of its file systems, and
/// not to a file in a folder of that name.
bool goesThrough(const std::string& name, const std::string& stream)
{
  const std::size_t at = name.find(stream);
  return at != std::string::npos && at < relief::io::BeginOfPath(name);
}

//------------------------------------------------------------------------------
/// A message with the streams' names in place of their files'.
std::string withStreamNames(const std::string& text)
{
  std::string result;
  const char* const marks = " \"'";
  for (std::size_t begin = 0; begin < text.size();)
  {
    std::size_t end = text.find_first_of(marks, begin);
    end = end == std::string::npos ? text.size() : end + 1;
    std::string word = text.substr(begin, end - begin);
    for (const auto& [file, name] :
      { std::make_pair(InputFile, InputName), std::make_pair(OutputFile, OutputName) })
    {
      if (names(word, file))
      {
        const std::size_t behind = word.find_last_not_of(" \"':,;.") + 1;
        // What goes before the folder, as in "/vsigzip//tmp/...", is left out, too.
        word = name + word.substr(behind);
      }
    }
    result += word;
    begin = end;
  }
  return result;
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
bool isStandardInput(const std::string& name)
{
  return name == "-" || name == "/dev/stdin" || goesThrough(name, InputName);
}

//------------------------------------------------------------------------------
bool isStandardOutput(const std::string& name)
{
  return name == "-" || name == "/dev/stdout" || goesThrough(name, OutputName);
}

//------------------------------------------------------------------------------
std::string fileOfStream(int stream)
{
  std::error_code code;
  const fs::path name = "/dev/fd/" + std::to_string(stream);
  const bool isFile = fs::is_regular_file(name, code);
  const fs::path file = isFile ? fs::canonical(name, code) : fs::path();
  return code ? std::string() : file.string();
}

//------------------------------------------------------------------------------
StandardStreams::StandardStreams()
  : Folder(makeFolder())
{
}

//------------------------------------------------------------------------------
StandardStreams::~StandardStreams()
{
  std::error_code ignored;
  fs::remove_all(this->Folder, ignored);
}

//------------------------------------------------------------------------------
std::string StandardStreams::Receive(const std::string& name)
{
  if (isTerminal(StandardInput))
  {
    throw Failure(
      "INPUT", "the standard input is a terminal; expected a raster through a pipe", UsageFailure);
  }
  makeBinary(StandardInput);
  const std::string staged = (this->Folder / InputFile).string();
  relief::io::TemporaryFile file(staged, false);
  copyStream(StandardInput, file);
  const std::int64_t size = file.Size();
  if (const int error = file.Finish())
  {
    throw Failure(InputName,
      "cannot be kept in " + this->Folder.parent_path().string() + ": " + std::strerror(error) +
        "; TMPDIR names another place");
  }
  if (size == 0)
  {
    throw Failure(InputName, "nothing came; look whether what comes before it has failed");
  }
  file.Keep();
  const std::size_t at = name.find(InputName);
  return at == std::string::npos
    ? staged
    : name.substr(0, at) + staged + name.substr(at + std::strlen(InputName));
}

//------------------------------------------------------------------------------
std::string StandardStreams::Reserve(const std::string& extension)
{
  if (isTerminal(StandardOutput))
  {
    throw Failure("OUTPUT",
      "the standard output is a terminal; expected a pipe, or a file behind >", UsageFailure);
  }
  this->Behind = fileOfStream(StandardOutput);
  std::fflush(stdout);
  this->Output = copyOf(StandardOutput);
  if (this->Output < 0)
  {
    throw Failure(OutputName, std::string("cannot be written: ") + std::strerror(errno));
  }
  replace(StandardOutput, StandardError);
  makeBinary(this->Output);
#ifndef _WIN32
  std::signal(SIGPIPE, SIG_IGN); // Send() tells when nobody reads
#endif
  this->Picture = this->Folder / (OutputFile + extension);
  return this->Picture.string();
}

//------------------------------------------------------------------------------
void StandardStreams::Send() const
{
  vtksys::ifstream file(this->Picture.string().c_str(), std::ios::binary);
  std::vector<char> chunk(writableBytes(this->Output));
  while (file)
  {
    file.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    const auto size = static_cast<std::size_t>(file.gcount());
    for (std::size_t done = 0; done < size;)
    {
      wait(this->Output, true);
      const long count = writeSome(this->Output, chunk.data() + done, size - done);
      if (count < 0 && errno != EINTR)
      {
        throw Failure(OutputName, std::string("cannot be written: ") + std::strerror(errno));
      }
      done += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
  }
  if (!file.eof())
  {
    throw Failure(OutputName, "cannot be written: the temporary file is gone");
  }
}

//------------------------------------------------------------------------------
void say(const std::string& text)
{
  showProgress(true, "", 1.0); // clears the line
  std::cerr << "reliefshade: " << relief::io::Brief(withStreamNames(oneLine(text))) << std::endl;
}

}

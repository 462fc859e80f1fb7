// SPDX-License-Identifier: BSD-3-Clause
#include "RunFolder.h"

#include "FileGuard.h"
#include "SameFile.h"
#include "StagedFile.h"

#include "vtkErrorCode.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <sstream>
#include <vector>

#ifdef _WIN32
#include <windows.h>
#else
#include <csignal>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace fs = std::filesystem;

namespace relief::streaming
{
namespace
{
constexpr const char* LockName = "lock";

//------------------------------------------------------------------------------
io::Failure Refusal(const fs::path& folder, const std::string& reason)
{
  return { vtkErrorCode::CannotOpenFileError,
    io::Shortened(folder.string(), io::LongestName) + ": " + reason };
}

//------------------------------------------------------------------------------
std::string TextOf(const fs::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

//------------------------------------------------------------------------------
/// What UnfinishedOf() finds, and the number of the process.
std::string TargetOf(const std::string& name, std::string& process)
{
  // With what GDAL writes beside a cloud-optimized file.
  static const std::regex form(
    "\\.(.+(\\.[^.]+))\\.([0-9]+)-[0-9]+\\.tmp(\\.[^.]+)((\\.msk)?\\.ovr\\.tmp)?");
  std::smatch parts;
  if (!std::regex_match(name, parts, form) || (parts[4] != parts[2] && parts[4] != ".old"))
  {
    return std::string();
  }
  process = parts[3];
  return parts[1];
}

//------------------------------------------------------------------------------
bool IsRunning(const std::string& process)
{
#ifdef _WIN32
  (void)process;
  return false; // whose open files cannot be removed there
#else
  return kill(static_cast<pid_t>(std::atol(process.c_str())), 0) == 0 || errno == EPERM;
#endif
}

//------------------------------------------------------------------------------
/// Removes what processes have left that were to write a file.
void RemoveStaged(
  const fs::path& target, const std::function<bool(const std::string& process)>& isLeft)
{
  std::error_code ignored;
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(
         target.has_parent_path() ? target.parent_path() : fs::path("."), ignored))
  {
    std::string process;
    if (TargetOf(entry.path().filename().string(), process) == target.filename().string() &&
      isLeft(process))
    {
      left.push_back(entry.path());
    }
  }
  for (const fs::path& one : left)
  {
    fs::remove(one, ignored);
  }
}

//------------------------------------------------------------------------------
/// The first line in which two texts differ, as each of them has it.
void FindDifference(
  const std::string& one, const std::string& other, std::string& ofOne, std::string& ofOther)
{
  std::istringstream first(one);
  std::istringstream second(other);
  for (;;)
  {
    const bool more = static_cast<bool>(std::getline(first, ofOne));
    const bool otherMore = static_cast<bool>(std::getline(second, ofOther));
    ofOne = more ? ofOne : "nothing";
    ofOther = otherMore ? ofOther : "nothing";
    if (ofOne != ofOther || (!more && !otherMore))
    {
      return;
    }
  }
}
}

//------------------------------------------------------------------------------
/// A file that only one process has, until that ends.
class RunFolder::Lock
{
public:
  explicit Lock(const fs::path& folder)
    : File(folder / LockName)
  {
#ifdef _WIN32
    this->Handle = CreateFileW(this->File.c_str(), GENERIC_WRITE | DELETE, 0, nullptr, OPEN_ALWAYS,
      FILE_FLAG_DELETE_ON_CLOSE, nullptr);
    if (this->Handle == INVALID_HANDLE_VALUE)
    {
      throw Refusal(folder,
        GetLastError() == ERROR_SHARING_VIOLATION ? Taken() : "it cannot be locked for this run");
    }
#else
    // A run that removes its folder takes the file away under whoever has just opened it.
    for (bool ours = false; !ours;)
    {
      this->Open(folder);
      struct stat opened = {};
      struct stat named = {};
      ours = fstat(this->Handle, &opened) == 0 && stat(this->File.c_str(), &named) == 0 &&
        opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
      if (!ours)
      {
        close(this->Handle);
      }
    }
#endif
  }
  ~Lock()
  {
#ifdef _WIN32
    CloseHandle(this->Handle);
#else
    // While it is held: whoever has opened it before looks whether it is still there.
    std::error_code ignored;
    fs::remove(this->File, ignored);
    close(this->Handle);
#endif
  }
  Lock(const Lock&) = delete;
  void operator=(const Lock&) = delete;

private:
  static std::string Taken()
  {
    return "another run is writing there; wait for its end, or name another folder";
  }
#ifdef _WIN32
  HANDLE Handle = INVALID_HANDLE_VALUE;
#else
  void Open(const fs::path& folder)
  {
    this->Handle = open(this->File.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (this->Handle < 0)
    {
      throw Refusal(folder, std::string("it cannot be written: ") + std::strerror(errno));
    }
    if (flock(this->Handle, LOCK_EX | LOCK_NB) != 0)
    {
      const int error = errno;
      close(this->Handle);
      throw Refusal(folder,
        error == EWOULDBLOCK ? Taken()
                             : std::string("it cannot be locked for this run: ") +
            std::strerror(error) + "; name a folder on another file system");
    }
  }
  int Handle = -1;
#endif
  fs::path File;
};

//------------------------------------------------------------------------------
RunFolder::RunFolder(const std::string& folder, const std::string& key, Part part)
  : Folder(folder)
{
  std::error_code code;
  if (part == Alone && !fs::is_directory(this->Folder, code))
  {
    fs::create_directory(this->Folder, code);
    if (code || !fs::is_directory(this->Folder))
    {
      throw Refusal(
        this->Folder, "the folder cannot be made: " + (code ? code.message() : "a file is there"));
    }
  }
  if (part == Alone)
  {
    this->Locked = std::make_unique<Lock>(this->Folder);
  }
  this->CheckKey(key, part == Alone);
}

//------------------------------------------------------------------------------
RunFolder::~RunFolder() = default;

//------------------------------------------------------------------------------
void RunFolder::CheckKey(const std::string& key, bool write) const
{
  const std::string text = !key.empty() && key.back() == '\n' ? key : key + "\n";
  const fs::path file = this->Folder / KeyName;
  std::error_code code;
  if (fs::exists(file, code))
  {
    const std::string there = TextOf(file);
    if (there != text)
    {
      std::string old;
      std::string asked;
      FindDifference(there, text, old, asked);
      throw Refusal(this->Folder,
        "it is of another run: \"" + io::Shortened(old) + "\" there, \"" + io::Shortened(asked) +
          "\" here; remove it, or run as before");
    }
    return;
  }
  if (!write)
  {
    throw Refusal(this->Folder, "no run is there that could be joined");
  }
  // Who has the lock is the only one that writes it, whatever other process has that number now.
  RemoveStaged(file, [](const std::string&) { return true; });
  try
  {
    io::StagedFile staged(file.string());
    std::ofstream stream(staged.Name(), std::ios::binary);
    stream << text;
    stream.close();
    if (!stream)
    {
      throw io::Failure(vtkErrorCode::OutOfDiskSpaceError, std::strerror(errno));
    }
    staged.Keep();
  }
  catch (const io::Failure& failure)
  {
    throw io::Failure(failure.Code,
      Refusal(this->Folder, std::string("it cannot be written: ") + failure.what()).what());
  }
}

//------------------------------------------------------------------------------
std::string RunFolder::UnfinishedOf(const std::string& name)
{
  std::string process;
  return TargetOf(name, process);
}

//------------------------------------------------------------------------------
void RunFolder::RemoveUnfinished(const std::string& file)
{
  RemoveStaged(
    io::FollowLinks(file), [](const std::string& process) { return !IsRunning(process); });
}

//------------------------------------------------------------------------------
// The lock last: whoever comes then begins anew.
void RunFolder::Remove()
{
  std::error_code ignored;
  fs::remove(this->Folder / KeyName, ignored);
  this->Locked.reset();
  fs::remove(this->Folder, ignored); // which leaves it where anything is in it
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "StagedFile.h"

#include "FileGuard.h"
#include "SameFile.h"

#include "vtkErrorCode.h"

#include <vtksys/SystemTools.hxx>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#ifdef _WIN32
#include <process.h>
#else
#include <unistd.h>
#endif

namespace fs = std::filesystem;

namespace relief::io
{
using vtksys::SystemTools;

namespace
{
long ProcessNumber()
{
#ifdef _WIN32
  return _getpid();
#else
  return getpid();
#endif
}

std::string NewName()
{
  static std::atomic<unsigned int> count{ 0 };
  return std::to_string(ProcessNumber()) + "-" + std::to_string(count++) + ".tmp";
}

Failure Refusal(const std::string& reason)
{
  return { vtkErrorCode::CannotOpenFileError, reason };
}
}

//------------------------------------------------------------------------------
StagedFile::StagedFile(const std::string& target)
  : Given(target)
  , Place(FollowLinks(target))
{
  std::error_code code;
  if (fs::is_symlink(this->Place, code))
  {
    throw Refusal("is a link that leads round in circles");
  }
  if (SystemTools::FileIsDirectory(this->Place))
  {
    throw Refusal("is a directory, not a file");
  }
  // A rename would replace a device's name as well as a file's.
  if (fs::exists(this->Place, code) &&
    (!fs::is_regular_file(this->Place, code) ||
      !SystemTools::TestFileAccess(this->Place, vtksys::TEST_FILE_WRITE)))
  {
    throw Refusal("is not a file, or may not be written");
  }
  const fs::path path(this->Place);
  const fs::path directory = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(directory, code))
  {
    throw Refusal("the place cannot be written: there is no directory " +
      Shortened(directory.string(), LongestName));
  }
  const std::string beginning = "." + path.filename().string() + "." + NewName();
  const fs::path folder = path.parent_path();
  this->Staged = (folder / (beginning + path.extension().string())).string();
  this->Backup = (folder / (beginning + ".old")).string();
}

//------------------------------------------------------------------------------
StagedFile::~StagedFile()
{
  std::error_code ignored;
  if (!this->Kept)
  {
    fs::remove(this->Staged, ignored);
  }
  fs::remove(this->Backup, ignored);
}

//------------------------------------------------------------------------------
std::string StagedFile::Reword(std::string text) const
{
  SystemTools::ReplaceString(text, this->Staged, this->Given);
  return OneLine(text);
}

//------------------------------------------------------------------------------
void StagedFile::Keep()
{
  std::error_code code;
  const fs::file_status old = fs::status(this->Place, code);
  this->Existed = fs::is_regular_file(old);
  if (this->Existed)
  {
    fs::permissions(this->Staged, old.permissions(), code);
  }
  fs::rename(this->Staged, this->Place, code);
  if (code)
  {
    throw Refusal("cannot be replaced: " + code.message());
  }
  this->Kept = true;
}

//------------------------------------------------------------------------------
void StagedFile::KeepOld()
{
  std::error_code code;
  if (fs::is_regular_file(this->Place, code))
  {
    fs::remove(this->Backup, code);
    // A second name for what is replaced. Where the file system has no such thing, it is copied.
    fs::create_hard_link(this->Place, this->Backup, code);
    if (code)
    {
      fs::copy_file(this->Place, this->Backup, code);
    }
    if (code)
    {
      throw Refusal("cannot be kept while others are written: " + code.message());
    }
  }
}

//------------------------------------------------------------------------------
void StagedFile::Undo()
{
  std::error_code ignored;
  if (this->Existed)
  {
    fs::rename(this->Backup, this->Place, ignored);
  }
  else
  {
    fs::remove(this->Place, ignored);
  }
}

//------------------------------------------------------------------------------
StagedFile* StagedFile::KeepAll(const std::vector<StagedFile*>& files, std::string& reason)
{
  for (StagedFile* file : files)
  {
    try
    {
      file->KeepOld();
      file->Keep();
    }
    catch (const Failure& failure)
    {
      for (StagedFile* other : files)
      {
        if (other->Kept)
        {
          other->Undo();
        }
      }
      reason = failure.what();
      return file;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
void CheckPlace(const std::string& name)
{
  FILE* file = SystemTools::Fopen(name, "wb");
  if (!file)
  {
    throw Refusal(std::string("the place cannot be written: ") + std::strerror(errno));
  }
  std::fclose(file);
}
}

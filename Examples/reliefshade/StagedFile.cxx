// SPDX-License-Identifier: BSD-3-Clause
#include "StagedFile.h"

#include "Failure.h"
#include "MessageLog.h"
#include "Watch.h"

#include <vtksys/SystemTools.hxx>

namespace fs = std::filesystem;

namespace reliefshade
{

//------------------------------------------------------------------------------
StagedFile::StagedFile(const std::string& target)
  : Given(target)
  , Place(fs::is_symlink(target) ? fs::weakly_canonical(target) : fs::path(target))
{
  std::error_code code;
  if (fs::is_directory(this->Place, code))
  {
    throw Failure(target, "is a directory");
  }
  // A rename would replace a device's name as well as a file's.
  if (fs::exists(this->Place, code) &&
    (!fs::is_regular_file(this->Place, code) ||
      !vtksys::SystemTools::TestFileAccess(this->Place.string(), vtksys::TEST_FILE_WRITE)))
  {
    throw Failure(target, "is not a file, or may not be written");
  }
  const fs::path directory = this->Place.has_parent_path() ? this->Place.parent_path() : ".";
  if (!fs::is_directory(directory, code))
  {
    throw Failure(target, "there is no directory " + directory.string());
  }
  static int count = 0;
  const std::string hidden =
    ".reliefshade-" + std::to_string(processNumber()) + "-" + std::to_string(++count);
  this->Path = directory / (hidden + this->Place.extension().string());
  this->Backup = directory / (hidden + ".old");
}

//------------------------------------------------------------------------------
StagedFile::~StagedFile()
{
  std::error_code ignored;
  fs::remove(this->Path, ignored);
  fs::remove(this->Backup, ignored);
}

//------------------------------------------------------------------------------
std::string StagedFile::Reword(std::string text) const
{
  vtksys::SystemTools::ReplaceString(text, this->Name(), this->Given);
  return withoutName(text, this->Given);
}

//------------------------------------------------------------------------------
void StagedFile::Keep()
{
  std::error_code code;
  const fs::file_status old = fs::status(this->Place, code);
  this->Existed = fs::is_regular_file(old);
  if (this->Existed)
  {
    fs::permissions(this->Path, old.permissions(), code);
    fs::remove(this->Backup, code);
    // A second name for what is replaced. Where the file system has no such thing, it is moved.
    fs::create_hard_link(this->Place, this->Backup, code);
    if (code)
    {
      fs::rename(this->Place, this->Backup, code);
    }
  }
  fs::rename(this->Path, this->Place, code);
  if (code)
  {
    this->Undo();
    throw Failure(this->Given, "cannot be replaced: " + code.message());
  }
  this->Kept = true;
}

//------------------------------------------------------------------------------
void StagedFile::Undo()
{
  std::error_code ignored;
  if (this->Existed)
  {
    fs::rename(this->Backup, this->Place, ignored);
  }
  else if (this->Kept)
  {
    fs::remove(this->Place, ignored);
  }
}

//------------------------------------------------------------------------------
void StagedFile::KeepAll(const std::vector<StagedFile*>& files)
{
  try
  {
    for (StagedFile* file : files)
    {
      file->Keep();
    }
  }
  catch (const Failure&)
  {
    for (StagedFile* file : files)
    {
      if (file->Kept)
      {
        file->Undo();
      }
    }
    throw;
  }
}

}

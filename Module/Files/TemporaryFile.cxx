// SPDX-License-Identifier: BSD-3-Clause
#include "TemporaryFile.h"

#include "FileGuard.h"

#include "vtkErrorCode.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace relief::io
{
using vtksys::SystemTools;

namespace
{
bool MoveTo(FILE* file, std::int64_t offset)
{
#ifdef _WIN32
  return _fseeki64(file, offset, SEEK_SET) == 0;
#else
  return fseeko(file, static_cast<off_t>(offset), SEEK_SET) == 0;
#endif
}
}

//------------------------------------------------------------------------------
TemporaryFile::TemporaryFile(const std::string& target, bool staged)
  : Target(target)
  , Place(staged ? std::make_unique<StagedFile>(target) : nullptr)
{
  this->File = SystemTools::Fopen(this->Name(), "w+b");
  if (!this->File)
  {
    throw Failure(vtkErrorCode::CannotOpenFileError,
      std::string("the place cannot be written: ") + std::strerror(errno));
  }
}

//------------------------------------------------------------------------------
TemporaryFile::~TemporaryFile()
{
  this->Finish();
  if (!this->Kept && !this->Place)
  {
    SystemTools::RemoveFile(this->Target);
  }
}

//------------------------------------------------------------------------------
std::string TemporaryFile::Reword(const std::string& text) const
{
  return this->Place ? this->Place->Reword(text) : OneLine(text);
}

//------------------------------------------------------------------------------
// Moving writes what is still buffered, so it can fail like writing.
bool TemporaryFile::Seek(std::int64_t offset)
{
  this->Offset = offset;
  const bool moved = this->File && MoveTo(this->File, offset);
  if (!moved && this->Error == 0)
  {
    this->Error = errno;
  }
  return moved;
}

//------------------------------------------------------------------------------
std::size_t TemporaryFile::Read(void* buffer, std::size_t size)
{
  // Between writing and reading, and the other way round, the C library wants a move.
  if (!this->Seek(this->Offset))
  {
    return 0;
  }
  const std::size_t count = std::fread(buffer, 1, size, this->File);
  this->Seek(this->Offset + static_cast<std::int64_t>(count));
  return count;
}

//------------------------------------------------------------------------------
std::size_t TemporaryFile::Write(const void* buffer, std::size_t size)
{
  // Nothing at all may come as a null pointer, which the C library does not take.
  const std::size_t written = this->File && size > 0 ? std::fwrite(buffer, 1, size, this->File) : 0;
  if (written != size && this->Error == 0)
  {
    this->Error = errno;
  }
  this->Offset += static_cast<std::int64_t>(written);
  this->End = std::max(this->End, this->Offset);
  return written;
}

//------------------------------------------------------------------------------
int TemporaryFile::Finish()
{
  if (this->File)
  {
    const int result = std::fclose(this->File);
    this->File = nullptr;
    if (result != 0 && this->Error == 0)
    {
      this->Error = errno;
    }
  }
  return this->Error;
}

//------------------------------------------------------------------------------
void TemporaryFile::Keep()
{
  if (this->Place)
  {
    this->Place->Keep();
  }
  this->Kept = true;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFileAccess.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkType.h"

#include <vtksys/SystemInformation.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <new>
#include <sstream>
#include <type_traits>

namespace relief::io
{
using OIIO::TypeDesc;
using vtksys::SystemTools;

namespace
{
std::string RealName(const std::string& name)
{
  return SystemTools::FileIsSymlink(name) ? SystemTools::GetRealPath(name) : name;
}

std::string TemporaryName(const std::string& target)
{
  static std::atomic<unsigned int> count{ 0 };
  static const auto process = vtksys::SystemInformation().GetProcessId();
  std::string directory = SystemTools::GetFilenamePath(target);
  if (!directory.empty() && directory.back() != '/')
  {
    directory += '/';
  }
  return directory + "." + SystemTools::GetFilenameName(target) + "." + std::to_string(process) +
    "-" + std::to_string(count++) + ".tmp" + SystemTools::GetFilenameLastExtension(target);
}
}

//------------------------------------------------------------------------------
std::string OneLine(const std::string& text)
{
  const size_t longest = 400;
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);)
  {
    line.erase(line.find_last_not_of(" .\r") + 1);
    if (!line.empty())
    {
      result += (result.empty() ? "" : "; ") + line;
    }
  }
  if (result.size() > longest)
  {
    result = result.substr(0, longest) + " ...";
  }
  return result.empty() ? "OpenImageIO gives no reason" : result;
}

//------------------------------------------------------------------------------
unsigned long Guard(const std::function<void()>& step, std::string& reason)
{
  try
  {
    step();
    return vtkErrorCode::NoError;
  }
  catch (const Failure& failure)
  {
    reason = failure.what();
    return failure.Code;
  }
  catch (const Aborted&)
  {
    return vtkErrorCode::UserError;
  }
  catch (const std::bad_alloc&)
  {
    reason = "there is not enough memory";
  }
  catch (const std::exception& exception)
  {
    reason = OneLine(exception.what());
  }
  catch (...)
  {
    reason = "an unknown exception was thrown";
  }
  return vtkErrorCode::UnknownError;
}

//------------------------------------------------------------------------------
void CheckImage(const std::string& fileName, vtkImageData* image)
{
  if (fileName.empty())
  {
    throw Failure(vtkErrorCode::NoFileNameError, "no file name is set");
  }
  if (!image || image->GetNumberOfPoints() < 1)
  {
    throw Failure(vtkErrorCode::UnknownError, "the input image is empty");
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (!scalars || scalars->GetNumberOfTuples() < image->GetNumberOfPoints())
  {
    throw Failure(vtkErrorCode::UnknownError, "the input image has no scalars");
  }
  int dimensions[3];
  image->GetDimensions(dimensions);
  if (dimensions[2] != 1)
  {
    throw Failure(vtkErrorCode::UnknownError,
      "the input image has " + std::to_string(dimensions[2]) + " slices; one is written");
  }
}

//------------------------------------------------------------------------------
vtkTypeInt64 PhysicalMemory()
{
  static const vtkTypeInt64 memory = vtksys::SystemInformation().GetHostMemoryTotal();
  return memory > 0 ? memory : vtkTypeInt64(64) << 20; // where the system does not tell
}

//------------------------------------------------------------------------------
int VTKType(OIIO::TypeDesc type)
{
  switch (type.basetype)
  {
    case TypeDesc::UINT8:
      return VTK_UNSIGNED_CHAR;
    case TypeDesc::INT8:
      return VTK_SIGNED_CHAR;
    case TypeDesc::UINT16:
      return VTK_UNSIGNED_SHORT;
    case TypeDesc::INT16:
      return VTK_SHORT;
    case TypeDesc::UINT32:
      return VTK_UNSIGNED_INT;
    case TypeDesc::INT32:
      return VTK_INT;
    case TypeDesc::UINT64:
      return VTK_UNSIGNED_LONG_LONG;
    case TypeDesc::INT64:
      return VTK_LONG_LONG;
    case TypeDesc::HALF:
    case TypeDesc::FLOAT:
      return VTK_FLOAT;
    case TypeDesc::DOUBLE:
      return VTK_DOUBLE;
    default:
      return VTK_VOID;
  }
}

//------------------------------------------------------------------------------
OIIO::TypeDesc FileType(int vtkType)
{
  switch (vtkType)
  {
    case VTK_CHAR:
      return std::is_signed<char>::value ? TypeDesc::INT8 : TypeDesc::UINT8;
    case VTK_SIGNED_CHAR:
      return TypeDesc::INT8;
    case VTK_UNSIGNED_CHAR:
      return TypeDesc::UINT8;
    case VTK_SHORT:
      return TypeDesc::INT16;
    case VTK_UNSIGNED_SHORT:
      return TypeDesc::UINT16;
    case VTK_INT:
      return TypeDesc::INT32;
    case VTK_UNSIGNED_INT:
      return TypeDesc::UINT32;
    case VTK_LONG:
      return sizeof(long) == 8 ? TypeDesc::INT64 : TypeDesc::INT32;
    case VTK_UNSIGNED_LONG:
      return sizeof(long) == 8 ? TypeDesc::UINT64 : TypeDesc::UINT32;
    case VTK_LONG_LONG:
      return TypeDesc::INT64;
    case VTK_UNSIGNED_LONG_LONG:
      return TypeDesc::UINT64;
    case VTK_ID_TYPE:
      return sizeof(vtkIdType) == 8 ? TypeDesc::INT64 : TypeDesc::INT32;
    case VTK_FLOAT:
      return TypeDesc::FLOAT;
    case VTK_DOUBLE:
      return TypeDesc::DOUBLE;
    default:
      return TypeDesc::UNKNOWN;
  }
}

//------------------------------------------------------------------------------
TemporaryFile::TemporaryFile(const std::string& target)
  : IOProxy(TemporaryName(RealName(target)), Write)
  , Target(RealName(target))
{
  // A rename would replace a directory's or a device's name as well as a file's.
  if (SystemTools::FileExists(this->Target) &&
    (!OIIO::Filesystem::is_regular(this->Target) ||
      !SystemTools::TestFileAccess(this->Target, vtksys::TEST_FILE_WRITE)))
  {
    throw Failure(
      vtkErrorCode::CannotOpenFileError, "what has this name is not a file, or may not be written");
  }
  this->File = SystemTools::Fopen(this->filename(), "w+b");
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
  if (!this->Renamed)
  {
    SystemTools::RemoveFile(this->filename());
  }
}

//------------------------------------------------------------------------------
std::string TemporaryFile::Reword(const std::string& text) const
{
  std::string result = text;
  SystemTools::ReplaceString(result, this->filename(), this->Target);
  return OneLine(result);
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
void TemporaryFile::Rename()
{
  mode_t permissions;
  if (SystemTools::GetPermissions(this->Target, permissions))
  {
    SystemTools::SetPermissions(this->filename(), permissions);
  }
  std::string text;
  if (!OIIO::Filesystem::rename(this->filename(), this->Target, text))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError,
      "the temporary file could not be renamed: " + OneLine(text));
  }
  this->Renamed = true;
}

//------------------------------------------------------------------------------
// Moving writes what is still buffered, so it can fail like writing.
bool TemporaryFile::MoveTo(int64_t offset)
{
  const bool moved = this->File && OIIO::Filesystem::fseek(this->File, offset, SEEK_SET) == 0;
  if (!moved && this->Error == 0)
  {
    this->Error = errno;
  }
  return moved;
}

//------------------------------------------------------------------------------
size_t TemporaryFile::Put(const void* buffer, size_t size, int64_t offset)
{
  // Nothing at all may come as a null pointer, which the C library does not take.
  const size_t written = this->File && size > 0 ? std::fwrite(buffer, 1, size, this->File) : 0;
  if (written != size && this->Error == 0)
  {
    this->Error = errno;
  }
  this->Size = std::max(this->Size, offset + static_cast<int64_t>(written));
  return written;
}

//------------------------------------------------------------------------------
bool TemporaryFile::seek(int64_t offset)
{
  std::lock_guard<std::mutex> lock(this->Mutex);
  this->m_pos = offset;
  return this->MoveTo(offset);
}

//------------------------------------------------------------------------------
size_t TemporaryFile::read(void* buffer, size_t size)
{
  std::lock_guard<std::mutex> lock(this->Mutex);
  // Between writing and reading, and the other way round, the C library wants a move.
  if (!this->MoveTo(this->m_pos))
  {
    return 0;
  }
  const size_t count = std::fread(buffer, 1, size, this->File);
  this->m_pos += static_cast<int64_t>(count);
  this->MoveTo(this->m_pos);
  return count;
}

//------------------------------------------------------------------------------
size_t TemporaryFile::write(const void* buffer, size_t size)
{
  std::lock_guard<std::mutex> lock(this->Mutex);
  const size_t written = this->Put(buffer, size, this->m_pos);
  this->m_pos += static_cast<int64_t>(written);
  return written;
}

//------------------------------------------------------------------------------
size_t TemporaryFile::pwrite(const void* buffer, size_t size, int64_t offset)
{
  std::lock_guard<std::mutex> lock(this->Mutex);
  const size_t written = this->MoveTo(offset) ? this->Put(buffer, size, offset) : 0;
  this->MoveTo(this->m_pos);
  return written;
}
}

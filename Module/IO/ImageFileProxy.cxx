// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFileProxy.h"

#include "TemporaryFile.h"

namespace relief::io
{
//------------------------------------------------------------------------------
ImageFileProxy::ImageFileProxy(TemporaryFile& file)
  : IOProxy(file.Name(), Write)
  , File(file)
{
}

//------------------------------------------------------------------------------
bool ImageFileProxy::opened() const
{
  return this->File.IsOpen();
}

//------------------------------------------------------------------------------
bool ImageFileProxy::seek(int64_t offset)
{
  std::lock_guard<std::mutex> lock(this->Mutex);
  this->m_pos = offset;
  return this->File.Seek(offset);
}

//------------------------------------------------------------------------------
size_t ImageFileProxy::read(void* buffer, size_t size)
{
  std::lock_guard<std::mutex> lock(this->Mutex);
  const size_t count = this->File.Read(buffer, size);
  this->m_pos = this->File.Tell();
  return count;
}

//------------------------------------------------------------------------------
size_t ImageFileProxy::write(const void* buffer, size_t size)
{
  std::lock_guard<std::mutex> lock(this->Mutex);
  const size_t written = this->File.Write(buffer, size);
  this->m_pos = this->File.Tell();
  return written;
}

//------------------------------------------------------------------------------
size_t ImageFileProxy::pwrite(const void* buffer, size_t size, int64_t offset)
{
  std::lock_guard<std::mutex> lock(this->Mutex);
  const size_t written = this->File.Seek(offset) ? this->File.Write(buffer, size) : 0;
  this->File.Seek(this->m_pos);
  return written;
}

//------------------------------------------------------------------------------
size_t ImageFileProxy::size() const
{
  return static_cast<size_t>(this->File.Size());
}
}

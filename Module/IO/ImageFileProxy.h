// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageFileProxy_h
#define ImageFileProxy_h

#include <OpenImageIO/filesystem.h>

#include <mutex>

namespace relief::io
{
class TemporaryFile;

/// Lets OpenImageIO's formats write through a TemporaryFile, which must outlive it.
class ImageFileProxy : public OIIO::Filesystem::IOProxy
{
public:
  explicit ImageFileProxy(TemporaryFile& file);

  const char* proxytype() const override { return "temporary file"; }
  void close() override {} // TemporaryFile::Finish does, so that the result is seen
  bool opened() const override;
  bool seek(int64_t offset) override;
  size_t read(void* buffer, size_t size) override; // TIFF reads its directories back
  size_t write(const void* buffer, size_t size) override;
  size_t pwrite(const void* buffer, size_t size, int64_t offset) override;
  size_t size() const override;

private:
  TemporaryFile& File;
  std::mutex Mutex;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "TiledPicture.h"

#include "FileGuard.h"
#include "ImageFileProxy.h"
#include "TemporaryFile.h"

#include "vtkErrorCode.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace relief::io
{
namespace
{
constexpr int TileSize = 64;
}

struct TiledPicture::Internals
{
  explicit Internals(const std::string& file)
    : File(file, false)
    , Proxy(this->File)
    , Output(OIIO::ImageOutput::create("openexr"))
  {
  }

  std::size_t RowBytes() const
  {
    return static_cast<std::size_t>(this->Spec.width) * this->Spec.nchannels * sizeof(float);
  }
  void WriteTiles(int rows);
  Failure Failed() const
  {
    return { vtkErrorCode::OutOfDiskSpaceError,
      "writing failed: " + this->File.Reword(this->Output->geterror()) };
  }

  TemporaryFile File; // it goes last: the format's writer may write as it goes
  ImageFileProxy Proxy;
  std::unique_ptr<OIIO::ImageOutput> Output;
  OIIO::ImageSpec Spec;
  int Done = 0;           // rows that have been written
  std::vector<char> Rest; // of rows that are no whole tiles yet
};

//------------------------------------------------------------------------------
/// The first rows of those that wait.
void TiledPicture::Internals::WriteTiles(int rows)
{
  if (!this->Output->write_tiles(0, this->Spec.width, this->Done, this->Done + rows, 0, 1,
        OIIO::TypeDesc::FLOAT, this->Rest.data()))
  {
    throw this->Failed();
  }
  this->Done += rows;
  this->Rest.erase(
    this->Rest.begin(), this->Rest.begin() + static_cast<std::ptrdiff_t>(this->RowBytes()) * rows);
}

//------------------------------------------------------------------------------
TiledPicture::TiledPicture(const std::string& file, const int size[2], int components)
  : Internal(std::make_unique<Internals>(file))
{
  Internals& self = *this->Internal;
  self.Spec = OIIO::ImageSpec(size[0], size[1], components, OIIO::TypeDesc::FLOAT);
  self.Spec.tile_width = TileSize;
  self.Spec.tile_height = TileSize;
  if (!self.Output || !self.Output->supports("tiles"))
  {
    throw Failure(
      vtkErrorCode::UnrecognizedFileTypeError, "this OpenImageIO writes no OpenEXR in tiles");
  }
  if (!self.Output->supports("ioproxy") || !self.Output->set_ioproxy(&self.Proxy))
  {
    self.File.Finish();
  }
  if (!self.Output->open(self.File.Name(), self.Spec))
  {
    throw Failure(vtkErrorCode::FileFormatError, self.File.Reword(self.Output->geterror()));
  }
}

//------------------------------------------------------------------------------
TiledPicture::~TiledPicture() = default;

//------------------------------------------------------------------------------
void TiledPicture::Write(int rows, const void* first, std::ptrdiff_t bytes)
{
  Internals& self = *this->Internal;
  const auto rowBytes = static_cast<std::ptrdiff_t>(self.RowBytes());
  const char* next = static_cast<const char*>(first);
  for (int k = 0; k < rows; ++k, next += bytes)
  {
    self.Rest.insert(self.Rest.end(), next, next + rowBytes);
  }
  const int waiting = static_cast<int>(static_cast<std::ptrdiff_t>(self.Rest.size()) / rowBytes);
  const int whole = waiting / TileSize * TileSize;
  if (whole > 0)
  {
    self.WriteTiles(whole);
  }
}

//------------------------------------------------------------------------------
void TiledPicture::Finish()
{
  Internals& self = *this->Internal;
  if (!self.Rest.empty())
  {
    self.WriteTiles(static_cast<int>(self.Rest.size() / self.RowBytes()));
  }
  if (!self.Output->close())
  {
    throw self.Failed();
  }
  if (const int error = self.File.Finish())
  {
    throw Failure(
      vtkErrorCode::OutOfDiskSpaceError, std::string("writing failed: ") + std::strerror(error));
  }
  self.File.Keep();
}
}

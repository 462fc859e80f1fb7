// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageFormats_h
#define ImageFormats_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkImageData;
class vtkImageReader2;
class vtkImageWriter;
class vtkPolyDataAlgorithm;
class vtkReliefScene;

namespace reliefshade
{

struct Drawing;

/// A picture of float numbers that is written some rows at a time, the upper ones first.
class PictureRows
{
public:
  virtual ~PictureRows() = default;

  /// `bytes` are those from one row to the next in memory.
  virtual void Write(int rows, const void* first, std::ptrdiff_t bytes) = 0;
  virtual void Finish() = 0;
};

/// A file of colour and layers that is written some rows at a time, the upper ones first.
class LayerRows
{
public:
  virtual ~LayerRows() = default;

  /// The next rows, the scalars being linear colour, and all of the layers.
  virtual void Write(vtkImageData* part) = 0;
  virtual void Finish() = 0;
};

/// What takes VTK::IOReliefShading, whose 260 libraries of image formats take longer to load than a
/// small raster to shade: pictures in other formats than GeoTIFF, layers for compositing, scenes,
/// meshes, charts.
/// It lies in a library of its own that is loaded when it is first asked for.
class ImageFormats
{
public:
  virtual ~ImageFormats() = default;

  enum class Alpha
  {
    Stored,  ///< as any other component
    Mask,    ///< a mask of heights
    Straight ///< a component beside colours that it does not multiply
  };
  /// A vtkOpenImageIOReader.
  virtual vtkSmartPointer<vtkImageReader2> NewReader(Alpha alpha) const = 0;
  /// The picture and the channel that it is to read: the name of a part or its number, from 1, or
  /// nothing; the name of a channel, or nothing for all.
  virtual void Choose(
    vtkImageReader2* reader, const std::string& part, const std::string& channel) const = 0;
  /// The names of its channels, once it knows the header.
  virtual std::vector<std::string> ChannelNames(vtkImageReader2* reader) const = 0;
  /// Its memory limit, in kibibytes.
  virtual void SetMemoryLimit(vtkImageReader2* reader, vtkTypeInt64 limit) const = 0;

  /// A vtkReliefMeshReader of a file.
  virtual vtkSmartPointer<vtkPolyDataAlgorithm> NewMeshReader(const std::string& file) const = 0;

  /// The other files that a mesh is read from.
  virtual std::vector<std::string> FilesBesideMesh(const std::string& file) const = 0;

  /// A vtkOpenImageIOWriter that writes under the very name that it gets.
  virtual vtkSmartPointer<vtkImageWriter> NewWriter() const = 0;

  /// A TiledPicture of Module/IO. Throws a Failure of Module/Files, as its functions do.
  virtual std::unique_ptr<PictureRows> NewTiledPicture(
    const std::string& file, const int size[2], int components) const = 0;

  /// A LayerFile of Module/IO, for an image of this size and place, in tiles or lines; `goOn` is
  /// asked whether to. Throws a Failure or Aborted of Module/Files, as its functions do.
  virtual std::unique_ptr<LayerRows> NewLayerRows(const std::string& file, vtkImageData* place,
    vtkReliefScene* scene, const std::map<std::string, std::string>& attributes, bool tiled,
    const std::function<bool()>& goOn) const = 0;

  /// Paints a drawing on white, as 8-bit red, green and blue.
  virtual vtkSmartPointer<vtkImageData> Paint(const Drawing& drawing) const = 0;

  /// Reads a scene's file, and tells whether it names the scale of heights. Returns false and says
  /// why if it could not.
  virtual bool ReadScene(
    const std::string& file, vtkReliefScene* scene, bool& scaled, std::string& reason) const = 0;

  /// The text of a scene's file of that name; empty, and why, if there can be none.
  virtual std::string SceneText(
    const std::string& file, vtkReliefScene* scene, std::string& reason) const = 0;
};

/// Loads them. Throws a Failure if the library is not where it belongs.
const ImageFormats& imageFormats();

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef LayerFile_h
#define LayerFile_h

/// @file
/// Colour and layers in one OpenEXR file, written some rows at a time. Not installed.

#include "FileGuard.h"

#include "vtkIOReliefShadingModule.h" // For export macro
#include "vtkType.h"

#include <map>
#include <memory>
#include <string>

class vtkImageData;
class vtkReliefScene;

namespace relief::io
{
/// How the file stores its numbers, and what its header says. vtkOpenEXRLayerWriter.h tells what
/// each of these means.
struct LayerForm
{
  bool Half = false;   ///< numbers of 16 bits, where that is allowed
  int Compression = 2; ///< of vtkOpenEXRLayerWriter::Compressions: ZIP
  double DWALevel = 45.0;
  int TileSize = 0; ///< 0 for scan lines
  double NoData = 0.0;
  vtkReliefScene* Scene = nullptr;
  std::map<std::string, std::string> Attributes;
};

/// An OpenEXR file of an image's scalars and of its other arrays as layers, of which only some rows
/// are in memory. It has the target's name once it is whole, and is gone if it never is.
class VTKIORELIEFSHADING_EXPORT LayerFile
{
public:
  /// Creates the file for an image of this size and place, whose arrays are not looked at. With
  /// `staged` under a name of its own, see TemporaryFile. Throws a Failure.
  LayerFile(const std::string& file, bool staged, vtkImageData* place, const LayerForm& form);
  ~LayerFile();
  LayerFile(const LayerFile&) = delete;
  void operator=(const LayerFile&) = delete;

  /// Writes the next rows of the file: those of the greatest y come first. All parts have the whole
  /// width and the same arrays. The watcher is told the share of all rows that is done. Throws a
  /// Failure, or Aborted.
  void Write(vtkImageData* part, const StepWatcher& watcher);

  /// Writes what is still in memory, once all rows are given, and keeps the file. Throws a Failure.
  void Finish();

  /// How many values were too large for the file's numbers, and became the largest of these.
  vtkIdType GetNumberOfClamped() const;

private:
  struct Internals;
  std::unique_ptr<Internals> Internal;
};
}

#endif

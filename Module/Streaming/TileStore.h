// SPDX-License-Identifier: BSD-3-Clause
#ifndef TileStore_h
#define TileStore_h

/// @file
/// Pieces of a shaded raster that wait on the disk until all of them are there. Not installed.

#include "FileGuard.h"
#include "RunFolder.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkImageData;

namespace relief::streaming
{
/// A piece is not what was saved. It is gone now, to be made again.
struct RELIEF_THROWN TileDamaged : io::Failure
{
  using io::Failure::Failure;
};

/// Keeps finished pieces of an image in a folder, so that a run that is killed goes on where it
/// was. A piece is a folder that is named by its extent, `0-32767_512-1023`, and has an
/// uncompressed GeoTIFF for each array, `Shading.tif`, the rows in VTK's order; it takes this name
/// when all of it is written. Different pieces may be saved and loaded at the same time, by threads
/// and by processes.
class VTKIORELIEFSTREAMING_EXPORT TileStore
{
public:
  /// Opens or makes the folder of a run, see RunFolder. The first of several processes, which is
  /// to be there before the others save anything, removes what a killed run has left unfinished.
  TileStore(
    const std::string& folder, const std::string& key, RunFolder::Part part = RunFolder::Alone);

  /// The folder as it was given.
  std::string GetFolder() const { return this->Folder.Path().string(); }

  /// Whether a piece of this extent is there, whole. Load() looks what is in it.
  bool Has(const int extent[6]) const;

  /// The name of an array of an image's field data, of one number, that is kept with a piece.
  static constexpr const char* Note = "ReliefNote";

  /// Writes all point data of an image of one slice: numbers of unsigned char and float, of any
  /// number of components; and its note, if it has one. A piece of that extent that is there gives
  /// way to it. Throws a Failure; nothing is left then.
  void Save(vtkImageData* piece) const;

  /// Reads these arrays of a piece, bit for bit as they were saved, and its note; the first becomes
  /// the active scalars. Origin and spacing are not kept. Throws TileDamaged where one of them is
  /// not there or is not as it was saved; the whole piece is removed then.
  vtkSmartPointer<vtkImageData> Load(
    const int extent[6], const std::vector<std::string>& arrays) const;

  /// Removes all that is of this class, and the folder if nothing else is in it. It comes last.
  void Remove();

private:
  RunFolder Folder;
};
}

#endif

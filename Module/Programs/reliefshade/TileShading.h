// SPDX-License-Identifier: BSD-3-Clause
#ifndef TileShading_h
#define TileShading_h

#include "BandShading.h"
#include "PictureForm.h"
#include "RasterFiles.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkImageReliefShading;

namespace relief::streaming
{
class PiecePlan;
class TileStore;
}

namespace reliefshade
{

struct Options;

/// Whether the heights would not fit into the memory that the run may take, and can be read as they
/// are needed. What has been opened for that is left to be read. Throws a Failure where an option
/// needs them all at once.
bool readsAsNeeded(const Options& options, const ReadOptions& reading,
  std::unique_ptr<relief::raster::RasterFile>& opened);

/// Reads the header of heights that are read as they are needed, with a mask if there is one, and
/// goes through them once. Throws a Failure.
Raster readAsNeeded(const Options& options);

/// The memory that decides which heights are left out, for the key of a run, as a line; empty where
/// none may be.
std::string memoryKey(const Options& options);

/// Whether heights are read as they are needed.
bool isTiled(const Raster& raster);

/// A run over heights that do not fit into memory. Its picture is shaded in pieces, which wait on
/// the disk until all of them are there: a run that has been killed goes on where it was.
class TileShading
{
public:
  /// Cuts the picture into pieces that keep to the memory of the run, and opens the folder of the
  /// run, beside the first of its files. `sampleBytes` is what a shaded sample takes. Throws a
  /// Failure.
  TileShading(const Options& options, const Raster& raster, vtkImageReliefShading* shading,
    double sampleBytes);
  ~TileShading();

  /// Shades what is not there yet: of several processes each its share (Ranks.h). Throws a Failure.
  void ShadeShare(const RunPart& part, ShadingReport& report);

  /// Hands over all, once it is there, in bands of rows, the upper ones first or, `upward`, the
  /// lower ones. Throws a Failure, and what `take` throws.
  void HandOver(
    bool upward, ShadingReport& report, const std::function<void(vtkImageData*)>& take) const;

  /// The pieces' extents, which are all of the picture.
  const std::vector<std::array<int, 6>>& GetPieces() const;

  /// One layer of a piece that is there. Throws a Failure.
  vtkSmartPointer<vtkImageData> LoadLayer(const int extent[6], const std::string& name) const;

  /// Removes the folder, when what was made of the pieces has its name.
  void Finish();

private:
  using Extent = std::array<int, 6>;

  void Cut(double sampleBytes);
  double LargestOf(double sampleBytes) const;
  void LeaveOut(double sampleBytes);
  vtkSmartPointer<vtkImageData> ShadePiece(const Extent& piece, ShadingReport& report) const;
  std::string GetKey() const;
  std::vector<Extent> Missing() const;
  vtkSmartPointer<vtkImageData> Load(
    const Extent& piece, const std::vector<std::string>& arrays, ShadingReport& report) const;

  const Options& Given;
  const Raster& Heights;
  vtkImageReliefShading* Shading;
  std::unique_ptr<relief::streaming::PiecePlan> Plan;
  double Wanted = 0.0; // bytes of memory, for nothing to be left out; 0 where nothing is
  std::vector<std::string> Arrays;
  std::optional<PictureForm> Form; // of Shading in the pieces, where it is not that of the filter
  std::unique_ptr<relief::streaming::TileStore> Store;
};

}

#endif

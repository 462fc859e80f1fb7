// SPDX-License-Identifier: BSD-3-Clause
#ifndef Outputs_h
#define Outputs_h

#include "AccuracyOutput.h"
#include "BandShading.h"
#include "LayersWriter.h"
#include "OutputFile.h"
#include "PictureOutput.h"
#include "RasterFiles.h"
#include "TileShading.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkImageData;
class vtkImageReliefShading;
class vtkReliefScene;

namespace reliefshade
{

struct Options;

/// Whether a progress bar is wanted, and somebody sees it.
bool showsBar(const Options& options);

/// What a sample takes beside its height as the file stores it: the prepared height with its
/// bounds, the tint, and all that is shaded at once.
double bytesPerSample(const Options& options);

/// What one sample of the filter's output takes.
double shadedBytes(const Options& options);

/// Takes bytes of a budget. Throws a Failure that names the file if there are none left.
void claim(const std::string& file, MemoryBudget& budget, double bytes);

/// Says what has been noted since the last time.
void printWarnings(const Options& options);

/// The files that a run writes: all appear when all are written, or none does.
class Outputs
{
public:
  /// Finds out at once whether all of them can be written. Throws a Failure.
  Outputs(const Options& options, Raster& raster, MemoryBudget& budget);

  /// Shades and writes, which is a part of the run. The scene is the one to be kept.
  ShadingReport Write(vtkImageReliefShading* shading, vtkReliefScene* scene, const RunPart& part);

private:
  void Begin(vtkImageReliefShading* shading);
  void WriteRows(vtkImageData* part);
  ShadingReport WritePieces(vtkImageReliefShading* shading, bool upward, const RunPart& part);
  void Finish(vtkImageReliefShading* shading, vtkReliefScene* scene);

  const Options& Given;
  const Raster& Heights;
  GeoReference& Reference;
  std::optional<PictureOutput> Picture;
  std::optional<LayersWriter> Layers;
  std::vector<std::unique_ptr<PictureOutput>> LayerPictures; // as the options list them
  std::optional<PictureOutput> Mask;
  std::optional<OutputFile> Scene;
  std::optional<AccuracyOutput> Report;
  std::optional<TileShading> Tiles; // of heights that do not fit into memory
};

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef LayersWriter_h
#define LayersWriter_h

#include "OutputFile.h"
#include "RasterFiles.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkImageReliefShading;

namespace reliefshade
{

class LayerRows;

/// Layers by the names that they have on the command line.
using LayerNames = std::vector<std::string>;

/// The layers that can be written, in lower case.
const LayerNames& layerNames();

/// Those of them that every scene has: a shadow needs a sun.
const LayerNames& usualLayerNames();

/// 1 for numbers, 3 for vectors and colours.
int layerComponents(const std::string& layer);

/// Switches on what is to be written.
void generateLayers(const LayerNames& layers, vtkImageReliefShading* shading);

/// One of the result's layers as an image of its own.
vtkSmartPointer<vtkImageData> layerImage(vtkImageData* result, const std::string& layer);

/// The layer of the shadow as a grey picture, 255 in shadow; transparent where there is no data.
vtkSmartPointer<vtkImageData> maskImage(vtkImageData* result);

/// Switches on what the linear colour is made of, where the picture itself will not hold it.
void generateColor(vtkImageReliefShading* shading);

/// Writes one OpenEXR file of linear colour and layers, which is to be kept when all is written,
/// some rows at a time.
class LayersWriter
{
public:
  /// Finds out at once whether the place can be written. Throws a Failure that names the file.
  explicit LayersWriter(const std::string& file);
  ~LayersWriter();

  ///@{
  /// Writes under the staged name, of a shading that generateColor() was asked for: rows by rows,
  /// the upper ones first, of the whole width. `tiled` where not all of them are in memory at once:
  /// the file is in tiles then. Throws a Failure.
  void Begin(vtkImageReliefShading* shading, const LayerNames& layers,
    const GeoReference& reference, bool tiled);
  void WriteRows(vtkImageData* part);
  void Finish();
  ///@}

  /// All of these, of what has been shaded.
  void Write(
    vtkImageReliefShading* shading, const LayerNames& layers, const GeoReference& reference);

  /// Takes the target's name once it is kept.
  OutputFile& GetFile() { return this->File; }

private:
  OutputFile File;
  LayerNames Layers;
  std::unique_ptr<LayerRows> Rows;
};

}

#endif

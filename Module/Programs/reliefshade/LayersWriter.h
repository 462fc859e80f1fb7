// SPDX-License-Identifier: BSD-3-Clause
#ifndef LayersWriter_h
#define LayersWriter_h

#include "OutputFile.h"
#include "RasterFiles.h"

#include <string>
#include <vector>

class vtkImageReliefShading;

namespace reliefshade
{

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

/// Writes one OpenEXR file of linear colour and layers, which is to be kept when all is written.
class LayersWriter
{
public:
  /// Finds out at once whether the place can be written. Throws a Failure that names the file.
  explicit LayersWriter(const std::string& file);

  /// Switches on what the colour is made of, where the picture itself will not hold it.
  void Prepare(vtkImageReliefShading* shading) const;

  /// Writes under the staged name. Throws a Failure.
  void Write(
    vtkImageReliefShading* shading, const LayerNames& layers, const GeoReference& reference) const;

  /// Takes the target's name once it is kept.
  OutputFile& GetFile() { return this->File; }

private:
  OutputFile File;
};

}

#endif

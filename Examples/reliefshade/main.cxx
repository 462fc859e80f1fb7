// SPDX-License-Identifier: BSD-3-Clause

// reliefshade: shades a height field from a file into a picture. Options.cxx describes the command
// line, RasterReader.h and RasterWriter.h the files; this is what happens between them.

#include "ColourTable.h"
#include "Failure.h"
#include "LayersWriter.h"
#include "MapFrame.h"
#include "MemoryBudget.h"
#include "MessageLog.h"
#include "Options.h"
#include "Picture.h"
#include "RasterReader.h"
#include "RasterWriter.h"
#include "StagedFile.h"
#include "Threads.h"
#include "Watch.h"

#include "vtkCollectionRange.h"
#include "vtkDataArray.h"
#include "vtkImageFlip.h"
#include "vtkImageReliefShading.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkPointData.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefSceneFile.h"
#include "vtkReliefStatistics.h"
#include "vtkSMPTools.h"
#include "vtkScalarsToColors.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
/// The mask of the command line; samples that the heights' own file masks out stay so.
void addMask(const Options& options, MemoryBudget& budget, Raster& raster)
{
  if (options.Mask.empty())
  {
    return;
  }
  const Raster mask = readRaster(options.Mask, ReadOptions(), budget);
  int size[3];
  int expected[3];
  mask.Heights->GetDimensions(size);
  raster.Heights->GetDimensions(expected);
  if (!std::equal(size, size + 3, expected))
  {
    throw Failure(options.Mask,
      std::to_string(size[0]) + " x " + std::to_string(size[1]) + " samples; expected " +
        std::to_string(expected[0]) + " x " + std::to_string(expected[1]) + " as in " +
        options.Input);
  }
  if (raster.Mask)
  {
    vtkDataArray* own = raster.Mask->GetPointData()->GetScalars();
    vtkDataArray* given = mask.Heights->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < own->GetNumberOfTuples(); ++i)
    {
      if (own->GetComponent(i, 0) == 0.0)
      {
        given->SetComponent(i, 0, 0.0);
      }
    }
  }
  raster.Mask = mask.Heights;
}

//------------------------------------------------------------------------------
/// A scene as the command line means it, while its lights and heights are taken to another frame.
class MapScene
{
public:
  explicit MapScene(const Options& options)
    : Given(options)
    , HeightScale(options.Scene->GetHeightScale())
  {
    for (vtkLight* light : vtk::Range(options.Scene->GetLights()))
    {
      this->Positions.push_back({});
      light->GetPosition(this->Positions.back().data());
    }
  }

  /// Writes it; afterwards the scene is as it was.
  void Save(const StagedFile& staged) const
  {
    vtkReliefScene* scene = this->Given.Scene;
    scene->SetHeightScale(this->HeightScale);
    auto position = this->Positions.begin();
    for (vtkLight* light : vtk::Range(scene->GetLights()))
    {
      light->SetPosition((position++)->data());
    }
    if (!this->Given.Environment.empty())
    {
      scene->GetEnvironment()->SetFileName(this->Given.Environment.c_str());
    }
    vtkNew<vtkReliefSceneFile> file;
    file->SetFileName(staged.Name().c_str());
    file->SetScene(scene);
    if (!file->Write())
    {
      throw Failure(staged.Target(), staged.Reword(takeError()));
    }
  }

private:
  const Options& Given;
  double HeightScale;
  std::vector<std::array<double, 3>> Positions;
};

//------------------------------------------------------------------------------
int outputType(const Options& options)
{
  if (options.OutputType != VTK_VOID)
  {
    return options.OutputType;
  }
  return options.Output.empty() ? VTK_FLOAT : usualScalarType(options.Output);
}

//------------------------------------------------------------------------------
/// What a sample takes beside its height as the file stores it.
double bytesPerSample(const Options& options)
{
  // The prepared height with its bounds, and the picture.
  const bool isFloat = outputType(options) == VTK_FLOAT;
  double bytes = 4.0 + 1.0 + (isFloat ? 16.0 : 4.0);
  for (const std::string& layer : options.Layers)
  {
    bytes += 4.0 * layerComponents(layer);
  }
  if (!options.LayersFile.empty() && !isFloat)
  {
    bytes += 4.0 * 12.0 + 16.0; // the colour's parts, and their sum
  }
  return bytes + (options.Tint.empty() ? 0.0 : 4.0);
}

//------------------------------------------------------------------------------
void claim(const std::string& file, MemoryBudget& budget, double bytes)
{
  try
  {
    budget.Claim(bytes);
  }
  catch (const std::runtime_error& error)
  {
    throw Failure(file, error.what());
  }
}

//------------------------------------------------------------------------------
std::string layerFile(const Options& options, const std::string& layer)
{
  const std::filesystem::path output(options.Output);
  const std::string extension = lowerExtension(options.Output) == ".exr" ? ".exr" : ".tif";
  return (output.parent_path() / (output.stem().string() + "-" + layer + extension)).string();
}

//------------------------------------------------------------------------------
/// The files that a run writes: all appear when all are written, or none does.
class Outputs
{
public:
  /// Finds out at once whether all of them can be written. Throws a Failure.
  Outputs(
    const Options& options, const GeoReference& reference, vtkIdType samples, MemoryBudget& budget);

  /// The file of the colour and the layers, if there is one.
  const LayersWriter* GetLayersWriter() const { return this->Layers ? &*this->Layers : nullptr; }

  void Write(vtkImageReliefShading* shading, const MapScene& scene);

private:
  const Options& Given;
  const GeoReference& Reference;
  std::optional<RasterWriter> Picture;
  std::optional<LayersWriter> Layers;
  std::vector<std::unique_ptr<RasterWriter>> LayerPictures; // as the options list them
  std::optional<StagedFile> Scene;
};

//------------------------------------------------------------------------------
Outputs::Outputs(
  const Options& options, const GeoReference& reference, vtkIdType samples, MemoryBudget& budget)
  : Given(options)
  , Reference(reference)
{
  if (!options.Output.empty())
  {
    const int type = outputType(options);
    this->Picture.emplace(options.Output, type, 4, reference);
    const int size = type == VTK_FLOAT ? 4 : 1;
    claim(options.Input, budget, this->Picture->DropsAlpha() ? 3.0 * size * samples : 0.0);
  }
  if (!options.LayersFile.empty())
  {
    this->Layers.emplace(options.LayersFile);
  }
  else
  {
    for (const std::string& layer : options.Layers)
    {
      this->LayerPictures.push_back(std::make_unique<RasterWriter>(
        layerFile(options, layer), VTK_FLOAT, layerComponents(layer), reference));
    }
  }
  if (!options.SavedScene.empty())
  {
    this->Scene.emplace(options.SavedScene);
  }
}

//------------------------------------------------------------------------------
void Outputs::Write(vtkImageReliefShading* shading, const MapScene& scene)
{
  vtkImageData* result = shading->GetOutput();
  std::vector<StagedFile*> files;
  if (this->Picture)
  {
    this->Picture->Write(result);
    files.push_back(&this->Picture->GetFile());
  }
  if (this->Layers)
  {
    this->Layers->Write(shading, this->Given.Layers, this->Reference);
    files.push_back(&this->Layers->GetFile());
  }
  for (std::size_t k = 0; k < this->LayerPictures.size(); ++k)
  {
    this->LayerPictures[k]->Write(layerImage(result, this->Given.Layers[k]));
    files.push_back(&this->LayerPictures[k]->GetFile());
  }
  if (this->Scene)
  {
    scene.Save(*this->Scene);
    files.push_back(&*this->Scene);
  }
  stopIfInterrupted();
  StagedFile::KeepAll(files);
}

//------------------------------------------------------------------------------
void printStatistics(
  const Raster& raster, const Options& options, vtkReliefStatistics* statistics, double seconds)
{
  int size[3];
  raster.Heights->GetDimensions(size);
  std::cout.precision(10);
  std::cout << "size: " << size[0] << " " << size[1] << "\n"
            << "type: " << raster.Heights->GetScalarTypeAsString() << "\n"
            << "spacing: " << raster.Spacing[0] << " " << raster.Spacing[1] << "\n"
            << "height-scale: " << options.Scene->GetHeightScale() << "\n"
            << "coordinates: "
            << (!raster.Reference.Present         ? "none"
                   : raster.Geographic            ? "geographic"
                   : raster.Reference.Crs.empty() ? "unnamed"
                                                  : "projected")
            << "\n";
  if (raster.NoData)
  {
    std::cout << "nodata: " << *raster.NoData << "\n";
  }
  std::cout << "threads: " << vtkSMPTools::GetEstimatedNumberOfThreads() << "\n"
            << "effects: " << statistics->GetEffectNames() << "\n"
            << "lights-traced: " << statistics->GetLightsTraced() << "\n"
            << "rays-traced: " << statistics->GetRaysTraced() << "\n"
            << "cells-visited: " << statistics->GetCellsVisited() << "\n"
            << "seconds: " << seconds << std::endl;
}

//------------------------------------------------------------------------------
/// Reads the pictures that give colour and light.
void readPictures(const Options& options, const Raster& raster, MemoryBudget& budget,
  vtkImageReliefShading* shading)
{
  if (!options.Environment.empty())
  {
    // Beside the picture, its mirror image and three linear floats a texel.
    vtkSmartPointer<vtkImageData> image =
      readPicture(options.Environment, budget, options.MirrorEnvironment ? 2 : 1, 12);
    if (options.MirrorEnvironment)
    {
      vtkNew<vtkImageFlip> mirror;
      mirror->SetInputData(image);
      mirror->SetFilteredAxis(0);
      mirror->Update();
      image = mirror->GetOutput();
    }
    options.Scene->GetEnvironment()->SetImage(image);
  }
  if (!options.DiffuseTexture.empty())
  {
    shading->SetDiffuseTextureData(readTexture(options.DiffuseTexture, raster, budget));
  }
  if (!options.BaseTexture.empty())
  {
    shading->SetBaseTextureData(readTexture(options.BaseTexture, raster, budget));
  }
  if (!options.SpecularTexture.empty())
  {
    shading->SetSpecularTextureData(readTexture(options.SpecularTexture, raster, budget));
  }
  if (!options.Tint.empty())
  {
    shading->SetLookupTable(readColourTable(options.Tint, raster));
  }
}

//------------------------------------------------------------------------------
/// The file that an error of the shading is about.
std::string subject(const Options& options, const std::string& error)
{
  const std::pair<const char*, const std::string&> files[] = { { "environment",
                                                                 options.Environment },
    { "environment", options.SceneFile }, { "diffuse texture", options.DiffuseTexture },
    { "base texture", options.BaseTexture }, { "specular texture", options.SpecularTexture } };
  for (const auto& file : files)
  {
    if (!file.second.empty() && error.find(file.first) != std::string::npos)
    {
      return file.second;
    }
  }
  return options.Input;
}

//------------------------------------------------------------------------------
void printWarnings(const Options& options)
{
  for (const std::string& warning : takeWarnings())
  {
    if (!options.Quiet)
    {
      std::cerr << "reliefshade: warning: " << warning << std::endl;
    }
  }
}

//------------------------------------------------------------------------------
void run(const Options& options)
{
  MemoryBudget budget(options.MemoryLimit);
  Raster raster = readRaster(options.Input, options.Reading, budget, bytesPerSample(options));
  addMask(options, budget, raster);
  if (options.Spacing)
  {
    raster.Spacing = *options.Spacing;
    raster.HeightUnit = 1.0;
  }
  else if (looksLikeDegrees(raster) && !options.Quiet)
  {
    std::cerr << "reliefshade: " << options.Input
              << ": warning: its coordinates look like degrees, but it names no coordinate "
                 "reference system; --degrees takes them as such\n";
  }
  placeHeights(raster);
  const MapScene mapScene(options);
  MapFrame(raster).ToHeights(options.Scene);

  Outputs outputs(options, raster.Reference, raster.Heights->GetNumberOfPoints(), budget);

  setThreads(options.Threads);
  vtkNew<vtkImageReliefShading> shading;
  setHeights(raster, shading);
  shading->SetScene(options.Scene);
  shading->SetCacheMemoryLimit(0); // there is one update only
  shading->SetOutputScalarType(outputType(options));
  readPictures(options, raster, budget, shading);
  generateLayers(options.Layers, shading);
  if (outputs.GetLayersWriter())
  {
    outputs.GetLayersWriter()->Prepare(shading);
  }
  watch(shading, terminal() && !options.Quiet);
  const auto start = std::chrono::steady_clock::now();
  shading->Update();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  stopIfInterrupted();
  if (hasError())
  {
    const std::string error = takeError();
    throw Failure(subject(options, error), error);
  }

  printWarnings(options);
  outputs.Write(shading, mapScene);
  printWarnings(options);
  if (options.Statistics)
  {
    printStatistics(raster, options, shading->GetStatistics(), seconds.count());
  }
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  catchMessages();
  catchSignals();
  try
  {
    Options options;
    if (parseOptions(argc, argv, options))
    {
      run(options);
    }
    return Success;
  }
  catch (const Failure& failure)
  {
    std::cerr << "reliefshade: " << failure.what() << std::endl;
    return failure.Code;
  }
  catch (const std::bad_alloc&)
  {
    std::cerr << "reliefshade: not enough memory" << std::endl;
  }
  catch (const std::exception& error)
  {
    std::cerr << "reliefshade: " << oneLine(error.what()) << std::endl;
  }
  return RunFailure;
}

// SPDX-License-Identifier: BSD-3-Clause

// reliefshade: shades a height field from a file into a picture. Options.cxx describes the command
// line, RasterFiles.h and PictureOutput.h the files; this is what happens between them.

#include "BandShading.h"
#include "ColorTable.h"
#include "Failure.h"
#include "HeightScaling.h"
#include "ImageFrame.h"
#include "LayersWriter.h"
#include "MeshHeights.h"
#include "MessageLog.h"
#include "Options.h"
#include "OutputNames.h"
#include "Outputs.h"
#include "PictureChoice.h"
#include "Ranks.h"
#include "RasterFiles.h"
#include "ReferencedPicture.h"
#include "SculptedHeights.h"
#include "StandardStreams.h"
#include "SunTimes.h"
#include "Threads.h"
#include "TileShading.h"
#include "TilesOutput.h"
#include "Watch.h"

#include "vtkDataArray.h"
#include "vtkImageFlip.h"
#include "vtkImageReliefShading.h"
#include "vtkPointData.h"
#include "vtkReliefEnvironment.h"
#include "vtkSMPTools.h"
#include "vtkScalarsToColors.h"

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <locale>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <utility>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
void printStatistics(const Raster& raster, const Options& options, const ShadingReport& report)
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
            << "effects: " << report.Effects << "\n"
            << "lights-traced: " << report.LightsTraced << "\n"
            << "rays-traced: " << report.RaysTraced << "\n"
            << "cells-visited: " << report.CellsVisited << "\n"
            << "exposure: " << report.Exposure << "\n"
            << "pieces-by-bounds: " << report.PiecesByBounds << "\n"
            << "tolerance-taken: " << report.ToleranceTaken << "\n"
            << "seconds: " << report.Seconds << std::endl;
}

//------------------------------------------------------------------------------
/// Says what heights that are known by their bounds only have cost.
void tellBounds(const Options& options, const ShadingReport& report)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  text << options.Input
       << ": pieces with heights that are known by their bounds only: " << report.PiecesByBounds
       << "; of the tolerance of " << options.Scene->GetTolerance() << " they take "
       << report.ToleranceTaken;
  say(text.str());
}

//------------------------------------------------------------------------------
/// Throws a Failure that names the file if its picture, which may be null, has no colours.
void checkColors(const std::string& file, vtkImageData* image, const char* what)
{
  relief::ColorTexture colors;
  const std::string wrong = image
    ? relief::hosts::ConvertColors(image, image->GetPointData()->GetScalars(), what, colors)
    : std::string();
  if (!wrong.empty())
  {
    throw Failure(file, wrong);
  }
}

vtkSmartPointer<vtkImageData> readColors(
  const std::string& file, const Raster& raster, MemoryBudget& budget, const char* what)
{
  vtkSmartPointer<vtkImageData> image = readTexture(file, raster, budget);
  checkColors(file, image, what);
  return image;
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
    if (!options.MirrorEnvironment) // whose picture is not the file's
    {
      options.Scene->GetEnvironment()->SetFileName(options.Environment.c_str());
    }
    checkColors(options.Environment, image, "environment");
  }
  else if (options.EnvironmentOfFile)
  {
    checkColors(options.SceneFile, options.Scene->GetEnvironment()->GetImage(), "environment");
  }
  if (!options.DiffuseTexture.empty())
  {
    shading->SetDiffuseTextureData(
      readColors(options.DiffuseTexture, raster, budget, "diffuse texture"));
  }
  if (!options.BaseTexture.empty())
  {
    shading->SetBaseTextureData(readColors(options.BaseTexture, raster, budget, "base texture"));
  }
  if (!options.SpecularTexture.empty())
  {
    shading->SetSpecularTextureData(
      readColors(options.SpecularTexture, raster, budget, "specular texture"));
  }
  if (!options.Tint.empty())
  {
    shading->SetLookupTable(readColorTable(options.Tint, raster));
  }
}

//------------------------------------------------------------------------------
/// How many threads are worth starting: 0 for all that there are.
int usefulThreads(const Raster& raster)
{
  return raster.Heights->GetNumberOfPoints() <= 64 * 64 ? 1 : 0;
}

//------------------------------------------------------------------------------
/// Before anything is shaded: what stops it may be what they are about.
void warnOfHeights(const Options& options, const Raster& raster)
{
  using relief::raster::Warning;
  const auto warn = [&options](const std::string& text)
  {
    if (!options.Quiet)
    {
      say(options.Input + ": warning: " + text);
    }
  };
  for (const Warning& warning : raster.Warnings)
  {
    if (warning.Remedy != Warning::Spacing || !options.Spacing)
    {
      warn(warning.Text +
        (warning.Remedy == Warning::NoData           ? "; see --nodata"
            : warning.Remedy == Warning::HeightScale ? "; see --height-scale"
                                                     : ""));
    }
  }
  if (!options.Spacing && relief::raster::LooksLikeDegrees(raster))
  {
    warn("its coordinates look like degrees, but it names no coordinate reference system; "
         "--degrees takes them as such");
  }
}

//------------------------------------------------------------------------------
/// Smooths terraces if it is wanted, or says that it can be done where they show.
void smoothHeights(const Options& options, MemoryBudget& budget, Raster& raster)
{
  if (options.SmoothSteps)
  {
    claim(options.Input, budget, smoothedBytes * raster.Heights->GetNumberOfPoints());
    aboutFile(options.Input, [&raster] { smoothSteps(raster); });
  }
  else if (!options.Quiet && showsTerraces(raster))
  {
    say(options.Input +
      ": its heights have few steps, whose edges show; --smooth-steps smooths them");
  }
}

//------------------------------------------------------------------------------
/// Shades a picture, with other processes perhaps, of which one writes it.
ShadingReport shadeFrame(const Options& options, const Raster& raster, Outputs* outputs,
  vtkReliefScene* mapScene, vtkImageReliefShading* shading, const RunPart& part)
{
  ShadingReport report;
  std::exception_ptr thrown;
  try
  {
    if (outputs)
    {
      report = outputs->Write(shading, mapScene, part);
    }
    else
    {
      TileShading(options, raster, shading, shadedBytes(options)).ShadeShare(part, report);
    }
  }
  catch (...)
  {
    if (ranks().HasFailed())
    {
      throw; // the others know
    }
    thrown = std::current_exception();
  }
  ranks().Together(
    [&thrown]
    {
      if (thrown)
      {
        std::rethrow_exception(thrown);
      }
    });
  return report;
}

//------------------------------------------------------------------------------
/// One picture after another, if there are several; the heights stay prepared between them.
ShadingReport shadeFrames(Options& options, const FrameFiles& files, const SunClock& clock,
  Raster& raster, std::unique_ptr<Outputs> outputs, vtkReliefScene* mapScene,
  vtkImageReliefShading* shading)
{
  const int frames = frameCount(options);
  ShadingReport sum;
  for (int frame = 0; frame < frames; ++frame)
  {
    if (frame > 0)
    {
      outputs.reset();
      clock.Place(frame);
      files.Name(options, frame);
      MemoryBudget claimed; // by the first frame, whose files took as much
      ranks().Together(
        [&]
        {
          outputs =
            ranks().GetRank() == 0 ? std::make_unique<Outputs>(options, raster, claimed) : nullptr;
        });
    }
    const RunPart part{ static_cast<double>(frame) / frames, 1.0 / frames };
    const ShadingReport report =
      shadeFrame(options, raster, outputs.get(), mapScene, shading, part);
    sum.Effects = report.Effects;
    sum.Exposure = report.Exposure;
    sum.LightsTraced = std::max(sum.LightsTraced, report.LightsTraced);
    sum.RaysTraced += report.RaysTraced;
    sum.CellsVisited += report.CellsVisited;
    sum.Seconds += report.Seconds;
    sum.PiecesByBounds += report.PiecesByBounds;
    sum.ToleranceTaken = std::max(sum.ToleranceTaken, report.ToleranceTaken);
  }
  return sum;
}

//------------------------------------------------------------------------------
void run(Options& options)
{
  if (isStandardInput(options.Input))
  {
    options.Input = options.Streams->Receive(options.Input);
    checkNames(options); // what came may name other files, as virtual rasters do
  }
  MemoryBudget budget(options.MemoryLimit, "--memory-limit");
  ReadOptions reading = options.Reading;
  reading.Padded = options.Tint.empty(); // colour tables take heights in one piece
  bool tiled = false;
  std::unique_ptr<relief::raster::RasterFile> opened;
  ranks().Together([&] { tiled = readsAsNeeded(options, reading, opened); });
  Raster raster = tiled     ? readAsNeeded(options)
    : isMesh(options.Input) ? readMesh(options.Input, options.View, budget, bytesPerSample(options))
    : options.Sculpted.Green
    ? readNormalMap(options.Input, options.Mask,
        options.Spacing.value_or(std::array<double, 2>{ 1.0, 1.0 }), options.Sculpted, budget,
        bytesPerSample(options))
    : readRaster(options.Input, reading, budget, bytesPerSample(options), std::move(opened));
  if (!options.Mask.empty() && !options.Sculpted.Green && !tiled)
  {
    addMask(options.Mask, ReadOptions(), options.Input, budget, raster);
  }
  warnOfHeights(options, raster);
  checkTiles(options, raster);
  const bool degrees = !options.Spacing && relief::raster::LooksLikeDegrees(raster);
  if (options.Spacing)
  {
    aboutFile(options.Input, [&] { relief::raster::SetSpacing(raster, *options.Spacing); });
  }
  relief::raster::PlaceHeights(raster);
  setThreads(options.Threads > 0 ? options.Threads : usefulThreads(raster));
  smoothHeights(options, budget, raster);
  const bool unit = options.Spacing || relief::raster::HasLengths(raster);
  // Of heights that have a unit there is at most something to say.
  if (options.Scaling != HeightScaling::Usual || !unit || !options.Quiet)
  {
    const std::string scaled = scaleHeights(options.Scaling, unit, raster, options.Scene);
    if (!scaled.empty() && !options.Quiet && !degrees)
    {
      say(options.Input + ": " + scaled);
    }
  }
  if (options.Sculpted.Relief)
  {
    squeezeHeights(*options.Sculpted.Relief, options.Input, budget, raster);
  }
  const SunClock clock(options, raster);
  clock.Place(0);
  const std::string night = clock.TellNight();
  if (!night.empty() && !options.Quiet)
  {
    say(options.Input + ": warning: " + night);
  }
  // As the command line means it, while the lights and heights of the other go to another frame.
  vtkNew<vtkReliefScene> mapScene;
  mapScene->CopySharingImage(options.Scene);
  MapFrame(raster).ToHeights(options.Scene);

  const FrameFiles files(options);
  files.Name(options, 0);
  // One of several processes writes what all of them shade.
  const bool writes = ranks().GetRank() == 0;
  std::unique_ptr<Outputs> outputs;
  ranks().Together(
    [&] { outputs = writes ? std::make_unique<Outputs>(options, raster, budget) : nullptr; });

  vtkNew<vtkImageReliefShading> shading;
  relief::raster::SetHeights(raster, shading);
  shading->SetScene(options.Scene);
  shading->SetCacheMemoryLimit(0); // of all bands none is shaded twice
  shading->SetOutputScalarType(outputType(options));
  ranks().Together([&] { readPictures(options, raster, budget, shading); });
  generateLayers(options.Layers, shading);
  shading->SetGenerateShadow(shading->GetGenerateShadow() || !options.ShadowMask.empty());
  if (!options.LayersFile.empty())
  {
    generateColor(shading);
  }
  shading->SetGenerateIllumination(
    shading->GetGenerateIllumination() || options.VerifiedSamples > 0);
  watch(shading, showsBar(options));
  const ShadingReport report =
    shadeFrames(options, files, clock, raster, std::move(outputs), mapScene, shading);
  printWarnings(options);
  if (report.PiecesByBounds > 0 && !options.Quiet)
  {
    tellBounds(options, report);
  }
  if (options.Statistics)
  {
    printStatistics(raster, options, report);
  }
}

//------------------------------------------------------------------------------
/// The option that mends a failure, to go on with behind its message.
const char* optionFor(Remedy remedy)
{
  switch (remedy)
  {
    case Remedy::Band:
      return "; see --band";
    case Remedy::Channel:
      return "; see --channel";
    case Remedy::Colors:
      return "; see --encoding and --band";
    case Remedy::Indices:
      return ": --band 1 takes its indices for heights";
    case Remedy::Degrees:
      return "; see --degrees";
    case Remedy::NumberType:
      return "; see --type";
    default:
      return "";
  }
}

//------------------------------------------------------------------------------
/// What the program ends with; what went wrong has been said.
int runCommand(int argc, char* argv[])
{
  try
  {
    Options options;
    bool shades = false;
    ranks().Together([&] { shades = parseOptions(argc, argv, options); });
    if (shades)
    {
      // Of several processes the first one speaks for all.
      options.Quiet = options.Quiet || ranks().GetRank() > 0;
      options.Statistics = options.Statistics && ranks().GetRank() == 0;
      options.TilesFolder.empty() ? run(options)
                                  : runTiles(options, { argv + 1, argv + argc }, run);
    }
    return Success;
  }
  catch (const OtherRank&)
  {
    return RunFailure; // which says why
  }
  catch (const Failure& failure)
  {
    say(std::string(failure.what()) + optionFor(failure.Mends));
    return failure.Code;
  }
  catch (const std::bad_alloc&)
  {
    say("not enough memory");
  }
  catch (const std::exception& error)
  {
    say(error.what());
  }
  return RunFailure;
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  catchMessages();
  relief::raster::KeepGdalQuiet();
  catchSignals();
  const int code = runCommand(argc, argv);
  if (Ranks* all = startedRanks())
  {
    all->Leave(code == Success || all->HasFailed());
  }
  return code;
}

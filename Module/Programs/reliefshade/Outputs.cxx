// SPDX-License-Identifier: BSD-3-Clause
#include "Outputs.h"

#include "Failure.h"
#include "ImageFormats.h"
#include "MessageLog.h"
#include "Options.h"
#include "OutputNames.h"
#include "OutputOptions.h"
#include "PictureChoice.h"
#include "Provenance.h"
#include "StandardStreams.h"
#include "Verify.h"
#include "Watch.h"

#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkReliefScene.h"

#include <algorithm>
#include <stdexcept>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
void saveScene(vtkReliefScene* scene, const OutputFile& staged)
{
  std::string reason;
  const std::string text = imageFormats().SceneText(staged.Name(), scene, reason);
  if (text.empty())
  {
    takeError(); // it is told here
    throw Failure(staged.Target(), staged.Reword(reason));
  }
  staged.WriteText(text);
}

//------------------------------------------------------------------------------
/// Whether a picture is wanted: a report measures by itself.
bool shades(const Options& options)
{
  return !options.Output.empty() || !options.LayersFile.empty() || !options.ShadowMask.empty() ||
    options.VerifiedSamples > 0;
}

//------------------------------------------------------------------------------
/// Whether all is shaded before any of it is written, not some rows at a time.
bool shadesAtOnce(const Options& options)
{
  return !options.LayersFile.empty() || options.VerifiedSamples > 0;
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
bool showsBar(const Options& options)
{
  return terminal() && !options.Quiet;
}

//------------------------------------------------------------------------------
double shadedBytes(const Options& options)
{
  const bool isFloat = outputType(options) == VTK_FLOAT;
  double bytes = isFloat ? 16.0 : 4.0;
  for (const std::string& layer : options.Layers)
  {
    bytes += 4.0 * layerComponents(layer);
  }
  bytes += options.ShadowMask.empty() ? 0.0 : 8.0; // the layer, and the picture of it
  if (!options.LayersFile.empty() && !isFloat)
  {
    bytes += 4.0 * 12.0 + 16.0; // the colour's parts, and their sum
  }
  const bool illumination = options.VerifiedSamples > 0 &&
    std::find(options.Layers.begin(), options.Layers.end(), "illumination") == options.Layers.end();
  return bytes + (illumination ? 4.0 : 0.0);
}

//------------------------------------------------------------------------------
double bytesPerSample(const Options& options)
{
  return 4.0 + 4.0 + (options.Tint.empty() ? 0.0 : 4.0) +
    (shadesAtOnce(options) ? shadedBytes(options) : 0.0);
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
void printWarnings(const Options& options)
{
  for (const std::string& warning : takeWarnings())
  {
    if (!options.Quiet)
    {
      say("warning: " + warning);
    }
  }
}

//------------------------------------------------------------------------------
Outputs::Outputs(const Options& options, Raster& raster, MemoryBudget& budget)
  : Given(options)
  , Heights(raster)
  , Reference(raster.Reference)
{
  double bytes = 0.0; // a sample
  if (!options.Output.empty())
  {
    const PictureForm form = formOfOutput(options, relief::raster::LacksData(raster));
    this->Picture.emplace(options.Output, form, this->Reference, isTiled(raster));
    bytes += this->Picture->GetBytesPerSample();
  }
  if (!options.LayersFile.empty())
  {
    this->Layers.emplace(options.LayersFile);
  }
  else
  {
    for (const std::string& layer : options.Layers)
    {
      const PictureForm form = formOfLayer(options, layerComponents(layer));
      this->LayerPictures.push_back(std::make_unique<PictureOutput>(
        layerFile(options.Output, layer), form, this->Reference, isTiled(raster)));
      bytes += this->LayerPictures.back()->GetBytesPerSample();
    }
  }
  if (!options.ShadowMask.empty())
  {
    const PictureForm form = formOfMask(options, relief::raster::LacksData(raster));
    this->Mask.emplace(options.ShadowMask, form, this->Reference);
    bytes += this->Mask->GetBytesPerSample();
  }
  if (!options.SavedScene.empty())
  {
    this->Scene.emplace(options.SavedScene);
  }
  if (!options.AccuracyReport.empty())
  {
    this->Report.emplace(options.AccuracyReport);
  }
  claim(options.Input, budget, bytes * raster.Heights->GetNumberOfPoints());
}

//------------------------------------------------------------------------------
// What headers say is known then: samples have been retraced, if they are to be.
void Outputs::Begin(vtkImageReliefShading* shading)
{
  const std::string verified = this->Given.VerifiedSamples > 0
    ? verify(shading, this->Given, this->Tiles ? &*this->Tiles : nullptr, showsBar(this->Given))
    : std::string();
  if (this->Layers || writesTiff(this->Given))
  {
    this->Reference.Metadata = provenance(shading, verified);
  }
  int size[3];
  vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0))->GetDimensions(size);
  if (this->Picture)
  {
    this->Picture->Begin(size);
  }
  for (const auto& picture : this->LayerPictures)
  {
    picture->Begin(size);
  }
  if (this->Mask)
  {
    this->Mask->Begin(size);
  }
  if (this->Layers)
  {
    this->Layers->Begin(shading, this->Given.Layers, this->Reference, isTiled(this->Heights));
  }
}

//------------------------------------------------------------------------------
void Outputs::WriteRows(vtkImageData* part)
{
  if (this->Picture)
  {
    this->Picture->WriteRows(part);
  }
  for (std::size_t k = 0; k < this->LayerPictures.size(); ++k)
  {
    this->LayerPictures[k]->WriteRows(layerImage(part, this->Given.Layers[k]));
  }
  if (this->Mask)
  {
    this->Mask->WriteRows(maskImage(part));
  }
}

//------------------------------------------------------------------------------
void Outputs::Finish(vtkImageReliefShading* shading, vtkReliefScene* scene)
{
  std::vector<OutputFile*> files;
  const bool bar = showsBar(this->Given);
  if (this->Picture)
  {
    this->Picture->Finish(bar);
    files.push_back(&this->Picture->GetFile());
  }
  if (this->Layers)
  {
    this->Layers->Finish();
    files.push_back(&this->Layers->GetFile());
  }
  for (const auto& picture : this->LayerPictures)
  {
    picture->Finish(bar);
    files.push_back(&picture->GetFile());
  }
  if (this->Mask)
  {
    this->Mask->Finish(bar);
    files.push_back(&this->Mask->GetFile());
  }
  if (this->Scene)
  {
    saveScene(scene, *this->Scene);
    files.push_back(&*this->Scene);
  }
  if (this->Report)
  {
    files.push_back(&this->Report->GetFile());
  }
  stopIfInterrupted();
  if (this->Given.StreamsOutput)
  {
    // First, while nothing else has taken its name: perhaps nobody reads it.
    OutputFile::KeepAll({ files.front() });
    this->Given.Streams->Send();
    files.erase(files.begin());
  }
  OutputFile::KeepAll(files);
}

//------------------------------------------------------------------------------
/// The same of heights that do not fit into memory.
ShadingReport Outputs::WritePieces(vtkImageReliefShading* shading, bool upward, const RunPart& part)
{
  ShadingReport report;
  this->Tiles.emplace(this->Given, this->Heights, shading, shadedBytes(this->Given));
  // What headers say of a verification is known when all pieces are there; else it is found out
  // first whether files can be written.
  const bool verifies = this->Given.VerifiedSamples > 0;
  if (!verifies)
  {
    this->Begin(shading);
  }
  this->Tiles->ShadeShare({ part.Begin, 0.9 * part.Length }, report);
  if (verifies)
  {
    this->Begin(shading);
  }
  const std::function<void(vtkImageData*)> layers = [this](vtkImageData* band)
  { this->Layers->WriteRows(band); };
  const bool together = this->Layers && !upward;
  this->Tiles->HandOver(upward, report,
    [&](vtkImageData* band)
    {
      this->WriteRows(band);
      if (together)
      {
        layers(band);
      }
    });
  if (this->Layers && upward)
  {
    ShadingReport again;                         // has been told
    this->Tiles->HandOver(false, again, layers); // once more, as OpenEXR has its rows
  }
  return report;
}

//------------------------------------------------------------------------------
ShadingReport Outputs::Write(
  vtkImageReliefShading* shading, vtkReliefScene* scene, const RunPart& part)
{
  // First, since what cannot be measured shall cost no shading.
  if (this->Report)
  {
    this->Report->Write(shading, scene, this->Given.Input, showsBar(this->Given));
  }
  ShadingReport report;
  if (shades(this->Given))
  {
    // The rows of all files are alike.
    const int columns =
      vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0))->GetDimensions()[0];
    const bool atOnce = shadesAtOnce(this->Given);
    const int rows = atOnce ? 0 : rowsOfBand(columns, shadedBytes(this->Given));
    const bool upward = (this->Picture && this->Picture->IsUpward()) ||
      (this->Mask && this->Mask->IsUpward()) ||
      (!this->LayerPictures.empty() && this->LayerPictures.front()->IsUpward());
    if (!atOnce && !isTiled(this->Heights))
    {
      this->Begin(shading);
    }
    const auto take = [&](vtkImageData* band)
    {
      if (atOnce)
      {
        this->Begin(shading);
      }
      this->WriteRows(band);
      if (this->Layers)
      {
        this->Layers->WriteRows(band);
      }
    };
    report = isTiled(this->Heights)
      ? this->WritePieces(shading, upward, part)
      : shadeBands(shading, this->Given.Input, rows, upward, part, take);
  }
  printWarnings(this->Given);
  this->Finish(shading, scene);
  if (this->Tiles)
  {
    this->Tiles->Finish();
  }
  return report;
}

}

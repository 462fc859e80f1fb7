// SPDX-License-Identifier: BSD-3-Clause
#include "Saving.h"

#include "Failure.h"
#include "Field.h"
#include "LayersWriter.h"
#include "MessageLog.h"
#include "PictureOutput.h"
#include "Provenance.h"
#include "Watch.h"

#include "vtkCallbackCommand.h"
#include "vtkImageReliefShading.h"
#include "vtkNew.h"

namespace reliefviewer
{

namespace
{

//------------------------------------------------------------------------------
/// Shading is all but this share of the work; the rest is writing.
constexpr double ShadingShare = 0.95;

vtkSmartPointer<vtkImageData> copyOf(vtkImageData* image)
{
  auto copy = vtkSmartPointer<vtkImageData>::New();
  copy->ShallowCopy(image);
  return copy;
}

void shade(const std::string& file, vtkImageReliefShading* shading, const Field& field,
  vtkReliefScene* scene, const Progress& progress)
{
  // What the window shows is read there meanwhile: the samples are shared, the objects are not.
  reliefshade::Raster raster = field.Heights;
  raster.Heights = copyOf(raster.Heights);
  raster.Mask = raster.Mask ? copyOf(raster.Mask) : nullptr;
  relief::raster::SetHeights(raster, shading);
  shading->SetScene(scene);
  shading->SetCacheMemoryLimit(0); // there is one update only
  reliefshade::watch(shading, false);
  vtkNew<vtkCallbackCommand> tell;
  Progress scaled = [&progress](double share) { progress(ShadingShare * share); };
  tell->SetClientData(&scaled);
  tell->SetCallback([](vtkObject* filter, unsigned long, void* data, void*)
    { (*static_cast<Progress*>(data))(static_cast<vtkAlgorithm*>(filter)->GetProgress()); });
  const unsigned long tag = shading->AddObserver(vtkCommand::ProgressEvent, tell);
  shading->Update();
  shading->RemoveObserver(tag);
  reliefshade::stopIfInterrupted();
  if (reliefshade::hasError())
  {
    throw reliefshade::Failure(file, reliefshade::takeError());
  }
}

}

//------------------------------------------------------------------------------
void savePicture(
  const std::string& file, const Field& field, vtkReliefScene* scene, const Progress& progress)
{
  const int type = reliefshade::usualScalarType(file);
  const reliefshade::PictureForm form = reliefshade::usualForm(
    file, type, reliefshade::colorOf(scene).empty(), relief::raster::LacksData(field.Heights));
  relief::raster::GeoReference reference = field.Heights.Reference;
  reliefshade::PictureOutput writer(file, form, reference);
  vtkNew<vtkImageReliefShading> shading;
  shading->SetOutputScalarType(type);
  shade(file, shading, field, scene, progress);
  if (reliefshade::isGeoTiff(file))
  {
    reference.Metadata = reliefshade::provenance(shading, "");
  }
  writer.Write(shading->GetOutput());
  reliefshade::OutputFile::KeepAll({ &writer.GetFile() });
}

//------------------------------------------------------------------------------
void saveLayers(
  const std::string& file, const Field& field, vtkReliefScene* scene, const Progress& progress)
{
  reliefshade::LayersWriter writer(file);
  vtkNew<vtkImageReliefShading> shading;
  shading->SetOutputScalarTypeToFloat();
  reliefshade::generateLayers(reliefshade::usualLayerNames(), shading);
  shade(file, shading, field, scene, progress);
  relief::raster::GeoReference reference = field.Heights.Reference;
  reference.Metadata = reliefshade::provenance(shading, "");
  writer.Write(shading, reliefshade::usualLayerNames(), reference);
  reliefshade::OutputFile::KeepAll({ &writer.GetFile() });
}

}

// SPDX-License-Identifier: BSD-3-Clause
#include "LayersWriter.h"

#include "Failure.h"
#include "ImageFormats.h"
#include "MessageLog.h"
#include "PictureOutput.h"
#include "Watch.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

namespace
{

using namespace reliefshade;

const LayerNames Summands = { "base", "diffuse", "scatter", "specular" };

//------------------------------------------------------------------------------
vtkFloatArray* layerArray(vtkImageData* result, std::string layer)
{
  layer[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(layer[0])));
  return vtkFloatArray::SafeDownCast(result->GetPointData()->GetArray(layer.c_str()));
}

//------------------------------------------------------------------------------
/// The linear colour of a result whose scalars are 8-bit codes: the sum of what it is made of.
vtkSmartPointer<vtkFloatArray> sumOfLayers(vtkImageData* result)
{
  const vtkIdType count = result->GetNumberOfPoints();
  auto color = vtkSmartPointer<vtkFloatArray>::New();
  color->SetNumberOfComponents(4);
  color->SetNumberOfTuples(count);
  color->Fill(0.0);
  float* rgba = color->GetPointer(0);
  for (const std::string& layer : Summands)
  {
    const float* rgb = layerArray(result, layer)->GetPointer(0);
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (!std::isnan(rgb[3 * i]))
      {
        rgba[4 * i] += rgb[3 * i];
        rgba[4 * i + 1] += rgb[3 * i + 1];
        rgba[4 * i + 2] += rgb[3 * i + 2];
        rgba[4 * i + 3] = 1.0f;
      }
    }
  }
  return color;
}

//------------------------------------------------------------------------------
/// Where the file's rows lie on the map: OpenEXR's begin at the upper edge, in the north of rasters
/// that are not turned, whatever the raster's do.
std::string transformText(const GeoReference& reference, int rows)
{
  std::array<double, 6> t = reference.Transform;
  if (reference.SouthUp)
  {
    t[0] += rows * t[2];
    t[3] += rows * t[5];
    t[2] = 0.0 - t[2]; // and not -0
    t[5] = -t[5];
  }
  std::ostringstream text;
  text.precision(17);
  for (const double number : t)
  {
    text << (text.tellp() > 0 ? " " : "") << number + 0.0; // no -0
  }
  return text.str();
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
const LayerNames& layerNames()
{
  static const LayerNames names{ "illumination", "thickness", "shadow", "normals", "base",
    "diffuse", "scatter", "specular" };
  return names;
}

//------------------------------------------------------------------------------
const LayerNames& usualLayerNames()
{
  static const LayerNames names = []
  {
    LayerNames usual = layerNames();
    usual.erase(std::find(usual.begin(), usual.end(), "shadow"));
    return usual;
  }();
  return names;
}

//------------------------------------------------------------------------------
int layerComponents(const std::string& layer)
{
  return layer == "illumination" || layer == "thickness" || layer == "shadow" ? 1 : 3;
}

//------------------------------------------------------------------------------
void generateLayers(const LayerNames& layers, vtkImageReliefShading* shading)
{
  for (const std::string& layer : layers)
  {
    shading->SetGenerateIllumination(shading->GetGenerateIllumination() || layer == "illumination");
    shading->SetGenerateThickness(shading->GetGenerateThickness() || layer == "thickness");
    shading->SetGenerateShadow(shading->GetGenerateShadow() || layer == "shadow");
    shading->SetGenerateNormals(shading->GetGenerateNormals() || layer == "normals");
    shading->SetGenerateBase(shading->GetGenerateBase() || layer == "base");
    shading->SetGenerateDiffuse(shading->GetGenerateDiffuse() || layer == "diffuse");
    shading->SetGenerateScatter(shading->GetGenerateScatter() || layer == "scatter");
    shading->SetGenerateSpecular(shading->GetGenerateSpecular() || layer == "specular");
  }
}

//------------------------------------------------------------------------------
void generateColor(vtkImageReliefShading* shading)
{
  if (shading->GetOutputScalarType() != VTK_FLOAT)
  {
    generateLayers(Summands, shading);
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> layerImage(vtkImageData* result, const std::string& layer)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(result);
  image->GetPointData()->SetScalars(layerArray(result, layer));
  return image;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> maskImage(vtkImageData* result)
{
  const float* hidden = layerArray(result, "shadow")->GetPointer(0);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(result);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* rgba = static_cast<unsigned char*>(image->GetScalarPointer());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i, rgba += 4)
  {
    const bool none = std::isnan(hidden[i]);
    std::fill_n(rgba, 3, static_cast<unsigned char>(none ? 0.0f : 255.0f * hidden[i] + 0.5f));
    rgba[3] = none ? 0 : 255;
  }
  return image;
}

//------------------------------------------------------------------------------
LayersWriter::LayersWriter(const std::string& file)
  : File(file)
{
  if (lowerExtension(file) != ".exr")
  {
    throw Failure(file, "layers are written as OpenEXR; a name that ends in .exr is expected");
  }
  const GeoReference none;
  PictureForm form;
  form.ScalarType = VTK_FLOAT;
  PictureOutput(file, form, none);
}

//------------------------------------------------------------------------------
LayersWriter::~LayersWriter() = default;

//------------------------------------------------------------------------------
void LayersWriter::Begin(vtkImageReliefShading* shading, const LayerNames& layers,
  const GeoReference& reference, bool tiled)
{
  this->Layers = layers;
  // Where the image lies; its samples are given row by row.
  auto* heights = vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0));
  vtkNew<vtkImageData> place;
  place->CopyStructure(heights);
  std::map<std::string, std::string> attributes;
  if (reference.Present)
  {
    attributes["geo:transform"] = transformText(reference, place->GetDimensions()[1]);
  }
  if (!reference.Crs.empty())
  {
    attributes["geo:crs"] = reference.Crs;
  }
  for (const auto& [known, name] : { std::pair("RELIEF_HEIGHT_HASH", "heights:hash"),
         std::pair("RELIEF_VERIFIED", "accuracy:verified") })
  {
    const auto found = reference.Metadata.find(known);
    if (found != reference.Metadata.end())
    {
      attributes[name] = found->second;
    }
  }
  this->File.Try(
    [&]
    {
      this->Rows = imageFormats().NewLayerRows(this->File.Name(), place, shading->GetScene(),
        attributes, tiled, [] { return !interrupted(); });
    });
}

//------------------------------------------------------------------------------
void LayersWriter::WriteRows(vtkImageData* part)
{
  vtkNew<vtkImageData> rows;
  rows->CopyStructure(part);
  vtkPointData* data = rows->GetPointData();
  vtkDataArray* colors = part->GetPointData()->GetScalars();
  const vtkSmartPointer<vtkDataArray> linear = colors->GetDataType() == VTK_FLOAT
    ? vtkSmartPointer<vtkDataArray>(colors)
    : vtkSmartPointer<vtkDataArray>(sumOfLayers(part));
  data->SetScalars(linear);
  for (const std::string& layer : this->Layers)
  {
    data->AddArray(layerArray(part, layer));
  }
  this->File.Try([&] { this->Rows->Write(rows); });
}

//------------------------------------------------------------------------------
void LayersWriter::Finish()
{
  this->File.Try([&] { this->Rows->Finish(); });
  this->Rows.reset();
}

//------------------------------------------------------------------------------
void LayersWriter::Write(
  vtkImageReliefShading* shading, const LayerNames& layers, const GeoReference& reference)
{
  this->Begin(shading, layers, reference, false);
  this->WriteRows(shading->GetOutput());
  this->Finish();
}

}

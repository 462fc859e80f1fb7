// SPDX-License-Identifier: BSD-3-Clause
#include "LayersWriter.h"

#include "Failure.h"
#include "MessageLog.h"
#include "RasterWriter.h"
#include "Watch.h"

#include "vtkFloatArray.h"
#include "vtkImageReliefShading.h"
#include "vtkNew.h"
#include "vtkOpenEXRLayerWriter.h"
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
  auto colour = vtkSmartPointer<vtkFloatArray>::New();
  colour->SetNumberOfComponents(4);
  colour->SetNumberOfTuples(count);
  colour->Fill(0.0);
  float* rgba = colour->GetPointer(0);
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
  return colour;
}

//------------------------------------------------------------------------------
/// Where the file's rows lie on the map: OpenEXR's begin in the north, whatever the raster's do.
std::string transformText(const GeoReference& reference, int rows)
{
  std::array<double, 6> t = reference.Transform;
  if (reference.SouthUp)
  {
    t[3] += rows * t[5];
    t[5] = -t[5];
  }
  std::ostringstream text;
  text.precision(17);
  for (const double number : t)
  {
    text << (text.tellp() > 0 ? " " : "") << number;
  }
  return text.str();
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
const LayerNames& layerNames()
{
  static const LayerNames names{ "illumination", "thickness", "normals", "base", "diffuse",
    "scatter", "specular" };
  return names;
}

//------------------------------------------------------------------------------
int layerComponents(const std::string& layer)
{
  return layer == "illumination" || layer == "thickness" ? 1 : 3;
}

//------------------------------------------------------------------------------
void generateLayers(const LayerNames& layers, vtkImageReliefShading* shading)
{
  for (const std::string& layer : layers)
  {
    shading->SetGenerateIllumination(shading->GetGenerateIllumination() || layer == "illumination");
    shading->SetGenerateThickness(shading->GetGenerateThickness() || layer == "thickness");
    shading->SetGenerateNormals(shading->GetGenerateNormals() || layer == "normals");
    shading->SetGenerateBase(shading->GetGenerateBase() || layer == "base");
    shading->SetGenerateDiffuse(shading->GetGenerateDiffuse() || layer == "diffuse");
    shading->SetGenerateScatter(shading->GetGenerateScatter() || layer == "scatter");
    shading->SetGenerateSpecular(shading->GetGenerateSpecular() || layer == "specular");
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
LayersWriter::LayersWriter(const std::string& file)
  : File(file)
{
  if (lowerExtension(file) != ".exr")
  {
    throw Failure(file, "layers are written as OpenEXR; a name that ends in .exr is expected");
  }
  RasterWriter(file, VTK_FLOAT, 4, GeoReference());
}

//------------------------------------------------------------------------------
void LayersWriter::Prepare(vtkImageReliefShading* shading) const
{
  if (shading->GetOutputScalarType() != VTK_FLOAT)
  {
    generateLayers(Summands, shading);
  }
}

//------------------------------------------------------------------------------
void LayersWriter::Write(
  vtkImageReliefShading* shading, const LayerNames& layers, const GeoReference& reference) const
{
  vtkImageData* result = shading->GetOutput();
  vtkNew<vtkImageData> image;
  image->CopyStructure(result);
  vtkPointData* data = image->GetPointData();
  data->SetScalars(shading->GetOutputScalarType() == VTK_FLOAT
      ? result->GetPointData()->GetScalars()
      : sumOfLayers(result));
  for (const std::string& layer : layers)
  {
    data->AddArray(layerArray(result, layer));
  }
  vtkNew<vtkOpenEXRLayerWriter> writer;
  writer->SetFileName(this->File.Name().c_str());
  writer->SetInputData(image);
  writer->SetScene(shading->GetScene());
  if (reference.Present)
  {
    writer->SetAttribute(
      "geo:transform", transformText(reference, image->GetDimensions()[1]).c_str());
  }
  if (!reference.Crs.empty())
  {
    writer->SetAttribute("geo:crs", reference.Crs.c_str());
  }
  watch(writer, false);
  writer->Write();
  stopIfInterrupted();
  if (hasError())
  {
    throw Failure(this->File.Target(), this->File.Reword(takeError()));
  }
}

}

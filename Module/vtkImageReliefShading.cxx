// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageReliefShading.h"

#include "vtkCollectionRange.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "SceneShading.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <sstream>

vtkStandardNewMacro(vtkImageReliefShading);

static_assert(
  static_cast<int>(vtkReliefMaterial::SurfaceNormal) == relief::f64::RELIEF_SURFACE_NORMAL);
static_assert(static_cast<int>(vtkReliefMaterial::Exponential) == relief::f64::RELIEF_EXPONENTIAL);
static_assert(static_cast<int>(vtkReliefStatistics::Illumination) == relief::IlluminationEffect);
static_assert(static_cast<int>(vtkReliefStatistics::Normals) == relief::NormalsEffect);
static_assert(static_cast<int>(vtkReliefStatistics::Specular) == relief::SpecularEffect);
static_assert(static_cast<int>(vtkReliefStatistics::ForwardScatter) == relief::ScatterEffect);

class vtkImageReliefShading::Internals
{
public:
  vtkSmartPointer<vtkReliefScene> Scene = vtkSmartPointer<vtkReliefScene>::New();
  vtkNew<vtkReliefStatistics> Statistics;
};

namespace
{

void ForRows(int count, const std::function<void(int, int)>& body)
{
  vtkSMPTools::For(0, count,
    [&](vtkIdType begin, vtkIdType end) { body(static_cast<int>(begin), static_cast<int>(end)); });
}

// The image's own frame: world coordinates with origin and direction taken off, its first sample at
// (0, 0), x and y growing with the index.
class ImageFrame
{
public:
  // Returns an empty text, or what is wrong with the image.
  std::string Assign(vtkImageData* image)
  {
    const int* extent = image->GetExtent();
    const double* spacing = image->GetSpacing();
    std::copy_n(image->GetOrigin(), 3, this->Origin);
    std::copy_n(image->GetDirectionMatrix()->GetData(), 9, this->Direction);
    std::ostringstream message;
    for (int axis = 0; axis < 2; ++axis)
    {
      if (!std::isfinite(spacing[axis]) || spacing[axis] == 0.0)
      {
        message << "the spacing is (" << spacing[0] << ", " << spacing[1]
                << "), finite numbers other than 0 are expected";
        return message.str();
      }
      this->Spacing[axis] = std::abs(spacing[axis]);
      this->Sign[axis] = spacing[axis] < 0.0 ? -1.0 : 1.0;
      this->First[axis] = extent[2 * axis] * this->Spacing[axis];
    }
    vtkMatrix3x3::Invert(this->Direction, this->Inverse);
    if (!std::isfinite(this->Origin[0] + this->Origin[1] + this->Origin[2]) ||
      vtkMatrix3x3::Determinant(this->Direction) == 0.0)
    {
      return "origin and direction matrix must be finite, and the matrix regular";
    }
    return std::string();
  }

  glm::dvec3 VectorFromWorld(const double world[3]) const
  {
    double local[3];
    vtkMatrix3x3::MultiplyPoint(this->Inverse, world, local);
    return { local[0] * this->Sign[0], local[1] * this->Sign[1], local[2] };
  }

  glm::dvec3 PointFromWorld(const double world[3]) const
  {
    const double fromOrigin[3] = { world[0] - this->Origin[0], world[1] - this->Origin[1],
      world[2] - this->Origin[2] };
    return this->VectorFromWorld(fromOrigin) - glm::dvec3(this->First[0], this->First[1], 0.0);
  }

  bool IsWorld() const
  {
    static const double identity[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    return this->Sign[0] > 0.0 && this->Sign[1] > 0.0 &&
      std::equal(identity, identity + 9, this->Direction);
  }

  void NormalToWorld(float* n) const
  {
    const double local[3] = { n[0] * this->Sign[0], n[1] * this->Sign[1], n[2] };
    double world[3];
    vtkMatrix3x3::MultiplyPoint(this->Direction, local, world);
    std::copy_n(world, 3, n);
  }

  double Spacing[2] = { 1.0, 1.0 };

private:
  double Origin[3];
  double Direction[9];
  double Inverse[9];
  double Sign[2] = { 1.0, 1.0 };
  double First[2] = { 0.0, 0.0 };
};

// Checks that an image is one slice of scalars of one component. Returns an empty text, or what is
// wrong.
std::string CheckInput(vtkImageData* image, vtkDataArray* scalars, const char* what)
{
  std::ostringstream message;
  const int* extent = image->GetExtent();
  if (image->GetNumberOfPoints() < 1)
  {
    message << "the " << what << " image is empty";
  }
  else if (extent[4] != extent[5])
  {
    message << "the " << what << " image has " << extent[5] - extent[4] + 1
            << " slices, 1 is expected";
  }
  else if (!scalars)
  {
    message << "the " << what << " image has no scalars";
  }
  else if (scalars->GetNumberOfComponents() != 1)
  {
    message << "the " << what << " image has " << scalars->GetNumberOfComponents()
            << " components, 1 is expected";
  }
  else if (scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    message << "the " << what << " array has " << scalars->GetNumberOfTuples() << " values, "
            << image->GetNumberOfPoints() << " are expected";
  }
  else if (scalars->GetDataType() == VTK_BIT)
  {
    message << "the " << what << " scalars are bits, a numeric type is expected";
  }
  return message.str();
}

template <class T>
std::function<bool(int, int)> ReadMask(const T* mask, int columns)
{
  return [mask, columns](int i, int j)
  {
    T value = mask[static_cast<std::ptrdiff_t>(j) * columns + i];
    return value == value && value != 0;
  };
}

// One of vtkLight's lights in the image's frame. Returns an empty text, or what is wrong with it.
std::string ConvertLight(
  vtkLight* light, const ImageFrame& frame, double datum, relief::Light& result)
{
  double position[3];
  double focal[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focal);
  result.color = glm::dvec3(
    light->GetDiffuseColor()[0], light->GetDiffuseColor()[1], light->GetDiffuseColor()[2]);
  result.intensity = light->GetIntensity();
  result.positional = light->GetPositional() != 0;
  if (!std::isfinite(result.intensity) ||
    !std::isfinite(result.color.x + result.color.y + result.color.z))
  {
    return "its intensity and colour must be finite";
  }
  if (!std::isfinite(position[0] + position[1] + position[2]))
  {
    return "its position must be finite";
  }
  if (result.positional)
  {
    result.vector = frame.PointFromWorld(position) - glm::dvec3(0.0, 0.0, datum);
    return std::string();
  }
  const double toward[3] = { position[0] - focal[0], position[1] - focal[1],
    position[2] - focal[2] };
  glm::dvec3 v = frame.VectorFromWorld(toward);
  double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  if (!std::isfinite(length) || length == 0.0)
  {
    return "its position and focal point must be finite and differ";
  }
  result.vector = v / length;
  return std::string();
}

relief::Scene ConvertMaterial(vtkReliefScene* scene, const ImageFrame& frame, double datum)
{
  vtkReliefMaterial* material = scene->GetMaterial();
  auto color = [](const double c[3]) { return glm::dvec3(c[0], c[1], c[2]); };
  relief::Scene result;
  result.base = color(material->GetBaseColor());
  result.diffuse = color(material->GetDiffuseColor());
  result.specular = color(material->GetSpecularColor());
  result.specularCoefficient = material->GetSpecularCoefficient();
  result.scatterCoefficient = material->GetForwardScatterCoefficient();
  result.specularFalloff = { material->GetSpecularRange()[0], material->GetSpecularRange()[1],
    material->GetSpecularPower() };
  result.scatterFalloff = { material->GetForwardScatterRange()[0],
    material->GetForwardScatterRange()[1], material->GetForwardScatterPower() };
  result.medium.depth = material->GetAutomaticSubsurfaceDepth()
    ? (frame.Spacing[0] + frame.Spacing[1]) / 2.0
    : material->GetSubsurfaceDepth();
  result.medium.offset = material->GetOffsetMode();
  result.medium.attenuation = material->GetAttenuation();
  result.medium.density = material->GetDensity();
  result.medium.useFloor = material->GetUseFloor();
  result.medium.floorHeight = material->GetFloorHeight() - datum;
  result.medium.tolerance = scene->GetTolerance();
  result.integrator = scene->GetIntegrator() == vtkReliefScene::Exact
    ? relief::Integrator::Exact
    : relief::Integrator::FixedStep;
  result.steps = scene->GetNumberOfSteps();
  return result;
}

// Whether lights may be swept in lockstep, for which the heights are copied with a margin. In a
// narrow image the margin would outweigh the samples, and little would be won.
bool IsSwept(vtkReliefScene* scene, int columns)
{
  return columns >= 64 && scene->GetIntegrator() == vtkReliefScene::Exact &&
    scene->GetMaterial()->GetOffsetMode() == vtkReliefMaterial::Vertical &&
    !scene->GetMaterial()->GetUseFloor();
}

float* AddLayer(vtkImageData* image, bool wanted, const char* name, int components)
{
  if (!wanted)
  {
    return nullptr;
  }
  vtkNew<vtkFloatArray> layer;
  layer->SetName(name);
  layer->SetNumberOfComponents(components);
  layer->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(layer);
  return layer->GetPointer(0);
}

}

//------------------------------------------------------------------------------
vtkImageReliefShading::vtkImageReliefShading()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(2);
  this->SetInputArrayToProcess(
    1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkImageReliefShading::~vtkImageReliefShading() = default;

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetScene(vtkReliefScene* scene)
{
  if (!scene)
  {
    vtkErrorMacro("SetScene: null was given, a vtkReliefScene is expected; the old scene is kept.");
    return;
  }
  if (this->Internal->Scene != scene)
  {
    this->Internal->Scene = scene;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkReliefScene* vtkImageReliefShading::GetScene()
{
  return this->Internal->Scene;
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetNoDataValue(double value)
{
  // Never equal to itself, NaN must not count as a change.
  bool same = this->NoDataValue == value || (std::isnan(value) && std::isnan(this->NoDataValue));
  if (!same || !this->UseNoDataValue)
  {
    this->NoDataValue = value;
    this->UseNoDataValue = true;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetOutputScalarType(int type)
{
  if (type != VTK_FLOAT && type != VTK_UNSIGNED_CHAR)
  {
    vtkErrorMacro("SetOutputScalarType: "
      << type << " was given, VTK_FLOAT (" << VTK_FLOAT << ") or VTK_UNSIGNED_CHAR ("
      << VTK_UNSIGNED_CHAR << ") is expected; " << this->OutputScalarType << " is kept.");
    return;
  }
  if (this->OutputScalarType != type)
  {
    this->OutputScalarType = type;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkReliefStatistics* vtkImageReliefShading::GetStatistics()
{
  return this->Internal->Statistics;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkImageReliefShading::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Internal->Scene->GetMTime());
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkDataObject::SetPointDataActiveScalarInfo(
    outputs->GetInformationObject(0), this->OutputScalarType, 4);
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* info = inputs[port]->GetInformationObject(0);
    if (info && info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
    {
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
        info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* outInfo = outputs->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* mask = vtkImageData::GetData(inputs[1]);
  vtkReliefScene* scene = this->Internal->Scene;
  vtkReliefStatistics* statistics = this->Internal->Statistics;
  output->Initialize();

  // An error leaves the output empty. The pipeline would add a message of its own to a failure.
  auto fail = [&](const std::string& message)
  {
    vtkErrorMacro(<< message << ".");
    output->Initialize();
    return 1;
  };

  vtkDataArray* scalars = this->GetInputArrayToProcess(0, inputs);
  std::string wrong = CheckInput(input, scalars, "height");
  vtkDataArray* maskScalars = mask ? this->GetInputArrayToProcess(1, inputs) : nullptr;
  if (wrong.empty() && mask)
  {
    wrong = CheckInput(mask, maskScalars, "mask");
    if (wrong.empty() && !std::equal(input->GetExtent(), input->GetExtent() + 6, mask->GetExtent()))
    {
      std::ostringstream message;
      message << "the mask's extent is (" << mask->GetExtent()[0] << ", " << mask->GetExtent()[1]
              << ", " << mask->GetExtent()[2] << ", " << mask->GetExtent()[3]
              << "), that of the heights is expected: (" << input->GetExtent()[0] << ", "
              << input->GetExtent()[1] << ", " << input->GetExtent()[2] << ", "
              << input->GetExtent()[3] << ")";
      wrong = message.str();
    }
  }
  ImageFrame frame;
  if (wrong.empty())
  {
    wrong = frame.Assign(input);
  }
  if (!wrong.empty())
  {
    return fail(wrong);
  }

  const int* extent = input->GetExtent();
  const int columns = extent[1] - extent[0] + 1;
  relief::HeightField field;
  try
  {
    std::function<bool(int, int)> hasData;
    if (mask)
    {
      switch (maskScalars->GetDataType())
      {
        vtkTemplateMacro(
          hasData = ReadMask(static_cast<const VTK_TT*>(maskScalars->GetVoidPointer(0)), columns));
      }
    }
    switch (scalars->GetDataType())
    {
      vtkTemplateMacro({
        relief::HeightSource<VTK_TT> source;
        source.data = static_cast<const VTK_TT*>(scalars->GetVoidPointer(0));
        source.stepY = columns;
        source.columns = columns;
        source.rows = extent[3] - extent[2] + 1;
        source.spacingX = frame.Spacing[0];
        source.spacingY = frame.Spacing[1];
        source.scale = scene->GetHeightScale();
        source.hasNoData = this->UseNoDataValue;
        source.noData = this->NoDataValue;
        source.hasData = hasData;
        wrong = field.Assign(source, ForRows, IsSwept(scene, columns));
      });
    }
  }
  catch (const std::bad_alloc&)
  {
    wrong = "there is not enough memory for the prepared heights";
  }
  if (!wrong.empty())
  {
    return fail(wrong);
  }
  if (!field.HasData())
  {
    vtkWarningMacro("No sample has data; the output is transparent.");
  }
  else if (columns < 2 || extent[3] == extent[2])
  {
    vtkWarningMacro("An image of "
      << columns << " x " << extent[3] - extent[2] + 1
      << " samples has no surface between them; each is shaded as level "
         "ground.");
  }

  relief::Scene parameters = ConvertMaterial(scene, frame, field.GetDatum());
  vtkNew<vtkReliefScene> unlit;
  vtkLightCollection* lights = scene->GetLights();
  if (lights->GetNumberOfItems() == 0)
  {
    unlit->AddSun(315.0, 45.0);
    lights = unlit->GetLights();
  }
  int lightIndex = 0;
  for (vtkLight* light : vtk::Range(lights))
  {
    if (light->GetSwitch())
    {
      relief::Light converted;
      wrong = ConvertLight(light, frame, field.GetDatum(), converted);
      if (!wrong.empty())
      {
        return fail("light " + std::to_string(lightIndex) + ": " + wrong);
      }
      parameters.lights.push_back(converted);
    }
    ++lightIndex;
  }

  // A distributed input holds its piece only, whatever has been asked for.
  int outExtent[6];
  outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), outExtent);
  for (int axis = 0; axis < 3; ++axis)
  {
    outExtent[2 * axis] = std::max(outExtent[2 * axis], extent[2 * axis]);
    outExtent[2 * axis + 1] = std::min(outExtent[2 * axis + 1], extent[2 * axis + 1]);
  }
  output->CopyStructure(input);
  output->SetExtent(outExtent);
  relief::Target target;
  try
  {
    output->AllocateScalars(this->OutputScalarType, 4);
    output->GetPointData()->GetScalars()->SetName("Shading");
    target.illumination = AddLayer(output, this->GenerateIllumination, "Illumination", 1);
    target.thickness = AddLayer(output, this->GenerateThickness, "Thickness", 1);
    target.normals = AddLayer(output, this->GenerateNormals, "Normals", 3);
    target.base = AddLayer(output, this->GenerateBase, "Base", 3);
    target.diffuse = AddLayer(output, this->GenerateDiffuse, "Diffuse", 3);
    target.scatter = AddLayer(output, this->GenerateScatter, "Scatter", 3);
    target.specular = AddLayer(output, this->GenerateSpecular, "Specular", 3);
  }
  catch (const std::bad_alloc&)
  {
    return fail("there is not enough memory for the output");
  }
  if (output->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  target.i0 = outExtent[0] - extent[0];
  target.j0 = outExtent[2] - extent[2];
  target.width = outExtent[1] - outExtent[0] + 1;
  void* pixels = output->GetPointData()->GetScalars()->GetVoidPointer(0);
  if (this->OutputScalarType == VTK_FLOAT)
  {
    target.rgba = static_cast<float*>(pixels);
  }
  else
  {
    target.rgba8 = static_cast<unsigned char*>(pixels);
  }

  // Bands of tiles, one after another: between them observers hear of progress, on this thread, and
  // may abort.
  relief::SceneShading shading(field, parameters, target);
  const int height = relief::SweepThickness::TileHeight;
  const int firstRow = target.j0;
  const int endRow = target.j0 + outExtent[3] - outExtent[2] + 1;
  const int tiles = (endRow + height - 1) / height;
  const int band =
    std::max((tiles - firstRow / height + 63) / 64, 2 * vtkSMPTools::GetEstimatedNumberOfThreads());
  for (int begin = firstRow / height; begin < tiles && !this->AbortExecute; begin += band)
  {
    const int end = std::min(begin + band, tiles);
    vtkSMPTools::For(begin, end, 1,
      [&](vtkIdType from, vtkIdType to)
      {
        shading.Shade(target.i0, target.i0 + target.width,
          std::max(firstRow, static_cast<int>(from) * height),
          std::min(endRow, static_cast<int>(to) * height));
      });
    this->UpdateProgress(
      static_cast<double>(std::min(end * height, endRow) - firstRow) / (endRow - firstRow));
  }
  if (this->AbortExecute)
  {
    output->Initialize();
    return 1;
  }

  if (target.normals && !frame.IsWorld())
  {
    for (vtkIdType at = 0; at < output->GetNumberOfPoints(); ++at)
    {
      frame.NormalToWorld(target.normals + 3 * at);
    }
  }
  statistics->SetLightsTraced(shading.GetLightsTraced());
  statistics->SetRaysTraced(static_cast<vtkTypeInt64>(shading.GetRaysTraced()));
  statistics->SetCellsVisited(static_cast<vtkTypeInt64>(shading.GetCellsVisited()));
  statistics->SetEffectsEvaluated(shading.GetEffects());
  return 1;
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  auto printSwitch = [&](const char* name, bool on)
  { os << indent << name << ": " << (on ? "On" : "Off") << "\n"; };
  os << indent << "Scene:\n";
  this->Internal->Scene->PrintSelf(os, indent.GetNextIndent());
  os << indent << "NoDataValue: " << this->NoDataValue << "\n";
  printSwitch("UseNoDataValue", this->UseNoDataValue);
  os << indent
     << "OutputScalarType: " << (this->OutputScalarType == VTK_FLOAT ? "Float" : "UnsignedChar")
     << "\n";
  printSwitch("GenerateIllumination", this->GenerateIllumination);
  printSwitch("GenerateThickness", this->GenerateThickness);
  printSwitch("GenerateNormals", this->GenerateNormals);
  printSwitch("GenerateBase", this->GenerateBase);
  printSwitch("GenerateDiffuse", this->GenerateDiffuse);
  printSwitch("GenerateScatter", this->GenerateScatter);
  printSwitch("GenerateSpecular", this->GenerateSpecular);
  os << indent << "Statistics:\n";
  this->Internal->Statistics->PrintSelf(os, indent.GetNextIndent());
}

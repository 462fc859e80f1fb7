// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthToHeightField.h"

#include "vtkCamera.h"
#include "vtkDepthToHeightFieldWork.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkReliefDepthBuffer.h"
#include "vtkReliefSetters.h"
#include "vtkRenderer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>

vtkStandardNewMacro(vtkDepthToHeightField);

namespace
{
constexpr int MostSamplesOfSide = 65536;

bool IsVector(const double v[3])
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]) &&
    (v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0);
}

void SetVector(
  vtkDepthToHeightField* self, double member[3], double x, double y, double z, const char* name)
{
  const double vector[3] = { x, y, z };
  if (!IsVector(vector))
  {
    vtkErrorWithObjectMacro(self,
      "Set" << name << ": " << x << ", " << y << ", " << z
            << " was given, a finite vector that is not 0 is expected; " << member[0] << ", "
            << member[1] << ", " << member[2] << " is kept.");
    return;
  }
  if (!std::equal(vector, vector + 3, member))
  {
    std::copy_n(vector, 3, member);
    self->Modified();
  }
}
}

//------------------------------------------------------------------------------
vtkDepthToHeightField::vtkDepthToHeightField()
  : LowestHeight(std::numeric_limits<double>::quiet_NaN())
  , HighestHeight(std::numeric_limits<double>::quiet_NaN())
  , Work(new Implementation(this))
{
  this->SetNumberOfInputPorts(1);
}

//------------------------------------------------------------------------------
vtkDepthToHeightField::~vtkDepthToHeightField() = default;

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetViewDirection(double x, double y, double z)
{
  SetVector(this, this->ViewDirection, x, y, z, "ViewDirection");
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetViewUp(double x, double y, double z)
{
  SetVector(this, this->ViewUp, x, y, z, "ViewUp");
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetResolution(int samples)
{
  relief::SetNumber(this, this->Resolution, samples, samples >= 1 && samples <= MostSamplesOfSide,
    "a number from 1 to 65536", "Resolution");
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetDimensions(int columns, int rows)
{
  const bool none = columns == 0 && rows == 0;
  const bool fit =
    columns >= 1 && rows >= 1 && columns <= MostSamplesOfSide && rows <= MostSamplesOfSide;
  if (!none && !fit)
  {
    vtkErrorMacro("SetDimensions: " << columns << ", " << rows
                                    << " was given, two numbers from 1 to 65536 or two 0 are "
                                       "expected; "
                                    << this->Dimensions[0] << ", " << this->Dimensions[1]
                                    << " is kept.");
    return;
  }
  if (this->Dimensions[0] != columns || this->Dimensions[1] != rows)
  {
    this->Dimensions[0] = columns;
    this->Dimensions[1] = rows;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetFrame(double xmin, double xmax, double ymin, double ymax)
{
  const double frame[4] = { xmin, xmax, ymin, ymax };
  const bool none = std::all_of(frame, frame + 4, [](double side) { return side == 0.0; });
  const bool fit =
    std::all_of(frame, frame + 4, [](double side) { return std::abs(side) <= 1e100; }) &&
    xmin < xmax && ymin < ymax;
  if (!none && !fit)
  {
    vtkErrorMacro("SetFrame: " << xmin << ", " << xmax << ", " << ymin << ", " << ymax
                               << " was given, xmin < xmax and ymin < ymax, or all 0, are "
                                  "expected; the old frame is kept.");
    return;
  }
  if (!std::equal(frame, frame + 4, this->Frame))
  {
    std::copy_n(frame, 4, this->Frame);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetMargin(double part)
{
  relief::SetNumber(
    this, this->Margin, part, part >= 0.0 && part <= 10.0, "a number from 0 to 10", "Margin");
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetNormalize(int mode)
{
  relief::SetNumber(this, this->Normalize, mode, mode >= SceneUnits && mode <= UnitRange,
    "SceneUnits (0), FromLowest (1) or UnitRange (2)", "Normalize");
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetOutputScalarType(int type)
{
  relief::SetNumber(this, this->OutputScalarType, type, type == VTK_FLOAT || type == VTK_DOUBLE,
    "VTK_FLOAT (10) or VTK_DOUBLE (11)", "OutputScalarType");
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetOutputScalarTypeToFloat()
{
  this->SetOutputScalarType(VTK_FLOAT);
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetOutputScalarTypeToDouble()
{
  this->SetOutputScalarType(VTK_DOUBLE);
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::SetRenderer(vtkRenderer* renderer)
{
  if (this->Renderer != renderer)
  {
    this->Renderer = renderer;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkRenderer* vtkDepthToHeightField::GetRenderer()
{
  return this->Renderer;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkDepthToHeightField::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->Renderer && this->Renderer->IsActiveCameraCreated())
  {
    time = std::max(time, this->Renderer->GetActiveCamera()->GetMTime());
  }
  return time;
}

//------------------------------------------------------------------------------
int vtkDepthToHeightField::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

//------------------------------------------------------------------------------
// How many samples there are depends on the bounds of the input, which is brought up to date.
int vtkDepthToHeightField::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  relief::HeightFrame frame;
  frame.columns = frame.rows = 1;
  if (this->Renderer)
  {
    relief::hosts::DepthHeights depths;
    if (relief::hosts::FindDepthFrame(this->Renderer, depths).empty())
    {
      frame.columns = depths.columns;
      frame.rows = depths.rows;
      std::copy_n(depths.origin, 2, frame.first);
      std::copy_n(depths.spacing, 2, frame.spacing);
    }
  }
  else
  {
    for (int i = 0; i < this->GetNumberOfInputConnections(0); ++i)
    {
      int port = 0;
      this->GetInputAlgorithm(0, i, port)->GetExecutive()->Update(port);
    }
    try
    {
      // What is wrong is told when there are data to be made.
      frame = this->Work->Plan(inputs[0]).empty() ? this->Work->Frame : frame;
    }
    catch (const std::bad_alloc&)
    {
      this->Work->Drop();
    }
  }
  vtkInformation* info = outputs->GetInformationObject(0);
  const int extent[6] = { 0, frame.columns - 1, 0, frame.rows - 1, 0, 0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  const double origin[3] = { frame.first[0], frame.first[1], 0.0 };
  const double spacing[3] = { frame.spacing[0], frame.spacing[1], 1.0 };
  info->Set(vtkDataObject::ORIGIN(), origin, 3);
  info->Set(vtkDataObject::SPACING(), spacing, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(info, this->OutputScalarType, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkDepthToHeightField::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs, 0);
  output->Initialize();
  this->Work->Forget();
  std::string wrong;
  try
  {
    wrong =
      this->Renderer ? this->Work->RunRenderer(output) : this->Work->RunMeshes(inputs[0], output);
  }
  catch (const std::bad_alloc&)
  {
    wrong = "there is not enough memory for the triangles and samples";
  }
  this->Work->Drop();
  if (!wrong.empty())
  {
    output->Initialize();
    vtkErrorMacro(<< wrong << ".");
  }
  else
  {
    this->UpdateProgress(1.0);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto list = [](ostream& to, const double* values, int count)
  {
    for (int k = 0; k < count; ++k)
    {
      to << (k > 0 ? ", " : "") << values[k];
    }
    to << "\n";
  };
  list(os << indent << "ViewDirection: ", this->ViewDirection, 3);
  list(os << indent << "ViewUp: ", this->ViewUp, 3);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << ", " << this->Dimensions[1] << "\n";
  list(os << indent << "Frame: ", this->Frame, 4);
  os << indent << "Margin: " << this->Margin << "\n";
  os << indent << "Normalize: " << this->Normalize << "\n";
  os << indent << "OutputScalarType: " << this->OutputScalarType << "\n";
  os << indent << "GenerateMask: " << this->GenerateMask << "\n";
  os << indent << "GenerateNormals: " << this->GenerateNormals << "\n";
  os << indent << "GenerateColors: " << this->GenerateColors << "\n";
  os << indent << "Renderer: " << this->Renderer.Get() << "\n";
  os << indent << "NumberOfTriangles: " << this->NumberOfTriangles << "\n";
  os << indent << "NumberOfDegenerateTriangles: " << this->NumberOfDegenerateTriangles << "\n";
  os << indent << "NumberOfNonFiniteTriangles: " << this->NumberOfNonFiniteTriangles << "\n";
  os << indent << "NumberOfOtherCells: " << this->NumberOfOtherCells << "\n";
  os << indent << "NumberOfOtherDataSets: " << this->NumberOfOtherDataSets << "\n";
  os << indent << "LowestHeight: " << this->LowestHeight << "\n";
  os << indent << "HighestHeight: " << this->HighestHeight << "\n";
  list(os << indent << "ViewAxes: ", this->ViewAxes, 9);
}

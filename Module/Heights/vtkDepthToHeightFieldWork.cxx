// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthToHeightFieldWork.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkReliefAbort.h"
#include "vtkReliefDepthBuffer.h"
#include "vtkReliefMeshAttributes.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include "HeightInputs.h"
#include "TriangleHeights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <sstream>

namespace
{
// How much of the progress is over when the triangles are gathered, and when their heights are.
constexpr double Gathered = 0.2;
constexpr double Found = 0.9;

// "2 vertices and lines" as a part of a list; nothing if there are none.
void Tell(std::ostream& list, vtkIdType count, const char* what)
{
  if (count > 0)
  {
    list << (list.tellp() > 0 ? ", " : "") << count << " " << what;
  }
}

// An array for each sample.
template <class Array>
vtkSmartPointer<Array> AddArray(vtkImageData* image, const char* name, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  if (!array->GetVoidPointer(0))
  {
    throw std::bad_alloc();
  }
  image->GetPointData()->AddArray(array);
  return array;
}
}

//------------------------------------------------------------------------------
bool vtkDepthToHeightField::Implementation::HasFrame() const
{
  const double* frame = this->Self->Frame;
  return frame[0] < frame[1];
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::Implementation::Forget()
{
  this->Self->NumberOfTriangles = 0;
  this->Self->NumberOfDegenerateTriangles = 0;
  this->Self->NumberOfNonFiniteTriangles = 0;
  this->Self->NumberOfOtherCells = 0;
  this->Self->NumberOfOtherDataSets = 0;
  this->Self->LowestHeight = std::numeric_limits<double>::quiet_NaN();
  this->Self->HighestHeight = std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
// Keeps the triangles for the next pass of the pipeline, which mostly follows at once.
std::string vtkDepthToHeightField::Implementation::Gather(vtkInformationVector* inputs)
{
  std::vector<vtkPolyData*> meshes;
  Key key = { { this->Self, this->Self->GetMTime() } };
  vtkIdType others = 0;
  const auto take = [&](vtkDataObject* data)
  {
    if (vtkPolyData* mesh = vtkPolyData::SafeDownCast(data))
    {
      meshes.push_back(mesh);
      key.emplace_back(mesh, mesh->GetMTime());
    }
    else
    {
      others += data ? 1 : 0;
    }
  };
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkDataObject* data = vtkDataObject::GetData(inputs, i);
    if (vtkCompositeDataSet* composite = vtkCompositeDataSet::SafeDownCast(data))
    {
      const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
      for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
      {
        take(leaves->GetCurrentDataObject());
      }
    }
    else
    {
      take(data);
    }
  }
  this->Self->NumberOfOtherDataSets = others;
  if (key == this->GatheredFrom && !this->Triangles.parts.empty())
  {
    return {};
  }
  this->GatheredFrom = key;
  return relief::hosts::GatherTriangles(
    meshes, this->View, this->Self->GenerateColors, this->Triangles);
}

//------------------------------------------------------------------------------
std::string vtkDepthToHeightField::Implementation::Fit()
{
  const double* center = this->Triangles.center;
  relief::FrameRequest request;
  request.hasFrame = this->HasFrame();
  for (int k = 0; k < 4; ++k)
  {
    request.bounds[k] = this->Triangles.bounds[k];
    request.frame[k] = this->Self->Frame[k] - center[k / 2];
  }
  request.margin = this->Self->Margin;
  std::copy_n(this->Self->Dimensions, 2, request.dimensions);
  request.resolution = this->Self->Resolution;
  const std::string wrong = relief::FitHeightFrame(request, this->Relative);
  this->Frame = this->Relative;
  this->Frame.first[0] += center[0];
  this->Frame.first[1] += center[1];
  return wrong;
}

//------------------------------------------------------------------------------
// Finds where the samples are, for which meshes without a frame must be looked at.
std::string vtkDepthToHeightField::Implementation::Plan(vtkInformationVector* inputs)
{
  this->View = relief::MakeViewAxes(this->Self->ViewDirection, this->Self->ViewUp);
  if (inputs->GetNumberOfInformationObjects() == 0)
  {
    return "there is nothing to look at: set an input of polygons, or a renderer";
  }
  const std::string wrong = this->Gather(inputs);
  if (!wrong.empty())
  {
    return wrong;
  }
  if (this->Triangles.corners.empty())
  {
    std::ostringstream text;
    text << "there are no triangles to look at among " << this->Triangles.parts.size()
         << " meshes with " << this->Triangles.points.size() / 3 << " points, "
         << this->Triangles.otherCells << " vertices and lines, " << this->Triangles.notFinite
         << " triangles not finite and " << this->Triangles.degenerate << " without area";
    return text.str();
  }
  return this->Fit();
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::Implementation::WarnOfLeftOut()
{
  vtkDepthToHeightField* self = this->Self;
  self->NumberOfTriangles = static_cast<vtkIdType>(this->Triangles.corners.size() / 3);
  self->NumberOfDegenerateTriangles = static_cast<vtkIdType>(this->Triangles.degenerate);
  self->NumberOfNonFiniteTriangles = static_cast<vtkIdType>(this->Triangles.notFinite);
  self->NumberOfOtherCells = static_cast<vtkIdType>(this->Triangles.otherCells);
  std::ostringstream list;
  Tell(list, self->NumberOfOtherCells, "vertices and lines");
  Tell(list, self->NumberOfDegenerateTriangles, "triangles without area");
  Tell(list, self->NumberOfNonFiniteTriangles, "triangles whose corners are not finite");
  Tell(list, self->NumberOfOtherDataSets, "data sets that are no polygons");
  if (!list.str().empty())
  {
    vtkWarningWithObjectMacro(self, "Of the input are left out: " << list.str() << ".");
  }
}

//------------------------------------------------------------------------------
std::string vtkDepthToHeightField::Implementation::RunMeshes(
  vtkInformationVector* inputs, vtkImageData* output)
{
  std::string wrong = this->Plan(inputs);
  this->WarnOfLeftOut();
  this->Self->UpdateProgress(Gathered);
  if (wrong.empty() && !vtkReliefIsAborted(this->Self))
  {
    wrong = this->Sample(output);
  }
  return wrong;
}

//------------------------------------------------------------------------------
std::string vtkDepthToHeightField::Implementation::Sample(vtkImageData* output)
{
  const relief::HeightFrame& frame = this->Relative;
  const vtkIdType count = vtkIdType{ frame.columns } * frame.rows;
  relief::MoveToSamples(this->Triangles, frame, relief::hosts::ForRows);
  // They are of no use for another grid.
  this->GatheredFrom.clear();
  std::vector<double> heights(static_cast<std::size_t>(count));
  const bool attributes = this->Self->GenerateNormals || this->Self->GenerateColors;
  std::vector<std::uint32_t> triangles(attributes ? heights.size() : 0);
  const relief::TriangleCount found =
    relief::FindTriangleHeights(this->Triangles.GetMesh(), relief::hosts::ForRows,
      [this](double done)
      {
        this->Self->UpdateProgress(Gathered + (Found - Gathered) * done);
        return !vtkReliefIsAborted(this->Self);
      },
      { frame.columns, frame.rows, heights.data(), attributes ? triangles.data() : nullptr });
  this->Self->NumberOfNonFiniteTriangles += static_cast<vtkIdType>(found.leftOut);
  if (!found.whole)
  {
    return {};
  }
  const std::string wrong = this->Finish(output, heights.data(), this->Triangles.center[2]);
  if (wrong.empty() && attributes)
  {
    this->AddAttributes(output, triangles);
  }
  return wrong;
}

//------------------------------------------------------------------------------
std::string vtkDepthToHeightField::Implementation::RunRenderer(vtkImageData* output)
{
  relief::hosts::DepthHeights depths;
  const std::string wrong = relief::hosts::ReadDepthHeights(this->Self->Renderer, depths);
  if (!wrong.empty())
  {
    return wrong;
  }
  this->View = depths.view;
  this->Frame.columns = depths.columns;
  this->Frame.rows = depths.rows;
  std::copy_n(depths.origin, 2, this->Frame.first);
  std::copy_n(depths.spacing, 2, this->Frame.spacing);
  if (this->Self->GenerateNormals || this->Self->GenerateColors)
  {
    vtkWarningWithObjectMacro(this->Self,
      "Normals and colors are of meshes only: a depth buffer has none, and they are left out.");
  }
  return this->Finish(output, depths.heights.data(), 0.0);
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::Implementation::Measure(
  const double* heights, vtkIdType count, double range[2]) const
{
  range[0] = std::numeric_limits<double>::infinity();
  range[1] = -range[0];
  for (vtkIdType i = 0; i < count; ++i)
  {
    range[0] = heights[i] < range[0] ? heights[i] : range[0];
    range[1] = heights[i] > range[1] ? heights[i] : range[1];
  }
}

//------------------------------------------------------------------------------
template <class T>
void vtkDepthToHeightField::Implementation::Convert(
  const double* heights, vtkIdType count, double base, const double range[2], T* to)
{
  const double size = range[1] - range[0];
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double height = this->Self->Normalize == SceneUnits ? heights[i] + base
      : this->Self->Normalize == FromLowest || !(size > 0.0)  ? heights[i] - range[0]
                                                              : (heights[i] - range[0]) / size;
    to[i] = static_cast<T>(height);
  }
}

//------------------------------------------------------------------------------
// Makes the output of heights, to which `base` is to be added.
std::string vtkDepthToHeightField::Implementation::Finish(
  vtkImageData* output, double* heights, double base)
{
  const relief::HeightFrame& frame = this->Frame;
  const vtkIdType count = vtkIdType{ frame.columns } * frame.rows;
  double range[2];
  this->Measure(heights, count, range);
  if (!(range[0] <= range[1]))
  {
    return this->Self->Renderer
      ? "the renderer drew nothing that has a depth"
      : "no sample hits a triangle: look from another direction, at another Frame, or more finely";
  }
  this->Self->LowestHeight = range[0] + base;
  this->Self->HighestHeight = range[1] + base;
  for (int k = 0; k < 9; ++k)
  {
    this->Self->ViewAxes[k] = this->View.axes[k / 3][k % 3];
  }
  output->SetExtent(0, frame.columns - 1, 0, frame.rows - 1, 0, 0);
  output->SetOrigin(frame.first[0], frame.first[1], 0.0);
  output->SetSpacing(frame.spacing[0], frame.spacing[1], 1.0);
  if (this->Self->OutputScalarType == VTK_DOUBLE)
  {
    const auto array = AddArray<vtkDoubleArray>(output, "Height", 1);
    this->Convert(heights, count, base, range, array->GetPointer(0));
  }
  else
  {
    const auto array = AddArray<vtkFloatArray>(output, "Height", 1);
    this->Convert(heights, count, base, range, array->GetPointer(0));
    this->WarnOfDigits();
  }
  output->GetPointData()->SetActiveScalars("Height");
  if (this->Self->GenerateMask)
  {
    this->AddMask(output);
  }
  return {};
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::Implementation::WarnOfDigits()
{
  const double low = this->Self->LowestHeight;
  const double high = this->Self->HighestHeight;
  const double size = std::max(std::max(this->Frame.columns * this->Frame.spacing[0],
                                 this->Frame.rows * this->Frame.spacing[1]),
    high - low);
  const double rounding = 0x1p-24 * std::max(std::abs(low), std::abs(high));
  if (this->Self->Normalize == SceneUnits && rounding > 1e-6 * size)
  {
    vtkWarningWithObjectMacro(this->Self,
      "Heights from "
        << low << " to " << high << " are rounded by up to " << rounding
        << " as float: SetOutputScalarTypeToDouble(), or SetNormalizeToFromLowest().");
  }
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::Implementation::AddMask(vtkImageData* output)
{
  vtkDataArray* heights = output->GetPointData()->GetScalars();
  const auto mask = AddArray<vtkUnsignedCharArray>(output, "Mask", 1);
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    mask->SetValue(i, std::isnan(heights->GetComponent(i, 0)) ? 0 : 1);
  }
}

//------------------------------------------------------------------------------
void vtkDepthToHeightField::Implementation::AddAttributes(
  vtkImageData* output, const std::vector<std::uint32_t>& triangles)
{
  relief::hosts::SampledTriangles samples;
  samples.triangles = &this->Triangles;
  samples.ofSamples = triangles.data();
  samples.columns = this->Frame.columns;
  samples.rows = this->Frame.rows;
  std::copy_n(this->Frame.spacing, 2, samples.spacing);
  if (this->Self->GenerateNormals)
  {
    relief::hosts::FillNormals(samples, AddArray<vtkFloatArray>(output, "Normals", 3));
  }
  const int components =
    this->Self->GenerateColors ? relief::hosts::FindColorComponents(this->Triangles) : 0;
  if (components > 0)
  {
    relief::hosts::FillColors(samples, AddArray<vtkUnsignedCharArray>(output, "Color", components));
  }
}

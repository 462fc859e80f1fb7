// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNormalMapToHeightField.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefAbort.h"
#include "vtkReliefSetters.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "HeightInputs.h"
#include "ImageFrame.h"
#include "NormalHeights.h"
#include "NormalMap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <new>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkNormalMapToHeightField);

namespace
{
constexpr vtkIdType LargestSize = vtkIdType(1) << 28;
constexpr double LargestSpacing = 1e30;
// Columns and rows may be that many times as far apart as the others.
constexpr double LargestAspect = 1e6;
// Depths of a perspective view within one part: beyond, exp() leaves single precision.
constexpr double LargestLogDepth = 15.0;

// Which type holds heights of normals of a type.
int OutputType(int inputType)
{
  switch (inputType)
  {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
    case VTK_UNSIGNED_CHAR:
    case VTK_SHORT:
    case VTK_UNSIGNED_SHORT:
    case VTK_FLOAT:
      return VTK_FLOAT;
    default:
      return VTK_DOUBLE;
  }
}

vtkDataArray* ScalarsOf(vtkImageData* image)
{
  return image ? image->GetPointData()->GetScalars() : nullptr;
}

// Of integers; fractions reach 1.
double LargestCode(vtkDataArray* array)
{
  const bool fractions = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  return fractions ? 1.0 : array->GetDataTypeMax();
}

// Checks an image of one component that lies beside another; it may be null.
std::string CheckBeside(vtkImageData* image, vtkImageData* other, const char* what)
{
  std::string wrong =
    other ? relief::hosts::CheckInput(other, ScalarsOf(other), what) : std::string();
  const int* expected = image->GetExtent();
  if (other && wrong.empty() && !std::equal(expected, expected + 6, other->GetExtent()))
  {
    const int* given = other->GetExtent();
    std::ostringstream message;
    message << "the " << what << " image's extent is (" << given[0] << ", " << given[1] << ", "
            << given[2] << ", " << given[3] << "), that of the normals is expected: ("
            << expected[0] << ", " << expected[1] << ", " << expected[2] << ", " << expected[3]
            << ")";
    wrong = message.str();
  }
  return wrong;
}

template <class T>
std::function<double(int, int)> ReadOneOf(const T* values, int columns)
{
  return [values, columns](int i, int j)
  { return static_cast<double>(values[static_cast<std::ptrdiff_t>(j) * columns + i]); };
}

// The values of an image; none where there is no image.
std::function<double(int, int)> ReadOne(vtkImageData* image)
{
  std::function<double(int, int)> read;
  if (image)
  {
    vtkDataArray* values = ScalarsOf(image);
    switch (values->GetDataType())
    {
      vtkTemplateMacro(read = ReadOneOf(static_cast<const VTK_TT*>(values->GetVoidPointer(0)),
                         image->GetDimensions()[0]));
    }
  }
  return read;
}

relief::NormalMap Read(vtkDataArray* normals, const int* dimensions, int encoding, double zeroCode,
  const std::function<double(int, int)>& mask, const std::function<double(int, int)>& weights,
  const relief::NormalCamera& camera)
{
  relief::NormalMap map;
  switch (normals->GetDataType())
  {
    vtkTemplateMacro({
      relief::NormalSource<VTK_TT> source;
      source.data = static_cast<const VTK_TT*>(normals->GetVoidPointer(0));
      source.columns = dimensions[0];
      source.rows = dimensions[1];
      source.components = normals->GetNumberOfComponents();
      source.encoding = static_cast<relief::NormalEncoding>(encoding);
      source.zeroCode = zeroCode;
      source.weight = weights;
      if (mask)
      {
        // Only numbers other than 0 are data.
        source.hasData = [&mask](int i, int j)
        {
          const double value = mask(i, j);
          return value < 0.0 || value > 0.0;
        };
      }
      map = relief::ReadNormals(source, camera, relief::hosts::ForRows);
    });
  }
  return map;
}

void WriteHeights(const std::vector<double>& heights, double unit, vtkDataArray* result)
{
  for (std::size_t at = 0; at < heights.size(); ++at)
  {
    result->SetComponent(static_cast<vtkIdType>(at), 0, unit * heights[at]);
  }
}

// From logarithms of depths about their mean.
void WriteDepths(const std::vector<double>& logarithms, double distance, vtkDataArray* result)
{
  for (std::size_t at = 0; at < logarithms.size(); ++at)
  {
    const double bounded = std::max(std::min(logarithms[at], LargestLogDepth), -LargestLogDepth);
    result->SetComponent(static_cast<vtkIdType>(at), 0,
      std::isnan(logarithms[at]) ? logarithms[at] : distance * -std::expm1(bounded));
  }
}
}

//------------------------------------------------------------------------------
struct vtkNormalMapToHeightField::Inputs
{
  vtkImageData* image = nullptr;
  vtkDataArray* normals = nullptr;
  vtkImageData* mask = nullptr;
  vtkImageData* weights = nullptr;
};

//------------------------------------------------------------------------------
vtkNormalMapToHeightField::vtkNormalMapToHeightField()
  : PrincipalPointX(std::numeric_limits<double>::quiet_NaN())
  , PrincipalPointY(std::numeric_limits<double>::quiet_NaN())
{
  this->SetNumberOfInputPorts(3);
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetEncoding(int value)
{
  relief::SetNumber(this, this->Encoding, value, value >= AutomaticEncoding && value <= Signed,
    "0 (automatic), 1 (unsigned) or 2 (signed)", "Encoding");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetZeroCode(double value)
{
  relief::SetNumber(this, this->ZeroCode, value, value >= 0.0 || value == -1.0,
    "-1, or a code of at least 0", "ZeroCode");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetGreen(int value)
{
  relief::SetNumber(this, this->Green, value, value >= AutomaticGreen && value <= Down,
    "0 (automatic), 1 (up) or 2 (down)", "Green");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetMethod(int value)
{
  relief::SetNumber(this, this->Method, value, value >= LeastSquares && value <= PathSums,
    "0 (least squares), 1 (discontinuity preserving) or 2 (path sums)", "Method");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetProjection(int value)
{
  relief::SetNumber(this, this->Projection, value, value == Orthographic || value == Perspective,
    "0 (orthographic) or 1 (perspective)", "Projection");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetFocalLengthX(double value)
{
  relief::SetNumber(
    this, this->FocalLengthX, value, value >= 0.0, "a finite number of at least 0", "FocalLengthX");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetFocalLengthY(double value)
{
  relief::SetNumber(
    this, this->FocalLengthY, value, value >= 0.0, "a finite number of at least 0", "FocalLengthY");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetPrincipalPointX(double value)
{
  if (!std::isnan(value))
  {
    relief::SetNumber(
      this, this->PrincipalPointX, value, true, "a finite number or NaN", "PrincipalPointX");
  }
  else if (!std::isnan(this->PrincipalPointX))
  {
    this->PrincipalPointX = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetPrincipalPointY(double value)
{
  if (!std::isnan(value))
  {
    relief::SetNumber(
      this, this->PrincipalPointY, value, true, "a finite number or NaN", "PrincipalPointY");
  }
  else if (!std::isnan(this->PrincipalPointY))
  {
    this->PrincipalPointY = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetDistance(double value)
{
  relief::SetNumber(this, this->Distance, value, value >= 1e-30 && value <= 1e30,
    "a number from 1e-30 to 1e30", "Distance");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetDatum(int value)
{
  relief::SetNumber(this, this->Datum, value, value == Mean || value == Minimum,
    "0 (mean) or 1 (minimum)", "Datum");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetSmoothness(double value)
{
  relief::SetNumber(this, this->Smoothness, value, value > 0.0 && value <= 1000.0,
    "a number above 0, at most 1000", "Smoothness");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetMaximumIterations(int value)
{
  relief::SetNumber(this, this->MaximumIterations, value, value >= 1,
    "a whole number of at least 1", "MaximumIterations");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetEnergyTolerance(double value)
{
  relief::SetNumber(this, this->EnergyTolerance, value, value >= 0.0 && value <= 1.0,
    "a number from 0 to 1", "EnergyTolerance");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetTolerance(double value)
{
  relief::SetNumber(this, this->Tolerance, value, value >= 1e-12 && value <= 0.1,
    "a number from 1e-12 to 0.1", "Tolerance");
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetMaskData(vtkImageData* mask)
{
  this->SetInputData(1, mask);
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetMaskConnection(vtkAlgorithmOutput* mask)
{
  this->SetInputConnection(1, mask);
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetWeightsData(vtkImageData* weights)
{
  this->SetInputData(2, weights);
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::SetWeightsConnection(vtkAlgorithmOutput* weights)
{
  this->SetInputConnection(2, weights);
}

//------------------------------------------------------------------------------
int vtkNormalMapToHeightField::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkNormalMapToHeightField::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* scalars =
    vtkDataObject::GetActiveFieldInformation(inputs[0]->GetInformationObject(0),
      vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  const bool known = scalars && scalars->Has(vtkDataObject::FIELD_ARRAY_TYPE());
  vtkDataObject::SetPointDataActiveScalarInfo(outputs->GetInformationObject(0),
    known ? OutputType(scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE())) : VTK_FLOAT, 1);
  return 1;
}

//------------------------------------------------------------------------------
// Each height depends on all normals: all of the input is asked for.
int vtkNormalMapToHeightField::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < 3; ++port)
  {
    if (vtkInformation* info = inputs[port]->GetInformationObject(0))
    {
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
        info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
// An empty text, or what is wrong.
std::string vtkNormalMapToHeightField::Check(const Inputs& inputs) const
{
  std::string wrong = relief::hosts::CheckImage(inputs.image, inputs.normals, "normal");
  std::ostringstream message;
  const double* spacing = wrong.empty() ? inputs.image->GetSpacing() : nullptr;
  const auto inRange = [](double length)
  { return std::abs(length) >= 1.0 / LargestSpacing && std::abs(length) <= LargestSpacing; };
  if (!wrong.empty())
  {
    return wrong;
  }
  const int components = inputs.normals->GetNumberOfComponents();
  const double aspect = std::abs(spacing[1] / spacing[0]);
  if (components != 3 && components != 4)
  {
    message << "the normal image has " << components
            << " components, 3 (x, y, z) or 4 (with alpha) are expected";
  }
  else if (inputs.image->GetNumberOfPoints() > LargestSize)
  {
    message << "the normal image has " << inputs.image->GetNumberOfPoints()
            << " samples, at most 2^28 are expected; integrate parts of it";
  }
  else if (!inRange(spacing[0]) || !inRange(spacing[1]) || aspect > LargestAspect ||
    aspect < 1.0 / LargestAspect)
  {
    message << "the spacing is (" << spacing[0] << ", " << spacing[1]
            << "), sizes from 1e-30 to 1e30 with a ratio of at most 1e6 are expected";
  }
  else if (this->Projection == Perspective && !(this->FocalLengthX > 0.0))
  {
    message << "FocalLengthX is " << this->FocalLengthX
            << ", a number of samples above 0 is expected for a perspective view; set it";
  }
  else if (this->ZeroCode > LargestCode(inputs.normals))
  {
    message << "ZeroCode is " << this->ZeroCode << ", at most " << LargestCode(inputs.normals)
            << ", the largest code, is expected; set it, or -1";
  }
  else
  {
    wrong = CheckBeside(inputs.image, inputs.mask, "mask");
    return wrong.empty() ? CheckBeside(inputs.image, inputs.weights, "weight") : wrong;
  }
  return message.str();
}

//------------------------------------------------------------------------------
relief::NormalCamera vtkNormalMapToHeightField::MakeCamera(const int* dimensions) const
{
  relief::NormalCamera camera;
  camera.perspective = this->Projection == Perspective;
  camera.focalX = this->FocalLengthX;
  camera.focalY = this->FocalLengthY > 0.0 ? this->FocalLengthY : this->FocalLengthX;
  camera.centerX =
    std::isnan(this->PrincipalPointX) ? 0.5 * (dimensions[0] - 1) : this->PrincipalPointX;
  camera.centerY =
    std::isnan(this->PrincipalPointY) ? 0.5 * (dimensions[1] - 1) : this->PrincipalPointY;
  return camera;
}

//------------------------------------------------------------------------------
relief::NormalRequest vtkNormalMapToHeightField::MakeRequest(const Inputs& inputs)
{
  relief::NormalRequest request;
  relief::NormalIntegration& integration = request.integration;
  integration.camera = this->MakeCamera(inputs.image->GetDimensions());
  integration.limits.tolerance = this->Tolerance;
  // A second solver begins anew.
  integration.limits.proceed = [this, most = 0.0](double share) mutable
  {
    most = std::max(most, share);
    this->UpdateProgress(most);
    return !vtkReliefIsAborted(this);
  };
  if (!integration.camera.perspective)
  {
    relief::ScaleSpacing(inputs.image->GetSpacing(), integration.spacing);
  }
  request.green = static_cast<relief::GreenAxis>(this->Green);
  request.method = static_cast<relief::NormalMethod>(this->Method);
  request.bilateral.smoothness = this->Smoothness;
  request.bilateral.tolerance = this->EnergyTolerance;
  request.bilateral.maximumIterations = this->MaximumIterations;
  request.datum = this->Datum == Minimum && !integration.camera.perspective
    ? relief::HeightDatum::Minimum
    : relief::HeightDatum::Mean;
  return request;
}

//------------------------------------------------------------------------------
// Whether heights were found: not if an observer ended the work. `wrong`: why there are none.
bool vtkNormalMapToHeightField::Integrate(
  const Inputs& inputs, vtkDataArray* result, std::string& wrong)
{
  const relief::NormalRequest request = this->MakeRequest(inputs);
  const bool perspective = request.integration.camera.perspective;
  relief::NormalMap map = Read(inputs.normals, inputs.image->GetDimensions(), this->Encoding,
    this->ZeroCode, ReadOne(inputs.mask), ReadOne(inputs.weights), request.integration.camera);
  this->UsedEncoding = map.encoding == relief::NormalEncoding::Unsigned ? Unsigned : Signed;
  relief::NormalHeights found;
  wrong = relief::FindNormalHeights(std::move(map), request, relief::hosts::ForRows, found);
  this->UsedGreen = static_cast<int>(found.green);
  this->GreenKnown = found.greenKnown;
  if (!wrong.empty())
  {
    std::ostringstream message;
    message << wrong << " at the Smoothness " << this->Smoothness
            << "; lower it, or take the method LeastSquares";
    wrong = message.str();
    return false;
  }
  if (found.end.stopped)
  {
    return false;
  }
  this->NumberOfParts = found.parts;
  this->NumberOfIterations = found.end.iterations;
  this->Converged = found.end.converged;
  if (perspective)
  {
    WriteDepths(found.heights, this->Distance, result);
  }
  else
  {
    double scaled[2];
    WriteHeights(found.heights, relief::ScaleSpacing(inputs.image->GetSpacing(), scaled), result);
  }
  return true;
}

//------------------------------------------------------------------------------
int vtkNormalMapToHeightField::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs, 0);
  output->Initialize();
  Inputs given;
  given.image = vtkImageData::GetData(inputs[0]);
  given.normals = ScalarsOf(given.image);
  given.mask = vtkImageData::GetData(inputs[1]);
  given.weights = vtkImageData::GetData(inputs[2]);
  std::string wrong = this->Check(given);
  try
  {
    if (wrong.empty())
    {
      output->CopyStructure(given.image);
      output->AllocateScalars(OutputType(given.normals->GetDataType()), 1);
      vtkDataArray* result = output->GetPointData()->GetScalars();
      result->SetName("Height");
      if (this->Integrate(given, result, wrong))
      {
        output->GetFieldData()->PassData(given.image->GetFieldData());
      }
      else
      {
        output->Initialize();
      }
    }
  }
  catch (const std::bad_alloc&)
  {
    wrong = "there is not enough memory to integrate the normals";
  }
  if (!wrong.empty())
  {
    output->Initialize();
    vtkErrorMacro(<< wrong << ".");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkNormalMapToHeightField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Encoding: " << this->Encoding << "\n";
  os << indent << "ZeroCode: " << this->ZeroCode << "\n";
  os << indent << "Green: " << this->Green << "\n";
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "Projection: " << this->Projection << "\n";
  os << indent << "FocalLengthX: " << this->FocalLengthX << "\n";
  os << indent << "FocalLengthY: " << this->FocalLengthY << "\n";
  os << indent << "PrincipalPointX: " << this->PrincipalPointX << "\n";
  os << indent << "PrincipalPointY: " << this->PrincipalPointY << "\n";
  os << indent << "Distance: " << this->Distance << "\n";
  os << indent << "Datum: " << this->Datum << "\n";
  os << indent << "Smoothness: " << this->Smoothness << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "EnergyTolerance: " << this->EnergyTolerance << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "UsedEncoding: " << this->UsedEncoding << "\n";
  os << indent << "UsedGreen: " << this->UsedGreen << "\n";
  os << indent << "GreenKnown: " << this->GreenKnown << "\n";
  os << indent << "NumberOfParts: " << this->NumberOfParts << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "Converged: " << this->Converged << "\n";
}

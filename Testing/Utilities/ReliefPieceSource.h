// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefPieceSource_h
#define ReliefPieceSource_h

/// @file
/// A source that hands out the parts of an image that it is asked for, and a look at pieces of
/// shaded images.

#include "ReliefTestUtilities.h"

#include "vtkImageAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <array>

/// Hands out copies of parts of an image and counts them.
class ReliefPieceSource : public vtkImageAlgorithm
{
public:
  static ReliefPieceSource* New();
  vtkTypeMacro(ReliefPieceSource, vtkImageAlgorithm);

  void SetImage(vtkImageData* image)
  {
    this->Images[0] = image;
    this->Modified();
  }
  /// Of a second port.
  void SetSecondImage(vtkImageData* image)
  {
    this->Images[1] = image;
    this->SetNumberOfOutputPorts(2);
  }

  /// The extents that the first port has been asked for.
  std::vector<std::array<int, 6>> Extents;
  /// The most samples in one.
  vtkIdType Largest = 0;
  /// Hands out so many columns less than asked for.
  int Withheld = 0;

protected:
  ReliefPieceSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkImageData* image = this->Images[port];
      vtkInformation* info = outputs->GetInformationObject(port);
      info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), image->GetExtent(), 6);
      info->Set(vtkDataObject::SPACING(), image->GetSpacing(), 3);
      info->Set(vtkDataObject::ORIGIN(), image->GetOrigin(), 3);
      info->Set(vtkDataObject::DIRECTION(), image->GetDirectionMatrix()->GetData(), 9);
      info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
      vtkDataObject::SetPointDataActiveScalarInfo(
        info, image->GetScalarType(), image->GetNumberOfScalarComponents());
    }
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkInformation* info = outputs->GetInformationObject(port);
      std::array<int, 6> extent;
      info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent.data());
      extent[1] -= this->Withheld;
      vtkImageData* output = vtkImageData::GetData(info);
      output->ShallowCopy(this->Images[port]);
      if (extent[0] > extent[1] || extent[2] > extent[3])
      {
        output->Initialize();
        continue;
      }
      output->Crop(extent.data());
      if (port == 0)
      {
        this->Extents.push_back(extent);
        this->Largest = std::max(this->Largest, output->GetNumberOfPoints());
      }
    }
    return 1;
  }

private:
  ReliefPieceSource(const ReliefPieceSource&) = delete;
  void operator=(const ReliefPieceSource&) = delete;

  vtkSmartPointer<vtkImageData> Images[2];
};
inline vtkStandardNewMacro(ReliefPieceSource);

/// Where a piece of a shaded image is not bit for bit that of the whole, in words; empty if it is
/// everywhere. Pieces may have arrays of their own, which tell of ghosts.
inline std::string FindPieceDifference(vtkImageData* piece, vtkImageData* whole)
{
  const int* part = piece->GetExtent();
  const int* all = whole->GetExtent();
  for (int array = 0; array < whole->GetPointData()->GetNumberOfArrays(); ++array)
  {
    vtkDataArray* b = whole->GetPointData()->GetArray(array);
    vtkDataArray* a = piece->GetPointData()->GetArray(b->GetName());
    if (!a)
    {
      return std::string("there is no ") + b->GetName();
    }
    const vtkIdType tuple = a->GetNumberOfComponents() * a->GetDataTypeSize();
    const char* own = static_cast<const char*>(a->GetVoidPointer(0));
    const char* other = static_cast<const char*>(b->GetVoidPointer(0));
    for (int j = part[2]; j <= part[3]; ++j)
    {
      for (int i = part[0]; i <= part[1]; ++i, own += tuple)
      {
        const vtkIdType at =
          static_cast<vtkIdType>(j - all[2]) * (all[1] - all[0] + 1) + (i - all[0]);
        if (std::memcmp(own, other + at * tuple, static_cast<std::size_t>(tuple)) != 0)
        {
          return std::string(a->GetName()) + " at (" + std::to_string(i) + ", " +
            std::to_string(j) + "): " + std::to_string(Value(piece, a->GetName(), i, j)) +
            " is not " + std::to_string(Value(whole, a->GetName(), i, j));
        }
      }
    }
  }
  return std::string();
}

#endif

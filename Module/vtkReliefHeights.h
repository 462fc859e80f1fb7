// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefHeights_h
#define vtkReliefHeights_h

/// @file
/// The heights that a host shades, made from its inputs once and kept until they change. Private to
/// the module.

#include "HeightField.h"
#include "vtkReliefConversion.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <tuple>

class vtkDataArray;
class vtkImageData;

class vtkReliefHeights
{
public:
  /// Where heights come from and how they are read. The mask may be null.
  struct Source
  {
    vtkImageData* image = nullptr;
    vtkDataArray* scalars = nullptr;
    vtkImageData* mask = nullptr;
    vtkDataArray* maskScalars = nullptr;
    double scale = 1.0;
    bool useNoData = false;
    double noData = 0.0;
    bool padded = false; ///< as relief::HeightField::Assign() takes it
  };

  /// Checks the source and prepares its heights, unless those at hand still hold. Returns an empty
  /// text, or what is wrong; then there are none.
  std::string Update(const Source& source);

  /// Whether there are any.
  bool IsReady() const { return this->Field != nullptr; }

  ///@{
  /// What has been prepared.
  const relief::HeightField& GetField() const { return *this->Field; }
  const vtkReliefImageFrame& GetFrame() const { return this->Frame; }
  ///@}

  void Release();

private:
  std::string Prepare(const Source& source);

  std::unique_ptr<relief::HeightField> Field;
  vtkReliefImageFrame Frame;
  vtkSmartPointer<vtkDataArray> InPlace; // what the field uses where it is
  // Modification times are never given twice.
  using Origin = std::tuple<vtkMTimeType, vtkMTimeType, void*, void*, double, bool, double, bool>;
  Origin MadeFrom;
};

#endif

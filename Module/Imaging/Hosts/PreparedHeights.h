// SPDX-License-Identifier: BSD-3-Clause
#ifndef PreparedHeights_h
#define PreparedHeights_h

/// @file
/// The heights that a host shades, made from its inputs once and kept until they change. Not
/// installed.

#include "HeightField.h"
#include "HeightInputs.h"
#include "ImageFrame.h"
#include "TiledHeights.h"
#include "vtkReliefShadingModule.h" // For export macro
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <tuple>

class vtkDataArray;
class vtkImageData;

namespace relief::hosts
{
class VTKRELIEFSHADING_EXPORT PreparedHeights
{
public:
  using Source = HeightInputs;

  /// Checks the source and prepares its heights, unless those at hand still hold. Returns an empty
  /// text, or what is wrong; then there are none.
  std::string Update(const Source& source);

  /// Whether there are any.
  bool IsReady() const { return this->Field != nullptr || this->Tiled; }

  ///@{
  /// What has been prepared.
  const HeightField& GetField() const
  {
    return this->Tiled ? this->Tiled->GetField() : *this->Field;
  }
  const ImageFrame& GetFrame() const { return this->Frame; }
  ///@}

  /// The heights if they are read as they are needed, and have to be provided then; else null.
  TiledHeights* GetTiled() const { return this->Tiled; }

  void Release();

private:
  std::string Prepare(const Source& source);
  std::string PrepareTiled(const Source& source);

  std::unique_ptr<HeightField> Field;
  vtkSmartPointer<TiledHeights> Tiled;
  ImageFrame Frame;
  vtkSmartPointer<vtkDataArray> InPlace; // what the field uses where it is
  // Modification times are never given twice.
  using Origin =
    std::tuple<void*, vtkMTimeType, vtkMTimeType, void*, void*, double, bool, double, bool>;
  Origin MadeFrom;
};
}

#endif

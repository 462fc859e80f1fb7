// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightInputs_h
#define HeightInputs_h

/// @file
/// Heights as VTK has them, of any type, and how the model reads them. Not installed.

#include "HeightField.h"
#include "PaddedHeights.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>

namespace relief::hosts
{
/// Where heights come from and how they are read. The mask may be null.
struct HeightInputs
{
  vtkImageData* image = nullptr;
  vtkDataArray* scalars = nullptr;
  vtkImageData* mask = nullptr;
  vtkDataArray* maskScalars = nullptr;
  double scale = 1.0;
  bool useNoData = false;
  double noData = 0.0;
  bool padded = false; ///< as HeightField::Assign() takes it
};

/// An empty text, or what is wrong with the heights or their mask.
VTKRELIEFSHADING_EXPORT std::string CheckHeights(const HeightInputs& inputs);

/// The same of inputs that hold parts of the whole, maybe different ones.
VTKRELIEFSHADING_EXPORT std::string CheckPart(const HeightInputs& inputs);

/// Tells whether a sample has data by the mask; none where there is no mask.
VTKRELIEFSHADING_EXPORT std::function<bool(int, int)> ReadMask(const HeightInputs& inputs);

/// The model's way to use all threads.
VTKRELIEFSHADING_EXPORT void ForRows(int count, const std::function<void(int, int)>& body);

/// The padded array that the heights of inputs are; null where they are another.
VTKRELIEFSHADING_EXPORT const PaddedHeights* FindPadded(const HeightInputs& inputs);

/// All but where the samples are.
template <class T>
void FillSource(const HeightInputs& inputs, const double spacing[2], HeightSource<T>& heights)
{
  const int* extent = inputs.image->GetExtent();
  heights.columns = extent[1] - extent[0] + 1;
  heights.rows = extent[3] - extent[2] + 1;
  heights.stepY = heights.columns;
  heights.spacingX = spacing[0];
  heights.spacingY = spacing[1];
  heights.scale = inputs.scale;
  heights.hasNoData = inputs.useNoData && !std::isnan(inputs.noData);
  heights.noData = inputs.noData;
  heights.hasData = ReadMask(inputs);
}

/// Calls body with the HeightSource, of the samples' own type, of inputs that were checked.
template <class Body>
void WithHeightSource(const HeightInputs& inputs, const double spacing[2], const Body& body)
{
  if (const PaddedHeights* padded = FindPadded(inputs))
  {
    HeightSource<float> heights;
    FillSource(inputs, spacing, heights);
    heights.data = padded->GetRow(0);
    heights.stepY = padded->GetPitch();
    heights.margin = PaddedHeights::GetMargin();
    body(heights);
    return;
  }
  switch (inputs.scalars->GetDataType())
  {
    vtkTemplateMacro({
      HeightSource<VTK_TT> heights;
      FillSource(inputs, spacing, heights);
      heights.data = static_cast<const VTK_TT*>(inputs.scalars->GetVoidPointer(0));
      body(heights);
    });
  }
}
}

#endif

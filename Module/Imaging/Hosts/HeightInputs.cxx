// SPDX-License-Identifier: BSD-3-Clause
#include "HeightInputs.h"

#include "ImageFrame.h"
#include "vtkReliefThreads.h"

#include <algorithm>
#include <sstream>

namespace relief::hosts
{
namespace
{
template <class T>
std::function<bool(int, int)> ReadMaskOf(const T* mask, int columns)
{
  return [mask, columns](int i, int j)
  {
    T value = mask[static_cast<std::ptrdiff_t>(j) * columns + i];
    return value == value && value != 0;
  };
}
}

//------------------------------------------------------------------------------
std::string CheckPart(const HeightInputs& inputs)
{
  if (!inputs.image)
  {
    return "there are no heights";
  }
  const std::string wrong = CheckInput(inputs.image, inputs.scalars, "height");
  return wrong.empty() && inputs.mask ? CheckInput(inputs.mask, inputs.maskScalars, "mask") : wrong;
}

//------------------------------------------------------------------------------
std::string CheckHeights(const HeightInputs& inputs)
{
  std::string wrong = CheckPart(inputs);
  if (!wrong.empty() || !inputs.mask)
  {
    return wrong;
  }
  const int* expected = inputs.image->GetExtent();
  const int* given = inputs.mask->GetExtent();
  if (!std::equal(expected, expected + 6, given))
  {
    std::ostringstream message;
    message << "the mask's extent is (" << given[0] << ", " << given[1] << ", " << given[2] << ", "
            << given[3] << "), that of the heights is expected: (" << expected[0] << ", "
            << expected[1] << ", " << expected[2] << ", " << expected[3] << ")";
    wrong = message.str();
  }
  return wrong;
}

//------------------------------------------------------------------------------
const PaddedHeights* FindPadded(const HeightInputs& inputs)
{
  const auto* padded = PaddedHeights::SafeDownCast(inputs.scalars);
  const int* extent = inputs.image->GetExtent();
  const bool fits = padded && padded->GetColumns() == extent[1] - extent[0] + 1 &&
    padded->GetRows() == extent[3] - extent[2] + 1;
  return fits ? padded : nullptr;
}

//------------------------------------------------------------------------------
std::function<bool(int, int)> ReadMask(const HeightInputs& inputs)
{
  std::function<bool(int, int)> hasData;
  if (inputs.mask)
  {
    const int* extent = inputs.image->GetExtent();
    const int columns = extent[1] - extent[0] + 1;
    switch (inputs.maskScalars->GetDataType())
    {
      vtkTemplateMacro(
        hasData =
          ReadMaskOf(static_cast<const VTK_TT*>(inputs.maskScalars->GetVoidPointer(0)), columns));
    }
  }
  return hasData;
}

//------------------------------------------------------------------------------
void ForRows(int count, const std::function<void(int, int)>& body)
{
  vtkReliefFor(0, count, 0,
    [&](vtkIdType begin, vtkIdType end) { body(static_cast<int>(begin), static_cast<int>(end)); });
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "HeightScale.h"

#include "HeightFit.h"
#include "HeightHash.h"
#include "HeightSteps.h"
#include "ImageFrame.h"
#include "TiledHeights.h"

#include <charconv>
#include <exception>
#include <new>

namespace relief::hosts
{
//------------------------------------------------------------------------------
double FitHeightScale(const HeightInputs& inputs, std::string& wrong)
{
  ImageFrame frame;
  wrong = CheckHeights(inputs);
  wrong = wrong.empty() ? frame.Assign(inputs.image) : wrong;
  double scale = 0.0;
  if (wrong.empty())
  {
    try
    {
      if (TiledHeights* tiled = FindTiled(inputs))
      {
        return tiled->FitScale(frame.Spacing);
      }
      WithHeightSource(inputs, frame.Spacing,
        [&scale](const auto& heights) { scale = relief::FitHeightScale(heights, ForRows); });
    }
    catch (const std::bad_alloc&)
    {
      wrong = "there is not enough memory to look at the heights";
    }
    catch (const std::exception& error)
    {
      wrong = error.what();
    }
  }
  return scale;
}

//------------------------------------------------------------------------------
double RoundHeightScale(double scale)
{
  char digits[32];
  const std::to_chars_result end =
    std::to_chars(digits, digits + sizeof(digits), scale, std::chars_format::scientific, 5);
  double rounded = scale;
  std::from_chars(digits, end.ptr, rounded);
  return rounded;
}

//------------------------------------------------------------------------------
bool ShowsTerraces(const HeightInputs& inputs)
{
  const double spacing[2] = { 1.0, 1.0 };
  bool shows = false;
  if (CheckHeights(inputs).empty() && !FindTiled(inputs) &&
    inputs.scalars->GetDataType() != VTK_FLOAT && inputs.scalars->GetDataType() != VTK_DOUBLE)
  {
    WithHeightSource(
      inputs, spacing, [&shows](const auto& heights) { shows = relief::ShowsTerraces(heights); });
  }
  return shows;
}

//------------------------------------------------------------------------------
std::uint64_t HashHeights(const HeightInputs& inputs, std::string& wrong)
{
  const double spacing[2] = { 1.0, 1.0 };
  std::uint64_t hash = 0;
  wrong = inputs.image ? CheckHeights(inputs) : "there are no heights";
  if (wrong.empty() && FindTiled(inputs))
  {
    try
    {
      hash = FindTiled(inputs)->Survey().hash;
    }
    catch (const std::exception& error)
    {
      wrong = error.what();
    }
  }
  else if (wrong.empty())
  {
    WithHeightSource(inputs, spacing,
      [&hash](const auto& heights) { hash = relief::HashHeights(heights, ForRows); });
  }
  return hash;
}
}

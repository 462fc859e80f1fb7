// SPDX-License-Identifier: BSD-3-Clause
#include "MemoryBudget.h"

#include "FileGuard.h"

#include "vtkErrorCode.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace relief::raster
{
namespace
{
/// In mebibytes, or in kibibytes where there are fewer than one, rounded by `round`.
std::string Amount(double bytes, double (*round)(double))
{
  const double kibibyte = 1024.0;
  const double mebibyte = kibibyte * kibibyte;
  const bool few = bytes < mebibyte;
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << round(bytes / (few ? kibibyte : mebibyte))
       << (few ? " KiB" : " MiB");
  return text.str();
}
}

//------------------------------------------------------------------------------
void MemoryBudget::Claim(double bytes, double meanwhile)
{
  const double needed = this->Claimed + std::max(bytes, meanwhile);
  if (this->Limit > 0.0 && needed > this->Limit)
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      Amount(needed, std::ceil) + " of memory are needed, " + this->Name + " allows " +
        Amount(this->Limit, std::floor));
  }
  this->Claimed += bytes;
}

//------------------------------------------------------------------------------
vtkTypeInt64 MemoryBudget::GetLeft() const
{
  return this->Limit > 0.0
    ? std::max<vtkTypeInt64>(1, static_cast<vtkTypeInt64>((this->Limit - this->Claimed) / 1024.0))
    : 0;
}

//------------------------------------------------------------------------------
void MemoryPlan::Claim(double columns, double rows, double bytes, double meanwhile) const
{
  const double pixels = columns * rows;
  const double kept = (this->Copies * bytes + this->PerPixel) * pixels;
  this->Budget.Claim(kept, bytes * pixels + meanwhile);
}
}

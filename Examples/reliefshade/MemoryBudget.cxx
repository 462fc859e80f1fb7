// SPDX-License-Identifier: BSD-3-Clause
#include "MemoryBudget.h"

#include "vtkNew.h"
#include "vtkOpenImageIOReader.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace reliefshade
{

//------------------------------------------------------------------------------
double machineMemory()
{
  return 1024.0 * vtkNew<vtkOpenImageIOReader>()->GetMemoryLimit(); // its default
}

//------------------------------------------------------------------------------
void MemoryBudget::Claim(double bytes, double meanwhile)
{
  const double needed = this->Claimed + std::max(bytes, meanwhile);
  if (this->Limit > 0.0 && needed > this->Limit)
  {
    const double mebibyte = 1024.0 * 1024.0;
    std::ostringstream text;
    text << std::fixed << std::setprecision(0) << std::ceil(needed / mebibyte)
         << " MiB of memory are needed, --memory-limit allows "
         << std::floor(this->Limit / mebibyte) << " MiB";
    throw std::runtime_error(text.str());
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

}

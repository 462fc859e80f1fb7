// SPDX-License-Identifier: BSD-3-Clause
#ifndef MemoryBudget_h
#define MemoryBudget_h

#include "vtkIOReliefRasterModule.h" // For export macro
#include "vtkType.h"

#include <string>

namespace relief::raster
{
/// The memory that a run may take. It is claimed, as files' headers tell what they need, before it
/// is allocated.
class VTKIORELIEFRASTER_EXPORT MemoryBudget
{
public:
  /// Without a limit.
  MemoryBudget() = default;

  /// The limit in bytes, 0 for none, and what users know it by.
  MemoryBudget(double limit, const std::string& name)
    : Limit(limit)
    , Name(name)
  {
  }

  /// Claims bytes that are kept to the end of the run, and checks whether there is room for those
  /// that are needed while a file is read, these among them. Throws a Failure, FileFormatError,
  /// that says how much is needed and how much allowed.
  void Claim(double bytes, double meanwhile = 0.0);

  /// What is left, in kibibytes: 0 for no limit.
  vtkTypeInt64 GetLeft() const;

private:
  double Limit = 0.0;
  double Claimed = 0.0;
  std::string Name;
};

/// What a file's pixels take beside what they take in the file.
struct VTKIORELIEFRASTER_EXPORT MemoryPlan
{
  MemoryBudget& Budget;
  /// How often the pixels are in memory as the file stores them.
  double Copies = 1.0;
  /// Bytes for each pixel beside that.
  double PerPixel = 0.0;

  /// Claims the memory for pixels of so many bytes, and `meanwhile` more until they are read.
  /// Throws a Failure.
  void Claim(double columns, double rows, double bytes, double meanwhile = 0.0) const;
};
}

#endif

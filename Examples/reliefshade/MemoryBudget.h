// SPDX-License-Identifier: BSD-3-Clause
#ifndef MemoryBudget_h
#define MemoryBudget_h

#include "vtkType.h"

namespace reliefshade
{

/// The memory that the machine has, in bytes.
double machineMemory();

/// The memory that a run may take. It is claimed, as files' headers tell what they need, before it
/// is allocated.
class MemoryBudget
{
public:
  /// Without a limit.
  MemoryBudget() = default;

  /// The limit in bytes, 0 for none.
  explicit MemoryBudget(double limit)
    : Limit(limit)
  {
  }

  /// Claims bytes that are kept to the end of the run, and checks whether there is room for those
  /// that are needed while a file is read, these among them. Throws a std::runtime_error that says
  /// how much is needed and how much allowed.
  void Claim(double bytes, double meanwhile = 0.0);

  /// What is left, in kibibytes, as vtkOpenImageIOReader::SetMemoryLimit takes it: 0 for no limit.
  vtkTypeInt64 GetLeft() const;

private:
  double Limit = 0.0;
  double Claimed = 0.0;
};

}

#endif

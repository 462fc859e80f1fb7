// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefAbort_h
#define vtkReliefAbort_h

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

/// Whether an algorithm that runs is to end. Private to the module.
inline bool vtkReliefIsAborted(vtkAlgorithm* algorithm)
{
  // Since VTK 9.2 it is CheckAbort that tells the pipeline, before the pipeline looked itself.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0)
  return algorithm->CheckAbort();
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}

#endif

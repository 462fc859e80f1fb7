// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefColumns_h
#define vtkReliefColumns_h

#include "vtkNew.h"
#include "vtkTable.h"

/// Adds an empty column to a table, which owns it. Private to the module.
template <class ArrayType>
ArrayType* vtkReliefAddColumn(vtkTable* table, const char* name)
{
  vtkNew<ArrayType> column;
  column->SetName(name);
  table->AddColumn(column);
  return column;
}

#endif

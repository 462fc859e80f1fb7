// SPDX-License-Identifier: BSD-3-Clause
#ifndef PaddedHeights_h
#define PaddedHeights_h

/// @file
/// Heights as the model wants them, so that they need not be copied. Not installed.

#include "vtkGenericDataArray.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <memory>
#include <vector>

namespace relief::hosts
{
/// The heights of an image with NaN beside its rows, and a row of that behind the last one:
/// HeightField takes them where they are. For all others it is an array of an image's heights like
/// any other, but its values lie in no one piece of memory: GetVoidPointer makes a copy of them.
class VTKRELIEFSHADING_EXPORT PaddedHeights : public vtkGenericDataArray<PaddedHeights, float>
{
  using Generic = vtkGenericDataArray<PaddedHeights, float>;

public:
  static PaddedHeights* New();
  vtkTypeMacro(PaddedHeights, Generic);

  /// Makes room for an image's heights, which are unset. Throws a std::bad_alloc.
  void MakeRoom(vtkIdType columns, vtkIdType rows);

  ///@{
  /// A row's first height, the heights from one row to the next, and the NaN to either side of one.
  float* GetRow(vtkIdType j) { return this->First + j * this->Pitch; }
  const float* GetRow(vtkIdType j) const { return this->First + j * this->Pitch; }
  vtkIdType GetColumns() const { return this->Columns; }
  vtkIdType GetRows() const { return this->Rows; }
  vtkIdType GetPitch() const { return this->Pitch; }
  static int GetMargin();
  ///@}

  ///@{
  /// What vtkGenericDataArray asks for.
  ValueType GetValue(vtkIdType at) const { return *this->Find(at); }
  void SetValue(vtkIdType at, ValueType value) { *this->Find(at) = value; }
  void GetTypedTuple(vtkIdType at, ValueType* tuple) const { *tuple = *this->Find(at); }
  void SetTypedTuple(vtkIdType at, const ValueType* tuple) { *this->Find(at) = *tuple; }
  ValueType GetTypedComponent(vtkIdType at, int) const { return *this->Find(at); }
  void SetTypedComponent(vtkIdType at, int, ValueType value) { *this->Find(at) = value; }
  ///@}

  void* GetVoidPointer(vtkIdType at) override;

protected:
  PaddedHeights() = default;
  ~PaddedHeights() override = default;

private:
  friend Generic;

  PaddedHeights(const PaddedHeights&) = delete;
  void operator=(const PaddedHeights&) = delete;

  float* Find(vtkIdType at) const
  {
    const vtkIdType row = at / this->Columns;
    return this->First + row * this->Pitch + (at - row * this->Columns);
  }
  bool AllocateTuples(vtkIdType count);
  bool ReallocateTuples(vtkIdType count);

  struct Free
  {
    void operator()(float* heights) const;
  };
  std::unique_ptr<float, Free> Memory;
  float* First = nullptr;
  vtkIdType Columns = 1;
  vtkIdType Rows = 0;
  vtkIdType Pitch = 1;
  std::vector<float> Copy; // for GetVoidPointer
};
}

#endif

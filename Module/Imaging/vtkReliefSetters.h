// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefSetters_h
#define vtkReliefSetters_h

/// @file
/// Bodies of setters that refuse a bad value: one message that names the setter, the value and what
/// was expected; the old value stays. For what is no parameter of a scene: those are in
/// SceneParameters.h. Not installed.

#include "vtkSetGet.h"
#include "vtkSmartPointer.h"

#include <cmath>

namespace relief
{
/// An object that must not be null, kept in `holder`.
template <class Object, class Value>
void SetObject(Object* self, vtkSmartPointer<Value>& holder, Value* value, const char* name)
{
  if (!value)
  {
    vtkErrorWithObjectMacro(self,
      "Set" << name << ": null was given, a " << holder->GetClassName()
            << " is expected; the old one is kept.");
    return;
  }
  if (holder != value)
  {
    holder = value;
    self->Modified();
  }
}

/// A number that must satisfy `taken`; `expected` says what that is.
template <class Object, class Number>
void SetNumber(
  Object* self, Number& member, Number value, bool taken, const char* expected, const char* name)
{
  if (!std::isfinite(static_cast<double>(value)) || !taken)
  {
    vtkErrorWithObjectMacro(self,
      "Set" << name << ": " << value << " was given, " << expected << " is expected; " << member
            << " is kept.");
    return;
  }
  if (member != value)
  {
    member = value;
    self->Modified();
  }
}
}

#endif

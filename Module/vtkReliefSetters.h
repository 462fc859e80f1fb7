// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefSetters_h
#define vtkReliefSetters_h

/// @file
/// Bodies of setters that refuse a bad value: one message that names the setter, the value and what
/// was expected; the old value stays. Private to the module.

#include "vtkSetGet.h"

#include <cmath>

/// A number that must be finite and satisfy `condition`, an expression over `value`.
#define vtkReliefSetNumberBody(name, type, condition, expected)                                    \
  void vtkReliefThisClass::Set##name(type value)                                                   \
  {                                                                                                \
    if (!std::isfinite(static_cast<double>(value)) || !(condition))                                \
    {                                                                                              \
      vtkErrorMacro("Set" #name ": " << value << " was given, " expected " is expected; "          \
                                     << this->name << " is kept.");                                \
      return;                                                                                      \
    }                                                                                              \
    if (this->name != value)                                                                       \
    {                                                                                              \
      this->name = value;                                                                          \
      this->Modified();                                                                            \
    }                                                                                              \
  }

/// A linear RGB colour.
#define vtkReliefSetColorBody(name)                                                                \
  void vtkReliefThisClass::Set##name(double r, double g, double b)                                 \
  {                                                                                                \
    if (!std::isfinite(r + g + b) || r < 0.0 || g < 0.0 || b < 0.0)                                \
    {                                                                                              \
      vtkErrorMacro("Set" #name ": (" << r << ", " << g << ", " << b                               \
                                      << ") was given, finite components of at least 0 are "       \
                                         "expected; the old colour is kept.");                     \
      return;                                                                                      \
    }                                                                                              \
    if (this->name[0] != r || this->name[1] != g || this->name[2] != b)                            \
    {                                                                                              \
      this->name[0] = r;                                                                           \
      this->name[1] = g;                                                                           \
      this->name[2] = b;                                                                           \
      this->Modified();                                                                            \
    }                                                                                              \
  }

/// A falloff's range.
#define vtkReliefSetFalloffRangeBody(name)                                                         \
  void vtkReliefThisClass::Set##name(double lo, double hi)                                         \
  {                                                                                                \
    if (!std::isfinite(lo) || !std::isfinite(hi) || lo > hi)                                       \
    {                                                                                              \
      vtkErrorMacro("Set" #name ": (" << lo << ", " << hi                                          \
                                      << ") was given, two finite numbers of which the first "     \
                                         "is not the larger are expected; ("                       \
                                      << this->name[0] << ", " << this->name[1] << ") is kept.");  \
      return;                                                                                      \
    }                                                                                              \
    if (this->name[0] != lo || this->name[1] != hi)                                                \
    {                                                                                              \
      this->name[0] = lo;                                                                          \
      this->name[1] = hi;                                                                          \
      this->Modified();                                                                            \
    }                                                                                              \
  }

/// An object that must not be null, kept in `holder`.
#define vtkReliefSetObjectBody(name, type, holder)                                                 \
  void vtkReliefThisClass::Set##name(type* value)                                                  \
  {                                                                                                \
    if (!value)                                                                                    \
    {                                                                                              \
      vtkErrorMacro(                                                                               \
        "Set" #name ": null was given, a " #type " is expected; the old one is kept.");            \
      return;                                                                                      \
    }                                                                                              \
    if ((holder) != value)                                                                         \
    {                                                                                              \
      (holder) = value;                                                                            \
      this->Modified();                                                                            \
    }                                                                                              \
  }

/// The number that stands for no data, and that there is one.
#define vtkReliefSetNoDataValueBody()                                                              \
  void vtkReliefThisClass::SetNoDataValue(double value)                                            \
  {                                                                                                \
    /* Never equal to itself, NaN must not count as a change. */                                   \
    const bool same =                                                                              \
      this->NoDataValue == value || (std::isnan(value) && std::isnan(this->NoDataValue));          \
    if (!same || !this->UseNoDataValue)                                                            \
    {                                                                                              \
      this->NoDataValue = value;                                                                   \
      this->UseNoDataValue = true;                                                                 \
      this->Modified();                                                                            \
    }                                                                                              \
  }

#endif

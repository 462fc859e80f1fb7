// SPDX-License-Identifier: BSD-3-Clause
#ifndef ParameterTestUtilities_h
#define ParameterTestUtilities_h

#include "SceneParameters.h"

/// A value that a parameter takes and that is not its default; every number of it is a float too.
inline relief::parameters::Values OtherValue(const relief::parameters::Parameter& parameter)
{
  using relief::parameters::Kind;
  const double usual = parameter.Default[0];
  switch (parameter.Is)
  {
    case Kind::Flag:
      return { 1.0 - usual, 0.0, 0.0 };
    case Kind::Choice:
      return { usual == 0.0 ? 1.0 : 0.0, 0.0, 0.0 };
    case Kind::Count:
      return { usual + 1.0, 0.0, 0.0 };
    case Kind::Color:
      return { 0.25, 0.5, 0.75 };
    case Kind::Range:
      return { 0.25, 0.75, 0.0 };
    default:
      return { usual == 0.625 ? 0.375 : 0.625, 0.0, 0.0 };
  }
}

#endif

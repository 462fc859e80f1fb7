// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefModel_h
#define ReliefModel_h

/// @file
/// ReliefLeaves.glsl, ReliefModel.glsl, ReliefSurface.glsl, ReliefSurroundings.glsl and
/// ReliefThickness.glsl compiled as
/// C++: once with real = float (namespace relief::f32, what a GPU computes, and the filter where it
/// traces single rays) and once with real = double (relief::f64, the reference).
/// ThicknessLanes-inl.h compiles ReliefLeaves.glsl for vectors, once for each instruction set.
///
/// The texts are GLSL as they stand. Here GLM supplies the vectors, the standard library the
/// functions, and the macros the few spellings in which the languages differ. Functions that read
/// the height field become templates; they find reliefHeight() and its like beside the field's own
/// type.

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#define RELIEF_FN inline
#define RELIEF_FIELD_FN template <class FieldType>
#define RELIEF_FIELD const FieldType&
#define RELIEF_OUT(type) type&
#define RELIEF_INOUT(type) type&
#define RELIEF_INFINITY std::numeric_limits<real>::infinity()
#define RELIEF_EPSILON std::numeric_limits<real>::epsilon()
#define RELIEF_NAN std::numeric_limits<real>::quiet_NaN()

#define RELIEF_USING                                                                               \
  using std::abs;                                                                                  \
  using std::acos;                                                                                 \
  using std::atan;                                                                                 \
  using std::ceil;                                                                                 \
  using std::clamp;                                                                                \
  using std::exp;                                                                                  \
  using std::floor;                                                                                \
  using std::isnan;                                                                                \
  using std::max;                                                                                  \
  using std::min;                                                                                  \
  using std::pow;                                                                                  \
  using std::sqrt;

namespace relief
{
namespace f32
{
RELIEF_USING
using real = float;
using real3 = glm::vec3;
#include "ReliefLeaves.glsl"
#include "ReliefModel.glsl"
#include "ReliefSurface.glsl"
#include "ReliefSurroundings.glsl"
#include "ReliefThickness.glsl"
}

namespace f64
{
RELIEF_USING
using real = double;
using real3 = glm::dvec3;
#include "ReliefLeaves.glsl"
#include "ReliefModel.glsl"
#include "ReliefSurface.glsl"
#include "ReliefSurroundings.glsl"
#include "ReliefThickness.glsl"
}
}

#undef RELIEF_FN
#undef RELIEF_FIELD_FN
#undef RELIEF_FIELD
#undef RELIEF_OUT
#undef RELIEF_INOUT
#undef RELIEF_INFINITY
#undef RELIEF_EPSILON
#undef RELIEF_NAN
#undef RELIEF_USING
#undef RELIEF_BOOL
#undef RELIEF_SAME
#undef reliefReal
#undef reliefSelect
#undef reliefAnd
#undef reliefLess
#undef reliefAtMost
#undef reliefEqual
#undef reliefMissing
#undef reliefNegate
#undef reliefAdd
#undef reliefSubtract
#undef reliefMultiply
#undef reliefMultiplyAdd
#undef reliefDivide

#endif

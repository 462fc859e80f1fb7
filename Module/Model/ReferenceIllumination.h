// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceIllumination_h
#define ReferenceIllumination_h

#include "EffectPlan.h"

#include <cstdint>

namespace relief
{

/// The illumination of single samples by the reference: every light's ray in double precision,
/// through every cell, without a tolerance. It is the mean over the lights that a scene's layer
/// Illumination has. Slow; samples may be asked for on several threads at once.
class ReferenceIllumination
{
public:
  /// The field must outlive this object. Of the scene, lights and medium count; its integrator does
  /// not.
  ReferenceIllumination(const HeightField& field, const Scene& scene);

  /// The mean of a sample that has data. What was visited is added to `cells`.
  double At(int i, int j, std::uint64_t& cells) const;

  ///@{
  /// What the exact integrator promises of the mean: the error that the tolerance lets it make, and
  /// what rounding adds to that (Documentation/Numerics.md).
  double GetTolerance() const { return this->Tolerance; }
  double GetRounding() const { return this->Rounding; }
  ///@}

  /// The values that the mean has over heights within rounding of the field's: moved by up to
  /// MostUnits units in the last place of the relief, with rays that begin and turn by rounding.
  struct Span
  {
    double lo;
    double hi;
  };
  Span SpanAt(int i, int j) const;

  static constexpr double MostUnits = 64.0;

private:
  struct Source
  {
    Light light;
    double share;
    bool traced;
  };

  double Trace(const Light& light, int i, int j, std::uint64_t& cells) const;
  Span SpanOf(const Light& light, int i, int j) const;

  Field<float> Plain;
  f64::ReliefMedium Medium;
  std::vector<Source> Sources; // those that are lit
  double Scale = 0.0;          // of their sum, for the mean
  double Unit;                 // in the last place, of the relief
  double Tolerance = 0.0;
  double Rounding = 0.0;
};

}

#endif

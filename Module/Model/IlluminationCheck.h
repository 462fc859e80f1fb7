// SPDX-License-Identifier: BSD-3-Clause
#ifndef IlluminationCheck_h
#define IlluminationCheck_h

#include "ReferenceIllumination.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace relief
{

/// Different samples of a rectangle that have data, drawn by a seed, the same on every machine: so
/// many, or all there are. In the order in which they are drawn. Where few have data, `hasData` is
/// asked for all of them, one after another, twice.
std::vector<std::size_t> DrawSamples(std::size_t total, std::size_t wanted, std::uint64_t seed,
  const std::function<bool(std::size_t)>& hasData);

/// Whether illuminations that were computed keep what is promised: random samples are retraced by
/// the reference.
class IlluminationCheck
{
public:
  /// A sample that was retraced.
  struct Sample
  {
    int i = 0;
    int j = 0;
    double d = 0.0;         ///< as it was computed
    double reference = 0.0; ///< the exact one
    /// How far d is from the exact one or, if only that is no more than is promised, from those
    /// that heights within rounding of the field's have.
    double error = 0.0;
    bool grazing = false; ///< the latter: its ray grazes the surface, or the model jumps
  };

  /// A part of the field's samples and their illumination, row by row.
  struct Part
  {
    int i0 = 0;
    int j0 = 0;
    int columns = 0;
    int rows = 0;
    const float* illumination = nullptr;
  };

  /// Draws as many samples of the part that have data, or all there are. The field must outlive
  /// this object.
  IlluminationCheck(const HeightField& field, const Scene& scene, const Part& part,
    std::size_t samples, std::uint64_t seed);

  /// Takes samples that have data, of which i and j are known. Of SparseHeights' field, what
  /// TileRegions finds for a sample is to be filled when it is retraced, and its illumination
  /// known.
  IlluminationCheck(const HeightField& field, const Scene& scene, std::vector<Sample> samples);

  std::size_t GetNumberOfSamples() const { return this->Samples.size(); }

  /// The illumination of a sample as it was computed.
  void SetIllumination(std::size_t k, double d) { this->Samples[k].d = d; }

  /// Retraces a sample; different ones may be retraced at once.
  void Retrace(std::size_t k);

  ///@{
  /// Once all are retraced. Which sample has the largest error; null without samples.
  const std::vector<Sample>& GetSamples() const { return this->Samples; }
  const Sample* GetWorst() const;
  std::size_t CountGrazing() const;
  ///@}

  ///@{
  /// What is promised: no error is larger than the two together.
  double GetTolerance() const { return this->Reference.GetTolerance(); }
  double GetRounding() const { return this->Reference.GetRounding(); }
  bool IsKept() const;
  ///@}

private:
  ReferenceIllumination Reference;
  std::vector<Sample> Samples;
};

}

#endif

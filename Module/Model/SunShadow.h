// SPDX-License-Identifier: BSD-3-Clause
#ifndef SunShadow_h
#define SunShadow_h

#include "HeightField.h"
#include "HeightOutline.h"
#include "RayThickness.h"
#include "SweepThickness.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace relief
{

/// Which samples lie in the shadow of the relief, by its geometry alone: neither depth nor floor,
/// nor anything else of the material counts. A direction of the sun is hidden from a sample if its
/// ray from there meets the surface, which is d = 0 in the limit t = 0; a sun below the horizon is
/// hidden.
class SunShadow
{
public:
  /// The directions that a sun's disc is sampled by, with their weights; one where it has no width.
  /// The field must outlive this object. `taken` is what lists of crossings take already, in bytes
  /// (SweepThickness).
  SunShadow(const HeightField& field, const std::vector<Light>& disc, std::size_t taken = 0);

  /// Fills the share of the disc that is hidden, in [0, 1], for the samples of a tile of
  /// SweepThickness, row by row; samples outside the image or without data get any number.
  void ShadeTile(int column, int row, float* hidden, RayCount& count) const;

  /// The same where some heights are known by their bounds only. Returns whether the shadow is
  /// known all the same.
  bool ShadeTile(
    const HeightOutline& outline, int column, int row, float* hidden, RayCount& count) const;

private:
  struct Direction
  {
    Light light;
    double share; ///< of the disc
    bool up;      ///< it may be seen at all
    std::unique_ptr<SweepThickness> sweep;
  };

  void Illuminate(const Direction& direction, int column, int row, float* d, RayCount& count) const;
  RowRequest<float> RowOf(int column, int j) const;

  Field<float> Heights;
  f32::ReliefMedium Medium;
  std::vector<Direction> Directions;
};

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SweepThickness_h
#define SweepThickness_h

#include "Crossings.h"
#include "HeightField.h"
#include "RayThickness.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace relief
{

/// Thickness for a directional light, many samples in lockstep.
///
/// All rays are parallel, so every sample's ray crosses the grid lines at the same offsets from its
/// own sample. A crossing's height is then the same two neighbours with the same weight for every
/// sample: loads of unit stride, whole vectors at a time, and inside a cell the same quadratic as
/// in reliefTrace(), of which only the vectors that cross zero pay for a square root. Crossings are
/// walked in groups, and groups that the bounds show to lie above or below all rays of a tile are
/// skipped.
///
/// Tiles are anchored to the field's first sample and always computed whole, so results do not
/// depend on who computes which part. The loops are compiled for several instruction sets and
/// chosen at run time.
class SweepThickness
{
public:
  // As wide as the widest vectors, and square: the closer a tile's samples are, the less their
  // heights differ, and the sooner the bounds can tell.
  static constexpr int TileWidth = 16;
  static constexpr int TileHeight = 16;
  static constexpr int TileSize = TileWidth * TileHeight;

  /// Whether a light and medium are of the kind that is swept: a directional light at or above the
  /// horizon, points sunk straight down.
  static bool Applies(const f64::ReliefMedium& medium, const Light& light);

  /// Whether squares of heights are no numbers in single precision, so that rays are traced one by
  /// one, which minds that; for the greatest less the least height, and t.
  static bool IsExtreme(double relief) { return relief > 1e15 || relief < 1e-15; }

  /// Lists the crossings. The field must be padded, and outlive this object.
  SweepThickness(const HeightField& field, const f64::ReliefMedium& medium, const Light& light);

  /// What the lists of crossings of several lights may take, in bytes, and one more list.
  static constexpr std::size_t MostMemory = std::size_t{ 256 } << 20;

  /// One for a light that is swept over this field, as long as fewer than MostMemory bytes are
  /// taken, to which its own are added; else null. A list is as long as the image; packets, which
  /// trace what no more room is for, need none.
  static std::unique_ptr<SweepThickness> MakeWhereItApplies(const HeightField& field,
    const f64::ReliefMedium& medium, const Light& light, std::size_t& taken);

  /// Fills d (and r, where given) for the TileWidth x TileHeight samples from
  /// (column * TileWidth, row * TileHeight) on; samples outside the image or without data get any
  /// number.
  void IlluminateTile(int column, int row, float* d, float* r, RayCount& count) const;

  /// Bytes that the crossings take.
  std::size_t GetMemorySize() const
  {
    return sizeof(*this) + this->Prepared.crossings.GetMemorySize() +
      this->Prepared.steps.capacity() * sizeof(Step);
  }

  /// The instruction set in use, for reports.
  static const char* GetTargetName();

  // A cell of the crossings as the walk takes it that minds neither border nor holes.
  struct Step
  {
    // Places in the heights, from the ray's own sample on: of the samples between which the ray
    // leaves the cell, and of the cell's first.
    std::ptrdiff_t first, second, cell;
    float weight, distance, length, rise, bend; // as the cell has them
    float margin;                               // within which a ray is on the surface at the exit
  };

  // What the loops read.
  struct Plan
  {
    const HeightField* field;
    f32::ReliefMedium medium;
    float dx; // samples per unit of length
    float dy;
    float dz;
    Crossings crossings;
    std::vector<Step> steps; // the rays' start, then each of the cells
  };

private:
  Light Source;
  bool Extreme;
  Plan Prepared;
};

}

#endif

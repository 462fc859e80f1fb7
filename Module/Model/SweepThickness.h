// SPDX-License-Identifier: BSD-3-Clause
#ifndef SweepThickness_h
#define SweepThickness_h

#include "HeightField.h"
#include "RayThickness.h"

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
  /// horizon, points sunk vertically, no floor.
  static bool Applies(const f64::ReliefMedium& medium, const Light& light);

  /// Whether squares of heights are no numbers in single precision, so that rays are traced one by
  /// one, which minds that; for the greatest less the least height, and t.
  static bool IsExtreme(double relief) { return relief > 1e15 || relief < 1e-15; }

  /// Lists the crossings. The field must be padded, and outlive this object.
  SweepThickness(const HeightField& field, const f64::ReliefMedium& medium, const Light& light);

  /// Fills d (and r, where given) for the TileWidth x TileHeight samples from
  /// (column * TileWidth, row * TileHeight) on; samples outside the image or without data get any
  /// number.
  void IlluminateTile(int column, int row, float* d, float* r, RayCount& count) const;

  /// Bytes that the crossings take.
  std::size_t GetMemorySize() const
  {
    return sizeof(*this) + this->Prepared.cells.capacity() * sizeof(Cell) +
      (this->Prepared.groups.capacity() + this->Prepared.spans.capacity()) * sizeof(Group);
  }

  /// The instruction set in use, for reports.
  static const char* GetTargetName();

  // One cell that every ray runs through, by its offset from the ray's sample, and the two samples
  // between which the ray leaves it.
  struct Cell
  {
    int x;
    int y;
    int firstX, firstY;
    int secondX, secondY;
    float weight; // of the second sample at the exit
    float length; // of the ray in the cell
    float rise;   // of the ray at the exit above its sample
    bool touches; // only a corner, and so does not end a hole
    float bend;   // what the patch's twist is multiplied by to give the quadratic's curvature
  };

  // Consecutive cells that are skipped or walked together.
  struct Group
  {
    int begin;
    int end;
    int x0, x1, y0, y1; // offsets that its cells span
    float riseIn;       // of the ray above its sample where it enters the first cell
    float riseOut;      // and where it leaves the last
    float length;
    float distance; // of the entry along the ray
  };

  // What the loops read.
  struct Plan
  {
    const HeightField* field;
    f32::ReliefMedium medium;
    std::vector<Cell> cells;
    std::vector<Group> groups;
    std::vector<Group> spans; // of SpanSize groups each
    float dz;
  };
  static constexpr int GroupSize = 4;
  static constexpr int SpanSize = 4;

private:
  void FixLastLine(int column, int row, float* d, float* r, RayCount& count) const;

  Plan Prepared;
  Light Source;
  bool Extreme;
  bool AlongX;
  bool AlongY;
};

}

#endif

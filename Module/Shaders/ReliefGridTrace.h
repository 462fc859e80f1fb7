// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefGridTrace_h
#define ReliefGridTrace_h

#include "EffectPlan.h"
#include "HeightField.h"
#include "ReliefGrid.h"
#include "Scene.h"
#include "SweepThickness.h"

#include <memory>
#include <string>
#include <vector>

namespace relief
{

/// What the program for tracing draws, found on the processor: the illumination d of one light, or
/// what stands in its place, a number for each texel of a grid. The filter's engines do it, which
/// are far faster than the program where the processor would run that, too.
///
/// Suns are swept, tile by tile, while the grid takes enough of a tile's samples; other lights of a
/// grid that takes all samples are traced by tiles as well. What else there is is traced by packets
/// of the grid's own samples. Tiles are anchored to the field and packets to the grid's origin, and
/// both are computed whole: d of a sample depends on the grid's strides, but not on where the grid
/// begins, on bands or on threads, and at stride 1 it is the filter's own.
class GridTrace
{
public:
  /// All but the light and the grid must outlive this object.
  GridTrace(
    const HeightField& field, const Scene& scene, const LightPlan& light, const ReliefGrid& grid);

  /// Fills d for the rows [begin, end) of the grid, row by row; 0 where there are no data.
  void Trace(int begin, int end, float* d, const ParallelFor& parallelFor, RayCount& count) const;

  /// The first of the grid's rows, from `row` on, at which a band may end so that the next one
  /// traces nothing that it has traced.
  static int EndOfBand(const HeightField& field, const ReliefGrid& grid, int row);

  /// How much work a grid is, about, in samples that are swept.
  static double EstimateWork(
    const HeightField& field, const Scene& scene, const LightPlan& light, const ReliefGrid& grid);

private:
  void TraceTile(int tileColumn, int tileRow, float* d, RayCount& count) const;
  void TraceTiles(int first, int last, float* d, RayCount& count) const;
  void TraceRow(int row, float* d, RayCount& count) const;
  void AnswerRow(int row, float* d) const;
  void FindNormals(RowRequest<float>& request, glm::vec3* normals) const;

  const HeightField& Heights;
  const Scene& Parameters;
  LightPlan Source;
  ReliefGrid Grid;
  f64::ReliefMedium Medium; // with the light's own tolerance
  bool ByTiles;
  std::unique_ptr<SweepThickness> Swept; // where that is the cheapest way
  std::vector<int> Columns;              // of samples, one for each of the texels from First on
  int First = 0;                         // texels in front of the grid's, whose packet they share
};

/// Whether OpenGL is drawn by the processor, by the name that a renderer has (GL_RENDERER).
bool IsSoftwareRenderer(const std::string& renderer);

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureExposure_h
#define PictureExposure_h

/// @file
/// The exposure at which a scene is shown. Not installed.

#include "HeightOutline.h"
#include "HeightSupply.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <cstdint>
#include <functional>
#include <vector>

class vtkReliefScene;

namespace relief
{
class HeightField;
struct Scene;
}

namespace relief::hosts
{
struct PictureExposure
{
  double stops = 0.0;
  /// What was traced to find it.
  std::uint64_t rays = 0;
  std::uint64_t cells = 0;
  /// By how much what was looked at may be wrong beside the tolerance.
  OutlineError error;
};

/// Fills a field of tiled heights where some windows depend on it (TiledHeights::Provide). Returns
/// what is known of the heights that it has left out, null where it has left out none.
using WindowProvider =
  std::function<const HeightOutline*(const std::vector<HeightSupply::Window>&)>;

/// The scene's exposure, or, where it is automatic, the one that suits the picture (on all
/// threads). `converted` is what the scene has become. A field that is not in memory as a whole
/// needs a provider, which is called for some tiles at a time, or, `sparing`, one after another.
VTKRELIEFSHADING_EXPORT PictureExposure FindExposure(vtkReliefScene* scene,
  const HeightField& field, const Scene& converted,
  const WindowProvider& provide = WindowProvider(), bool sparing = false);
}

#endif

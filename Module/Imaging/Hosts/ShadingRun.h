// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShadingRun_h
#define ShadingRun_h

/// @file
/// How a filter's output is shaded once its inputs are prepared. Not installed.

#include "HeightSupply.h"
#include "HostInputs.h"
#include "IlluminationCache.h"
#include "PictureExposure.h"
#include "PreparedScene.h"
#include "SceneShading.h"
#include "TiledHeights.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkReliefStatistics;

namespace relief::hosts
{
/// Shades what inputs and a scene have become. Of heights in memory illuminations are kept between
/// runs. Of heights that are read as they are needed those come that the target depends on, and
/// what is planned holds for all parts of the picture.
class VTKRELIEFSHADING_EXPORT ShadingRun
{
public:
  /// Progress is told in the host's name, which may be aborted. All of them must outlive this
  /// object.
  ShadingRun(vtkAlgorithm* host, HostInputs& inputs, const PreparedScene& scene);
  ~ShadingRun();

  /// What heights that are read as they are needed may take, of all that follows.
  void SetLimit(const TiledHeights::Limit& limit);

  /// Decides what can be decided once. Returns an empty text, or what is wrong. Throws a
  /// std::bad_alloc.
  std::string Plan(const Target& target, std::size_t cacheBytes);

  /// The effects of what is planned, as bits of Effect.
  int GetEffects() const { return this->Current->GetEffects(); }

  /// Shades all of the target. Returns false where the host has been aborted.
  bool Shade();

  /// Keeps the illuminations, and tells what has been done. Returns an empty text, or what is wrong
  /// with it: heights that were left out may matter more than the scene's tolerance allows.
  std::string Finish(vtkReliefStatistics* statistics);

  /// What an update of an extent of the picture, from its first sample on, would take.
  TiledHeights::Needs Estimate(const HeightSupply::Window& window);

  /// Frees what is kept between runs.
  void Release();

private:
  void FindExposure();
  WindowProvider GetProvider();
  std::unique_ptr<SceneShading> MakeShading(IlluminationCache* cache);
  void PlanTile();
  double FindToleranceTaken() const;

  vtkAlgorithm* Host;
  HostInputs& Inputs;
  const PreparedScene& Scene;
  TiledHeights::Limit Limit;
  Target Out;
  SceneShading* Current = nullptr; // one of the two below
  std::unique_ptr<SceneShading> Whole;

  // All tiles of a picture are shaded by one object, whose counts go on from tile to tile.
  struct TileShading
  {
    std::unique_ptr<SceneShading> shading;
    std::uint64_t scene = 0;
    std::uint64_t field = 0;
    std::vector<bool> layers;
    std::uint64_t rays = 0;
    std::uint64_t cells = 0;
  } Tiles;

  PictureExposure Exposure; // of the run at hand
  // What it was found from: parts of a picture are of one exposure, which is found once.
  std::uint64_t ExposedScene = 0;
  std::uint64_t ExposedField = 0;
  IlluminationCache Cache;
};
}

#endif

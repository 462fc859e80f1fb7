// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneShading_h
#define SceneShading_h

#include "EffectPlan.h"
#include "HeightField.h"
#include "HeightOutline.h"
#include "IlluminationCache.h"
#include "PictureWriter.h"
#include "SceneLanes.h"
#include "SunShadow.h"
#include "SweepThickness.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace relief
{

/// Shades one scene over one field with the effects that the scene calls for. What can be decided
/// once is decided in the constructor; Shade() may then run on disjoint parts at once.
///
/// Of the field's heights and bounds nothing is kept but its range, size and addresses. So between
/// two calls of Shade(), regions of a field of SparseHeights may be forgotten and others filled,
/// and one object shades all tiles of a raster: what a light's plan takes is paid once.
class SceneShading
{
public:
  /// A cache, where given, must outlive this object.
  SceneShading(const HeightField& field, const Scene& scene, const Target& target,
    IlluminationCache* cache = nullptr);

  /// Whether lights of a scene may be swept in lockstep, over a field of so many columns, for which
  /// HeightField::Assign() must pad it. Lights themselves do not count: they come and go, and the
  /// field stays.
  static bool WantsPadding(const Scene& scene, int columns);

  /// Takes another target with the same layers, as tile after tile of a picture wants. Nothing that
  /// was decided depends on where the target lies; a cache's keys do, so there must be none.
  void Redirect(const Target& target);

  /// Shades what comes by an outline, where a tile depends on heights that are left out. Null, as
  /// at first: none are. There must be no cache. What it may be wrong by begins anew.
  void SetOutline(const HeightOutline* outline);

  /// By how much what has been shaded since then may be wrong beside the tolerance.
  const OutlineError& GetOutlineError() const { return this->Error; }

  /// Shades the samples [i0, i1) x [j0, j1) of the field. Parts that begin and end at multiples of
  /// the tile of SweepThickness cost least: tiles are computed whole.
  void Shade(int i0, int i1, int j0, int j1);

  /// The largest component of the colours of a tile's samples, row by row; NaN where there are no
  /// data or no sample. Writes nothing to the target.
  void FindLargest(int column, int row, float* largest);

  /// Keeps the illuminations for the next run. To be called once all samples of the target are
  /// shaded.
  void KeepIlluminations();

  ///@{
  /// What has been done so far.
  int GetLightsTraced() const;
  std::uint64_t GetRaysTraced() const;
  std::uint64_t GetCellsVisited() const { return this->Cells; }
  int GetLightsReused() const;
  int GetEffects() const { return this->Effects; }
  int GetNumberOfLights() const { return static_cast<int>(this->Plans.size()); }
  ///@}

private:
  // A light, and how it is traced here.
  struct Plan : LightPlan
  {
    f64::ReliefMedium medium;                        ///< with the light's own tolerance
    f32::ReliefMedium single;                        ///< the same in single precision
    LightTerms terms;                                ///< and what it gives
    bool thickness;                                  ///< its thickness is a layer
    std::unique_ptr<SweepThickness> sweep;           ///< traces it in lockstep, where that applies
    std::shared_ptr<IlluminationCache::Entry> kept;  ///< d from an earlier run
    std::shared_ptr<IlluminationCache::Entry> fresh; ///< d for the next
  };

  bool NeedsEveryD(const Plan& plan) const;
  void UseCache(Plan& plan, std::size_t& cached);
  void MakeRoom();
  void ShadeTile(SceneTile& tile);
  void Illuminate(const Plan& plan, std::size_t index, SceneTile& tile);
  RowRequest<float> RowOf(const Plan& plan, int j, SceneTile& tile) const;
  void IlluminateByOutline(const Plan& plan, SceneTile& tile, RayCount& work);
  void AddError(const OutlineError& error);
  static bool TakesAll(const Plan& plan, const SceneTile& tile);
  LightTerms TermsOf(const Plan& plan) const;
  PictureParts MakeParts(const EffectPlan& effects) const;
  void AddLight(const Plan& plan, std::size_t index, SceneTile& tile);
  bool FindWanted(const Plan& plan, bool hasScatter, SceneTile& tile) const;
  void ApplyTextures(SceneTile& tile) const;

  Field<float> Heights;
  std::uint64_t FieldVersion;
  IlluminationCache* Cache;
  Scene Parameters;
  Target Out;
  PictureParts Parts;
  std::unique_ptr<PictureWriter> Writer;
  f32::ReliefMedium Medium;
  f32::ReliefFalloff SpecularFalloff;
  f32::ReliefFalloff ScatterFalloff;
  std::vector<Plan> Plans;
  std::unique_ptr<SunShadow> Shadow;
  const HeightOutline* Outline = nullptr;
  OutlineError Error;
  std::mutex ErrorMutex;
  std::unique_ptr<std::atomic<std::uint64_t>[]> Rays; // per light
  std::atomic<std::uint64_t> ShadowRays{ 0 };
  std::atomic<std::uint64_t> Cells{ 0 };
  bool Rounds = false; // sums are double, of several lights or for textures
  bool HasNormals = false;
  bool NeedsRing = false; // of neighbours
  int Effects = 0;
};

}

#endif

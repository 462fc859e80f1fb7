// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneShading_h
#define SceneShading_h

#include "EffectPlan.h"
#include "HeightField.h"
#include "IlluminationCache.h"
#include "SweepThickness.h"

#include <atomic>
#include <memory>
#include <vector>

namespace relief
{

enum Effect
{
  IlluminationEffect = 1,
  NormalsEffect = 2,
  SpecularEffect = 4,
  ScatterEffect = 8,
  BaseTextureEffect = 16,
  DiffuseTextureEffect = 32,
  SpecularTextureEffect = 64
};

/// Where results go: arrays over a rectangle of samples, row by row. Any may be null, and null
/// layers cost nothing.
struct Target
{
  int i0 = 0; ///< the sample that stands first in the arrays
  int j0 = 0;
  int width = 0; ///< samples in a row of the arrays
  int rows = 0;  ///< rows in the arrays
  float* rgba = nullptr;
  unsigned char* rgba8 = nullptr;
  float* illumination = nullptr;
  float* thickness = nullptr;
  float* normals = nullptr; ///< 3 components, as those below
  float* base = nullptr;
  float* diffuse = nullptr;
  float* scatter = nullptr;
  float* specular = nullptr;
};

struct SceneTile;

/// Shades one scene over one field with the effects that the scene calls for. What can be decided
/// once is decided in the constructor; Shade() may then run on disjoint parts at once.
class SceneShading
{
public:
  /// A cache, where given, must outlive this object.
  SceneShading(const HeightField& field, const Scene& scene, const Target& target,
    IlluminationCache* cache = nullptr);

  /// Shades the samples [i0, i1) x [j0, j1) of the field. Parts that begin and end at multiples of
  /// the tile of SweepThickness cost least: tiles are computed whole.
  void Shade(int i0, int i1, int j0, int j1);

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
  ///@}

  /// What the lists of crossings may take, in bytes, and one more list (SweepThickness).
  static constexpr std::size_t MostSweepMemory = std::size_t{ 256 } << 20;

private:
  // A light, and how it is traced here.
  struct Plan : LightPlan
  {
    f64::ReliefMedium medium;              ///< with the light's own tolerance
    f32::ReliefMedium single;              ///< the same in single precision
    float scatterFactor;                   ///< of a directional light
    float share;                           ///< weight and intensity, for the mean illumination
    bool thickness;                        ///< its thickness is a layer
    std::unique_ptr<SweepThickness> sweep; ///< traces it in lockstep, where that applies
    std::shared_ptr<const IlluminationCache::Entry> kept; ///< d from an earlier run
    std::shared_ptr<IlluminationCache::Entry> fresh;      ///< d for the next
  };

  bool NeedsEveryD(const Plan& plan) const;
  void UseCache(Plan& plan, std::size_t& cached);
  void ShadeTile(SceneTile& tile);
  void Illuminate(const Plan& plan, std::size_t index, SceneTile& tile);
  void AddLight(const Plan& plan, std::size_t index, SceneTile& tile);
  void ApplyTextures(SceneTile& tile);
  void Write(const SceneTile& tile);

  Field<float> Heights;
  std::uint64_t FieldVersion;
  IlluminationCache* Cache;
  Scene Parameters;
  Target Out;
  f32::ReliefMedium Medium;
  f32::ReliefFalloff SpecularFalloff;
  f32::ReliefFalloff ScatterFalloff;
  std::vector<Plan> Plans;
  std::unique_ptr<std::atomic<std::uint64_t>[]> Rays; // per light
  std::atomic<std::uint64_t> Cells{ 0 };
  double ShareSum = 0.0;
  bool HasScatter = false;
  bool HasNormals = false;
  int Effects = 0;
};

}

#endif

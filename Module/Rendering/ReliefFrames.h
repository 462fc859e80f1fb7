// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefFrames_h
#define ReliefFrames_h

#include "IlluminationKey.h"
#include "PreparedScene.h"
#include "ReliefPasses.h"

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

/// What one renderer sees of a field, shaded: what has been found out is kept, so that each frame
/// does what has changed only, and no more than it has time for.
///
/// Lights come in two classes. The first few are shown from the first frame on, coarse if there is
/// no time for more. The rest, as an environment has them, are added one by one to sums of their
/// own, the strongest first; while some are missing, the sums are scaled to the brightness of all.
/// As far as memory goes, the illumination of each light is kept in a texture, so that only what
/// moves is traced again.
class ReliefFrames
{
public:
  struct Request
  {
    relief::VisiblePart part;
    int viewportSize[2] = { 0, 0 };
    int maximumTextureSize = 0;
    std::uint64_t textures = 0; ///< changes with the scene's textures
    double memory = 0.0;        ///< for illuminations that are kept, in bytes
    double seconds = 0.0;       ///< for this frame; infinite for a complete one
    bool moving = false;      ///< whether another picture is wanted next, rather than a better one
    bool onProcessor = false; ///< whether rays are traced by the processor
  };

  struct Work
  {
    int lightsTraced = 0;
    int lightsReused = 0;
    std::int64_t rays = 0;
    std::int64_t cells = 0; ///< that the processor's rays visited
  };

  /// Shades as much as there is time for. Returns whether it could; what could not is the passes'
  /// problem.
  bool Update(vtkOpenGLRenderWindow* window, ReliefPasses& passes, const relief::HeightField& field,
    const relief::hosts::PreparedScene& scene, const Request& request);

  /// Linear colours of a grid's texels.
  const ReliefLayer& GetColors() const { return this->Colors; }

  /// Whether they are all that the scene asks for.
  bool IsConverged() const { return this->Converged; }

  /// How much of the work has been done, from 0 to 1.
  double GetProgress() const { return this->Progress; }

  const Work& GetWork() const { return this->Done; }
  /// The effects that the scene calls for, as bits of relief::Effect.
  int GetEffects() const { return this->Effects; }

private:
  using Key = relief::IlluminationKey;

  // The illumination of a light.
  struct Entry
  {
    ReliefLayer complete;
    std::uint64_t stamp = 0; // changes with the layer
    ReliefLayer pending;
    int rows = 0; // of the pending layer, done
    bool used = false;
  };

  struct LightInUse
  {
    const relief::LightPlan* plan;
    Key key;
    Entry* entry; // null where none is kept or needed
  };

  // The sums over the rest of the lights.
  struct Later
  {
    std::vector<Key> keys;
    std::vector<glm::dvec3> radiances; // as they were added
    std::vector<std::size_t> order;    // in which they are, as indices
    relief::f64::ReliefFalloff falloffs[2] = {};
    ReliefSumLayers sums;
    std::size_t added = 0;
    std::uint64_t stamp = 0;
  };

  // What the sums over the first lights were made from.
  struct GatheredLight
  {
    std::uint64_t stamp = 0; // of its illumination, 0 where none is needed
    bool directional = false;
    glm::dvec3 vector = glm::dvec3(0.0);
    glm::vec3 radiance = glm::vec3(0.0);
    bool operator==(const GatheredLight& other) const;
  };
  struct Gathered
  {
    relief::ReliefGrid grid;
    relief::SumFeatures sums;
    relief::f64::ReliefFalloff specular = {};
    relief::f64::ReliefFalloff scatter = {};
    std::vector<GatheredLight> lights;
    // Directions toward lamps depend on these, so they are left alone where there are no lights.
    double depth = 0.0;
    int offset = 0;
    std::uint64_t field = 0;
    bool operator==(const Gathered& other) const;
  };

  // What the colours were made from.
  struct Composed
  {
    Gathered first;
    relief::ReliefGrid grid;
    std::uint64_t laterStamp = 0;
    glm::dvec3 laterScale = glm::dvec3(1.0);
    glm::dvec3 base = glm::dvec3(0.0);
    glm::dvec3 diffuse = glm::dvec3(0.0);
    glm::dvec3 specular = glm::dvec3(0.0);
    double specularCoefficient = 0.0;
    double scatterCoefficient = 0.0;
    std::uint64_t field = 0;
    std::uint64_t textures = 0;
    bool operator==(const Composed& other) const;
  };

  void Plan(const relief::HeightField& field, const relief::hosts::PreparedScene& scene);
  void Classify(const relief::HeightField& field);
  static bool Same(const relief::f64::ReliefFalloff& a, const relief::f64::ReliefFalloff& b);
  Gathered DescribeFirst() const;
  Composed DescribeColors() const;
  Entry* FindEntry(const Key& key);
  relief::ReliefGrid AffordableGrid(const std::vector<LightInUse>& lights, double seconds) const;
  bool UpdateFirst();
  bool GatherFirst();
  bool UpdateLater();
  bool IsLaterValid(glm::dvec3& scale) const;
  bool RestartLater();
  const ReliefLayer* LightLater(const LightInUse& light, ReliefLayer& scratch);
  double GetLaterShare() const;
  bool ComposeColors();
  void JudgeProgress();
  void Forget();
  bool TraceRows(
    const relief::LightPlan& light, const ReliefLayer& layer, int& row, double seconds);
  double GetElapsed() const;
  double Estimate(const relief::LightPlan& light, const relief::ReliefGrid& grid) const;

  // Of the frame at hand.
  vtkOpenGLRenderWindow* Window = nullptr;
  ReliefPasses* Passes = nullptr;
  Request Asked;
  int Samples[2] = { 0, 0 };
  const relief::Scene* Parameters = nullptr;
  std::vector<LightInUse> First;
  std::vector<LightInUse> Rest;
  relief::ReliefGrid Full;  // all that can be seen
  relief::ReliefGrid Shown; // what is shown of it
  glm::dvec3 LaterScale = glm::dvec3(1.0);
  double Begin = 0.0;
  Work Done;
  std::set<const relief::LightPlan*> Traced;

  // Kept from frame to frame.
  relief::EffectPlan Planned;
  std::pair<std::uint64_t, std::uint64_t> PlannedFrom; // versions of field and scene
  int Effects = 0;
  relief::SumFeatures Sums;
  // Lights may be alike, and each has its own.
  std::unordered_multimap<Key, Entry, relief::IlluminationHash> Entries;
  ReliefSumLayers FirstSums;
  std::optional<Gathered> GatheredFrom;
  Later LaterSums;
  std::array<ReliefLayer, relief::MostGathered> Scratch;
  ReliefColorLayers Textures;
  ReliefLayer Colors;
  std::optional<Composed> ComposedFrom;
  bool OnProcessor = false;
  double SecondsPerWork = 0.0; // as the passes estimate it
  std::uint64_t Stamp = 0;
  bool Converged = false;
  double Progress = 0.0;
};

#endif

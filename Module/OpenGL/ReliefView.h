// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefView_h
#define ReliefView_h

#include "IlluminationCache.h"
#include "ReliefPasses.h"

#include <cstdint>
#include <list>
#include <set>
#include <string>
#include <vector>

/// What one renderer sees of a field, shaded: what has been found out is kept, so that each frame
/// does what has changed only, and no more than it has time for.
///
/// Lights come in two classes. The first few are shown from the first frame on, coarse if there is
/// no time for more. The rest, as an environment has them, are added one by one to sums of their
/// own, the strongest first; while some are missing, the sums are scaled to the brightness of all.
/// As far as memory goes, the illumination of each light is kept in a texture, so that only what
/// moves is traced again.
class ReliefView
{
public:
  struct Request
  {
    relief::VisiblePart part;
    int viewportSize[2] = { 0, 0 };
    int maximumTextureSize = 0;
    vtkMTimeType textures = 0; ///< changes with the scene's textures
    double memory = 0.0;       ///< for illuminations that are kept, in bytes
    double seconds = 0.0;      ///< for this frame; infinite for a complete one
    bool moving = false;       ///< whether another picture is wanted next, rather than a better one
  };

  struct Work
  {
    int lightsTraced = 0;
    int lightsReused = 0;
    std::int64_t rays = 0;
  };

  /// Shades as much as there is time for. Returns whether it could; what could not is the passes'
  /// problem.
  bool Update(vtkOpenGLRenderWindow* window, ReliefPasses& passes, const relief::HeightField& field,
    const relief::Scene& scene, const Request& request);

  /// Linear colours of a grid's texels.
  const ReliefLayer& GetColors() const { return this->Colors; }

  /// Whether they are all that the scene asks for.
  bool IsConverged() const { return this->Converged; }

  /// How much of the work has been done, from 0 to 1.
  double GetProgress() const { return this->Progress; }

  const Work& GetWork() const { return this->Done; }
  const relief::EffectPlan& GetPlan() const { return this->Plan; }

private:
  using Key = relief::IlluminationCache::Key;

  // The illumination of a light.
  struct Entry
  {
    Key key;
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

  void Classify(const relief::HeightField& field, const relief::Scene& scene);
  Entry* FindEntry(const Key& key);
  relief::ReliefGrid AffordableGrid(std::size_t lights, double seconds) const;
  bool UpdateFirst();
  bool GatherFirst();
  bool UpdateLater();
  bool IsLaterValid(glm::dvec3& scale) const;
  bool RestartLater();
  bool AddLater(const LightInUse& light, const glm::dvec3& radiance);
  double GetLaterShare() const;
  bool ComposeColors();
  void JudgeProgress();
  bool TraceRows(
    const relief::LightPlan& light, const ReliefLayer& layer, int& row, double seconds);
  double GetElapsed() const;
  double Estimate(double texels) const { return texels * this->SecondsPerTexel; }

  // Of the frame at hand.
  vtkOpenGLRenderWindow* Window = nullptr;
  ReliefPasses* Passes = nullptr;
  Request Asked;
  int Samples[2] = { 0, 0 };
  relief::EffectPlan Plan;
  relief::Scene Parameters;
  relief::SumFeatures Sums;
  std::vector<LightInUse> First;
  std::vector<LightInUse> Rest;
  relief::ReliefGrid Full;  // all that can be seen
  relief::ReliefGrid Shown; // what is shown of it
  glm::dvec3 LaterScale = glm::dvec3(1.0);
  double Begin = 0.0;
  Work Done;
  std::set<const relief::LightPlan*> Traced;

  // Kept from frame to frame.
  std::list<Entry> Entries;
  ReliefSumLayers FirstSums;
  std::vector<double> GatheredFrom;
  Later LaterSums;
  ReliefLayer Scratch;
  ReliefColorLayers Textures;
  ReliefLayer Colors;
  std::vector<double> ComposedFrom;
  double SecondsPerTexel = 0.0;
  std::uint64_t Stamp = 0;
  bool Converged = false;
  double Progress = 0.0;
};

#endif

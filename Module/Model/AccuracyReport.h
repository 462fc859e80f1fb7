// SPDX-License-Identifier: BSD-3-Clause
#ifndef AccuracyReport_h
#define AccuracyReport_h

#include "HeightField.h"
#include "Scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace relief
{

/// An integrator at one setting, on the field and the scene of a report.
struct AccuracyPoint
{
  Integrator integrator = Integrator::Exact;
  double tolerance = 0.0;   ///< of the exact integrator
  int steps = 0;            ///< fixed ones, else 0
  bool present = false;     ///< the scene's own setting
  double nanoseconds = 0.0; ///< a sample with data: processor time of one thread, all lights
  double seconds = 0.0;     ///< the same for the whole picture
  std::size_t timed = 0;    ///< samples that were shaded to measure it
  std::size_t compared = 0; ///< samples of which the errors are
  double most = 0.0;        ///< largest error of the mean illumination
  double mostOf999 = 0.0;   ///< 99.9 % of the samples keep it
  double rms = 0.0;         ///< root of the mean square
};

/// What accuracy costs on a field and a scene: error and time of tolerances and of the thesis's
/// fixed steps.
///
/// Time is what shading takes to 8-bit colours, with the illumination, on the thread that calls:
/// the least of several runs, which the settings take in turn, over tiles that are spread over the
/// whole field. Errors are those of samples of these tiles, drawn by a seed, against the reference
/// of the light as the scene has it.
class AccuracyReport
{
public:
  /// Both must outlive this object.
  AccuracyReport(const HeightField& field, const Scene& scene, std::uint64_t seed);

  /// Told how much is done, 0 to 1; returns whether to go on.
  using Progress = std::function<bool(double)>;

  /// Measures all. `parallelFor` runs the reference, which is not timed. Returns whether it came to
  /// its end; without data there is nothing to measure.
  bool Measure(const ParallelFor& parallelFor, const Progress& progress);

  /// In the order of tolerances, then of steps. Steps that would take too long are left out.
  const std::vector<AccuracyPoint>& GetPoints() const { return this->Points; }

  /// The place of the setting to take: the quickest exact one of which 99.9 % of the samples keep
  /// GetVisibleError(), and of those that are as quick, within a tenth, the most exact.
  std::size_t GetRecommended() const;

  /// The error of d that makes a step of an 8-bit picture in its darkest tones, where the scene's
  /// lights and exposure show level ground.
  double GetVisibleError() const;

  /// Samples that have data.
  std::uint64_t GetNumberOfSamples() const { return this->NumberOfSamples; }
  /// Of these, those whose exact illumination was found.
  std::size_t GetNumberOfProbes() const { return this->Probes.size(); }

private:
  // A sample and its exact illumination.
  struct Probe
  {
    std::size_t tile;
    int i;
    int j;
    double exact;
  };

  void FindTiles(std::uint64_t seed);
  void DrawProbes(std::uint64_t seed);
  void ListPoints();
  bool TraceProbes(const ParallelFor& parallelFor, const Progress& progress);
  bool Run(std::size_t index, std::vector<float>& illumination, double& seconds,
    const std::function<bool()>& goOn) const;
  void Compare(const std::vector<float>& illumination, AccuracyPoint& point) const;

  const HeightField& Heights;
  const Scene& Shown;
  std::vector<std::pair<int, int>> Tiles; // column and row, in the order in which they are run
  std::vector<std::size_t> Counts;        // of samples with data in them
  std::vector<Probe> Probes;
  std::vector<AccuracyPoint> Points;
  std::vector<std::size_t> TilesOf; // how many tiles each point is measured on
  std::uint64_t NumberOfSamples = 0;
};

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef SunTimes_h
#define SunTimes_h

#include "SunAt.h"

#include "vtkLight.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class vtkReliefScene;

namespace relief::raster
{
struct RasterHeader;
}

namespace reliefshade
{

class OptionParser;
struct Options;

/// A sun of a time. Where it stands is known when the heights are read: it is turned with their
/// map, and its place may be theirs.
struct TimedSun
{
  vtkSmartPointer<vtkLight> Light;
  relief::ClockTime Time;
  /// Longitude and latitude in degrees, unless they are those of the heights.
  std::optional<std::array<double, 2>> Place;
};

/// Pictures of several times, each Step milliseconds after the last.
struct FrameTimes
{
  TimedSun Sun; ///< at the first
  std::int64_t Step = 0;
  int Count = 0;

  relief::ClockTime TimeOf(int frame) const;
};

/// What the options say of suns and times.
struct SunTimes
{
  std::vector<TimedSun> Suns;
  std::optional<FrameTimes> Frames;
  /// Metres above the sea of the air that bends sunlight; empty for no air.
  std::optional<double> Elevation = 0.0;
};

/// Adds --sun-at, --frames and --refraction; `prepare` is called before a light is added.
void addSunTimes(OptionParser& parser, Options& options, void (*prepare)(Options&));

/// The suns of times over heights.
class SunClock
{
public:
  /// Finds where the heights lie, if that is needed. Throws a Failure where it cannot be told.
  SunClock(const Options& options, const relief::raster::RasterHeader& raster);

  /// Puts the suns in their places; that of the frames as it is at one of them.
  void Place(int frame) const;

  /// What there is to say about suns below the horizon; empty if there are none.
  std::string TellNight() const;

private:
  struct Angles
  {
    double azimuth; ///< on the map
    double altitude;
  };
  Angles AnglesOf(const TimedSun& sun, const relief::ClockTime& time) const;

  const SunTimes& Times;
  std::array<double, 2> Center{ 0.0, 0.0 };
  double Convergence = 0.0;
};

/// Puts the sun of frames before all other lights: layers of the first light and the first sun are
/// of it.
void putFramesFirst(Options& options);

/// How many pictures there are, at least 1.
int frameCount(const Options& options);

/// A file's name at a frame: with the time before its extension. Without frames, and for an empty
/// name, the name itself.
std::string frameFile(const Options& options, const std::string& file, int frame);

/// Names of all files as they are at a frame, of options that have them as they were given.
struct FrameFiles
{
  explicit FrameFiles(const Options& options);
  void Name(Options& options, int frame) const;

private:
  std::string Output;
  std::string LayersFile;
  std::string ShadowMask;
};

}

#endif

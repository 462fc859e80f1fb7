// SPDX-License-Identifier: BSD-3-Clause
#include "SunTimes.h"

#include "Failure.h"
#include "FileGuard.h"
#include "LightOptions.h"
#include "MapPlace.h"
#include "OptionParser.h"
#include "Options.h"

#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkNew.h"
#include "vtkReliefAngles.h"
#include "vtkReliefScene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace
{

using namespace reliefshade;

/// More would hardly be meant.
constexpr std::int64_t MostFrames = 10000;

//------------------------------------------------------------------------------
void check(const std::string& option, const std::string& wrong)
{
  if (!wrong.empty())
  {
    throw Failure(option, wrong, UsageFailure);
  }
}

//------------------------------------------------------------------------------
relief::ClockTime toTime(const std::string& option, const std::string& word)
{
  relief::ClockTime time;
  check(option, relief::ParseTime(word, time));
  return time;
}

//------------------------------------------------------------------------------
/// A sun of a list: a time, and from the word `at` on perhaps a place, an intensity and a colour.
TimedSun toSun(const std::string& option, const std::vector<std::string>& words, std::size_t at,
  Options& options)
{
  TimedSun sun;
  sun.Time = toTime(option, words[0]);
  std::vector<double> numbers;
  if (words.size() > at)
  {
    std::string list;
    for (std::size_t k = at; k < words.size(); ++k)
    {
      list += (k > at ? "," : "") + words[k];
    }
    numbers = toNumbers(option, list, { 2, 3, 6 });
    check(option, relief::CheckPlace(numbers[0], numbers[1], 0.0));
    sun.Place = { numbers[0], numbers[1] };
  }
  sun.Light = options.Scene->AddSun(0.0, 45.0); // for the time being
  setPower(sun.Light, numbers, 2);
  return sun;
}

//------------------------------------------------------------------------------
void setFrames(const std::string& word, Options& options)
{
  const std::vector<std::string> words = split(word);
  if (words.size() < 3)
  {
    throw Failure("--frames", "'" + word + "' was given, START,END,STEP is expected", UsageFailure);
  }
  FrameTimes frames;
  const relief::ClockTime end = toTime("--frames", words[1]);
  check("--frames", relief::ParseDuration(words[2], frames.Step));
  const relief::ClockTime start = toTime("--frames", words[0]);
  if (end.milliseconds < start.milliseconds)
  {
    throw Failure("--frames",
      words[1] + " was given, an end that is not before " + words[0] + " is expected",
      UsageFailure);
  }
  const std::int64_t count = (end.milliseconds - start.milliseconds) / frames.Step + 1;
  if (count > MostFrames)
  {
    throw Failure("--frames",
      words[2] + " makes " + std::to_string(count) + " frames, at most " +
        std::to_string(MostFrames) + " are expected; take a longer step",
      UsageFailure);
  }
  frames.Count = static_cast<int>(count);
  frames.Sun = toSun("--frames", words, 3, options);
  options.Times.Frames = frames;
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
relief::ClockTime FrameTimes::TimeOf(int frame) const
{
  relief::ClockTime time = this->Sun.Time;
  time.milliseconds += frame * this->Step;
  return time;
}

//------------------------------------------------------------------------------
void addSunTimes(OptionParser& parser, Options& options, void (*prepare)(Options&))
{
  parser
    .Word("--sun-at", "TIME[,LON,LAT...]",
      "The sun of a time. ISO 8601 with a zone, 2026-06-21T06:30+02:00 or 2026-06-21T04:30Z, of "
      "the years 1600 to 2399; LON to the east and LAT to the north in degrees. What the map's "
      "north is beside the true one counts. I,R,G,B may follow, intensity and colour. Default: the "
      "place of INPUT's centre, if its georeference tells it",
      [&options, prepare](const std::string& word)
      {
        prepare(options);
        options.Times.Suns.push_back(toSun("--sun-at", split(word), 1, options));
      })
    ->trigger_on_parse();
  parser.Word("--frames", "START,END,STEP[...]",
    "A picture for each of several times. Of the sun from START to END, which are as TIME above, "
    "each STEP later: 15min, 30s, 1h or PT15M. LON,LAT,I,R,G,B may follow. The names of files get "
    "the time before their extension, in START's zone: shaded_20260621T0630+0200.png. A frame's "
    "files appear when it is whole. An automatic exposure is each frame's own",
    [&options, prepare](const std::string& word)
    {
      prepare(options);
      setFrames(word, options);
    });
  parser.Word("--refraction", "M|off",
    "How air bends the light of --sun-at. And of --frames: by the standard atmosphere M metres "
    "above the sea, at most 11000; off: not at all. Default: 0",
    [&options](const std::string& word)
    {
      if (isWord(word, "off"))
      {
        options.Times.Elevation.reset();
        return;
      }
      options.Times.Elevation = toNumber("--refraction", word);
      check("--refraction", relief::CheckPlace(0.0, 0.0, *options.Times.Elevation));
    });
}

//------------------------------------------------------------------------------
SunClock::SunClock(const Options& options, const relief::raster::RasterHeader& raster)
  : Times(options.Times)
{
  std::vector<const TimedSun*> suns;
  for (const TimedSun& sun : this->Times.Suns)
  {
    suns.push_back(&sun);
  }
  if (this->Times.Frames)
  {
    suns.push_back(&this->Times.Frames->Sun);
  }
  if (suns.empty())
  {
    return;
  }
  try
  {
    const relief::raster::MapPlace place = relief::raster::PlaceOfCenter(raster);
    this->Center = { place.Longitude, place.Latitude };
    this->Convergence = place.Convergence;
  }
  catch (const relief::io::Failure& failure)
  {
    // Without a map +y is north, as for --sun; a place must then be given.
    if (!std::all_of(suns.begin(), suns.end(), [](const TimedSun* sun) { return sun->Place; }))
    {
      const std::string option =
        this->Times.Suns.empty() ? "--frames START,END,STEP" : "--sun-at TIME";
      throw Failure(
        options.Input, std::string(failure.what()) + "; " + option + ",LON,LAT gives it");
    }
  }
}

//------------------------------------------------------------------------------
SunClock::Angles SunClock::AnglesOf(const TimedSun& sun, const relief::ClockTime& time) const
{
  const std::array<double, 2> place = sun.Place.value_or(this->Center);
  const relief::SolarPosition position =
    relief::hosts::SunAt(time, place[0], place[1], this->Times.Elevation);
  return { position.azimuth - this->Convergence, position.altitude };
}

//------------------------------------------------------------------------------
void SunClock::Place(int frame) const
{
  const auto put = [this](const TimedSun& sun, const relief::ClockTime& time)
  {
    const Angles angles = this->AnglesOf(sun, time);
    double direction[3];
    vtkReliefDirection(angles.azimuth, angles.altitude, direction);
    sun.Light->SetPosition(direction);
  };
  for (const TimedSun& sun : this->Times.Suns)
  {
    put(sun, sun.Time);
  }
  if (this->Times.Frames)
  {
    put(this->Times.Frames->Sun, this->Times.Frames->TimeOf(frame));
  }
}

//------------------------------------------------------------------------------
std::string SunClock::TellNight() const
{
  std::ostringstream text;
  text.precision(3);
  const char* const meaning = ", and gives no light";
  for (const TimedSun& sun : this->Times.Suns)
  {
    const double altitude = this->AnglesOf(sun, sun.Time).altitude;
    if (altitude < 0.0 && text.tellp() == 0)
    {
      text << "night: the sun of " << relief::NameOf(sun.Time, false) << " is " << -altitude
           << " degrees below the horizon" << meaning;
    }
  }
  int dark = 0;
  const int count = this->Times.Frames ? this->Times.Frames->Count : 0;
  for (int frame = 0; frame < count; ++frame)
  {
    dark +=
      this->AnglesOf(this->Times.Frames->Sun, this->Times.Frames->TimeOf(frame)).altitude < 0.0;
  }
  if (dark > 0)
  {
    text << (text.tellp() == 0 ? "" : "; ") << "night: the sun is below the horizon in " << dark
         << " of " << count << " frames" << meaning;
  }
  return text.str();
}

//------------------------------------------------------------------------------
void putFramesFirst(Options& options)
{
  if (options.Times.Frames)
  {
    vtkNew<vtkLightCollection> lights;
    lights->AddItem(options.Times.Frames->Sun.Light);
    for (vtkLight* light : vtk::Range(options.Scene->GetLights()))
    {
      if (light != options.Times.Frames->Sun.Light)
      {
        lights->AddItem(light);
      }
    }
    options.Scene->RemoveAllLights();
    for (vtkLight* light : vtk::Range(lights.Get()))
    {
      options.Scene->AddLight(light);
    }
  }
}

//------------------------------------------------------------------------------
int frameCount(const Options& options)
{
  return options.Times.Frames ? options.Times.Frames->Count : 1;
}

//------------------------------------------------------------------------------
std::string frameFile(const Options& options, const std::string& file, int frame)
{
  if (!options.Times.Frames || file.empty())
  {
    return file;
  }
  // All names are of one length, so that they are in the order of the times.
  const FrameTimes& frames = *options.Times.Frames;
  const auto isWhole = [](std::int64_t milliseconds) { return milliseconds % 60000 == 0; };
  const bool seconds =
    !isWhole(frames.Sun.Time.milliseconds) || (frames.Count > 1 && !isWhole(frames.Step));
  const std::filesystem::path path(file);
  return (path.parent_path() /
    (path.stem().string() + "_" + relief::NameOf(frames.TimeOf(frame), seconds) +
      path.extension().string()))
    .string();
}

//------------------------------------------------------------------------------
FrameFiles::FrameFiles(const Options& options)
  : Output(options.Output)
  , LayersFile(options.LayersFile)
  , ShadowMask(options.ShadowMask)
{
}

//------------------------------------------------------------------------------
void FrameFiles::Name(Options& options, int frame) const
{
  options.Output = frameFile(options, this->Output, frame);
  options.LayersFile = frameFile(options, this->LayersFile, frame);
  options.ShadowMask = frameFile(options, this->ShadowMask, frame);
}

}

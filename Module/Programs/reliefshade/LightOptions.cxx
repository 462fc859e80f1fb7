// SPDX-License-Identifier: BSD-3-Clause
#include "LightOptions.h"

#include "Failure.h"
#include "OptionParser.h"
#include "Options.h"
#include "SunTimes.h"

#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"

#include <map>
#include <sstream>

namespace
{

using namespace reliefshade;
namespace parameters = relief::parameters;

//------------------------------------------------------------------------------
std::string usualAngles()
{
  std::ostringstream angles;
  angles << parameters::UsualAzimuth << "," << parameters::UsualAltitude;
  return angles.str();
}

/// Of a scene without lights, as --sun takes it.
std::string usualSun()
{
  std::ostringstream sun;
  sun << usualAngles() << "," << parameters::UsualIntensity;
  return sun.str();
}

//------------------------------------------------------------------------------
/// Lights of the command line take the place of those of the scene's file.
void dropLightsOfFile(Options& options)
{
  if (options.LightsOfFile)
  {
    options.Scene->RemoveAllLights();
    options.LightsOfFile = false;
  }
}

//------------------------------------------------------------------------------
void addSuns(OptionParser& parser, Options& options)
{
  vtkReliefScene* scene = options.Scene;
  // Triggered one by one: the lights keep the order of the command line.
  parser
    .Numbers("--sun", "AZ,ALT[,I[,R,G,B]]",
      "A light that is infinitely far. Azimuth clockwise from north (the upper edge), altitude "
      "above the horizon from -90 to 90, both in degrees; intensity and linear colour, which "
      "take light away where they are negative, default: 1 and 1,1,1. Without any light: --sun " +
        usualSun(),
      { 2, 3, 6 },
      [scene, &options](const std::vector<double>& n)
      {
        dropLightsOfFile(options);
        refuse("--sun", parameters::CheckSun(n[0], n[1], 0.0));
        vtkLight* sun = scene->AddSun(n[0], n[1]);
        setPower(sun, n, 2);
      })
    ->trigger_on_parse();
  parser
    .Numbers("--point", "X,Y,Z[,I[,R,G,B]]",
      "A light at a place. See Coordinates below; intensity and colour as for --sun. It does not "
      "fade with distance",
      { 3, 4, 7 },
      [scene, &options](const std::vector<double>& n)
      {
        dropLightsOfFile(options);
        vtkNew<vtkLight> light;
        light->SetLightTypeToSceneLight();
        light->PositionalOn();
        light->SetPosition(n[0], n[1], n[2]);
        setPower(light, n, 3);
        scene->AddLight(light);
      })
    ->trigger_on_parse();
}

//------------------------------------------------------------------------------
/// Puts a preset's lights before those of the command line.
void addPreset(const std::string& word, Options& options)
{
  vtkReliefScene* scene = options.Scene;
  dropLightsOfFile(options);
  options.EnvironmentOfFile = false;
  vtkNew<vtkLightCollection> given;
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    given->AddItem(light);
  }
  const std::string name = word.substr(0, word.find(','));
  // The angles behind the name, or the usual ones.
  const auto placeOf = [&](const std::vector<double>& usual)
  {
    return word == name ? usual
                        : toNumbers("--preset", word.substr(name.size() + 1), { usual.size() });
  };
  if (isWord(word, "multidirectional"))
  {
    scene->SetLightsToMultidirectional();
  }
  else if (isWord(word, "sky-dome"))
  {
    scene->SetLightsToSkyDome();
  }
  else if (isWord(name, "sun-and-sky"))
  {
    const std::vector<double> place =
      placeOf({ parameters::UsualAzimuth, parameters::UsualAltitude });
    refuse("--preset", parameters::CheckSunAndSky(place[0], place[1]));
    scene->SetLightsToSunAndSky(place[0], place[1]);
  }
  else if (isWord(name, "combined"))
  {
    const std::vector<double> place =
      placeOf({ parameters::UsualAzimuth, parameters::UsualAltitude });
    refuse("--preset", parameters::CheckSun(place[0], place[1], 0.0));
    scene->SetLightsToCombined(place[0], place[1]);
  }
  else if (isWord(name, "igor"))
  {
    scene->SetLightsToIgor(placeOf({ parameters::UsualAzimuth })[0]);
  }
  else
  {
    throw Failure("--preset",
      "'" + word +
        "' is none of multidirectional|sky-dome|sun-and-sky[,AZ,ALT]|combined[,AZ,ALT]|igor[,AZ]" +
        suggestion(name, { "multidirectional", "sky-dome", "sun-and-sky", "combined", "igor" }),
      UsageFailure);
  }
  for (vtkLight* light : vtk::Range(given.Get()))
  {
    scene->AddLight(light);
  }
}

//------------------------------------------------------------------------------
void setDiameter(
  const parameters::Parameter& diameter, const std::string& word, vtkReliefScene* scene)
{
  const parameters::Values value = toValues(diameter, word);
  if (scene->GetLights()->GetNumberOfItems() == 0 && !scene->GetEnvironment())
  {
    scene->SetLightsToDefault();
  }
  bool any = false;
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    if (!light->GetPositional())
    {
      diameter.Set(light, value);
      any = true;
    }
  }
  if (!any)
  {
    throw Failure("--sun-diameter", "there is no sun", UsageFailure);
  }
}

//------------------------------------------------------------------------------
vtkReliefEnvironment* environmentOf(vtkReliefScene* scene, const std::string& option)
{
  if (!scene->GetEnvironment())
  {
    throw Failure(option,
      "there is no light from all around: --env, or --preset with a sky, gives it", UsageFailure);
  }
  return scene->GetEnvironment();
}

//------------------------------------------------------------------------------
void addEnvironmentOptions(OptionParser& parser, Options& options)
{
  vtkReliefScene* scene = options.Scene;
  parser.Word("--env", "FILE",
    "Light from all around: a latitude-longitude picture (OpenEXR, HDR, PNG ...), its upper edge "
    "the zenith, its left edge the east, a quarter of its width to the right the north. Pictures "
    "of 8 and 16 bit are taken for sRGB-encoded. It adds to the lights",
    [&options, scene](const std::string& word)
    {
      if (scene->GetEnvironment() && !options.EnvironmentOfFile)
      {
        throw Failure("--env", "the sky of --preset is there already", UsageFailure);
      }
      vtkNew<vtkReliefEnvironment> environment;
      environment->SetFileName(word.c_str());
      scene->SetEnvironment(environment);
      options.Environment = word;
    });
  parser.Flag("--env-mirror",
    "The picture of --env is seen from within, as photographed panoramas are: its columns run the "
    "other way round",
    options.MirrorEnvironment);
  // What a --preset brings along is another default.
  const std::map<std::string, std::string> usually = { { "NumberOfSamples", ", 128 for sky-dome" },
    { "Sampling", ", importance for sun-and-sky" },
    { "Intensity", ", 0.62 for sky-dome, 0.2 for sun-and-sky" } };
  for (const parameters::Parameter* parameter : parameters::Of(parameters::Owner::Environment))
  {
    if (parameter->Option)
    {
      const auto more = usually.find(parameter->Name);
      const std::string help = helpOf(*parameter, nullptr);
      parser.Parameter(*parameter, more == usually.end() ? help : help + more->second,
        [scene, parameter] { return environmentOf(scene, parameter->Option); });
    }
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void setPower(vtkLight* light, const std::vector<double>& numbers, std::size_t used)
{
  if (numbers.size() > used)
  {
    light->SetIntensity(numbers[used]);
  }
  if (numbers.size() > used + 1)
  {
    light->SetDiffuseColor(numbers[used + 1], numbers[used + 2], numbers[used + 3]);
  }
}

//------------------------------------------------------------------------------
void addLightOptions(OptionParser& parser, Options& options)
{
  vtkReliefScene* scene = options.Scene;
  const char* const lights = "Lights (--sun, --sun-at and --point may be repeated; all add up)";
  parser.SetGroup(lights);
  addSuns(parser, options);
  addSunTimes(parser, options, dropLightsOfFile);
  // What follows is run in this order, when the suns are there.
  parser.Word("--preset", "NAME[,AZ[,ALT]]",
    "Light as cartographers know it: multidirectional, sky-dome, sun-and-sky, combined or igor. "
    "Four suns from south-west to north; a uniform white sky; the sun, at azimuth and altitude (0 "
    "to 90) in degrees, and a clear sky; a sun, and --response combined; a sun at an azimuth, and "
    "--response igor. Default of the angles: " +
      usualAngles() + ". Adds to the lights",
    [&options](const std::string& word) { addPreset(word, options); });
  parser.SetGroup("Light from all around");
  addEnvironmentOptions(parser, options);
  parser.SetGroup(lights);
  const parameters::Parameter& diameter =
    parameters::Find(parameters::Owner::Light, "AngularDiameter");
  parser.Word(diameter.Option, diameter.OptionValue,
    helpOf(diameter, nullptr) + ", 0.533 for sun-and-sky",
    [scene, &diameter](const std::string& word) { setDiameter(diameter, word, scene); });
  addSceneParameters(parser, scene, parameters::Group::Lights);
}

}

// SPDX-License-Identifier: BSD-3-Clause
#include "LightOptions.h"

#include "Failure.h"
#include "OptionParser.h"
#include "Options.h"

#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"

#include <algorithm>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
/// Intensity and colour of a light from the numbers behind its `used` first ones.
void setPower(
  const std::string& option, vtkLight* light, const std::vector<double>& numbers, std::size_t used)
{
  if (std::any_of(numbers.begin() + used, numbers.end(), [](double n) { return n < 0.0; }))
  {
    throw Failure(option, "intensity and colour are at least 0", UsageFailure);
  }
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
      "above the horizon from -90 to 90, both in degrees; intensity and linear colour, at least 0, "
      "default: 1 and 1,1,1. Without any light: --sun 315,45",
      { 2, 3, 6 },
      [scene, &options](const std::vector<double>& n)
      {
        dropLightsOfFile(options);
        vtkLight* sun = scene->AddSun(n[0], n[1]);
        refuseWhatTheSceneRefuses("--sun");
        setPower("--sun", sun, n, 2);
      })
    ->trigger_on_parse();
  parser
    .Numbers("--point", "X,Y,Z[,I[,R,G,B]]",
      "A light at a place, see Coordinates below; intensity and colour as for --sun. It does not "
      "fade with distance",
      { 3, 4, 7 },
      [scene, &options](const std::vector<double>& n)
      {
        dropLightsOfFile(options);
        vtkNew<vtkLight> light;
        light->SetLightTypeToSceneLight();
        light->PositionalOn();
        light->SetPosition(n[0], n[1], n[2]);
        setPower("--point", light, n, 3);
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
  if (word == "multidirectional")
  {
    scene->SetLightsToMultidirectional();
  }
  else if (word == "sky-dome")
  {
    scene->SetLightsToSkyDome();
  }
  else if (name == "sun-and-sky")
  {
    std::vector<double> place{ 315.0, 45.0 };
    if (word != name)
    {
      place = toNumbers("--preset", word.substr(name.size() + 1), { 2 });
    }
    scene->SetLightsToSunAndSky(place[0], place[1]);
  }
  else
  {
    throw Failure("--preset",
      "'" + word + "' is none of multidirectional|sky-dome|sun-and-sky[,AZ,ALT]", UsageFailure);
  }
  for (vtkLight* light : vtk::Range(given.Get()))
  {
    scene->AddLight(light);
  }
}

//------------------------------------------------------------------------------
void setDiameter(double degrees, vtkReliefScene* scene)
{
  if (!(degrees >= 0.0 && degrees <= 90.0))
  {
    throw Failure("--sun-diameter", "degrees are from 0 to 90", UsageFailure);
  }
  if (scene->GetLights()->GetNumberOfItems() == 0 && !scene->GetEnvironment())
  {
    scene->AddSun(315.0, 45.0);
  }
  bool any = false;
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    if (!light->GetPositional())
    {
      scene->SetAngularDiameter(light, degrees);
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
  vtkNew<vtkReliefEnvironment> usual;
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
  parser.Word("--env-samples", "N",
    "How many lights stand for the environment; each is traced. From 1 to 65536, best a multiple "
    "of 8. Default: " +
      std::to_string(usual->GetNumberOfSamples()) + ", 128 for sky-dome",
    [scene](const std::string& word)
    {
      const std::string option = "--env-samples";
      environmentOf(scene, option)->SetNumberOfSamples(toCount(option, word));
    });
  auto sampling = [scene](int value)
  { return [scene, value] { environmentOf(scene, "--env-sampling")->SetSampling(value); }; };
  parser.Choice("--env-sampling",
    "How they are spread: uniform in azimuth and polar angle, as the model was first published; "
    "evenly over the sphere; or where the light is, for pictures with a sun or lamps. Default: "
    "solid-angle, importance for sun-and-sky",
    { { "uniform", sampling(vtkReliefEnvironment::Uniform) },
      { "solid-angle", sampling(vtkReliefEnvironment::SolidAngle) },
      { "importance", sampling(vtkReliefEnvironment::Importance) } });
  parser.Number("--env-rotation", "DEG",
    "Turns the environment about the vertical, counter-clockwise seen from above, in degrees. "
    "Default: 0",
    [scene](double value) { environmentOf(scene, "--env-rotation")->SetRotationZ(value); });
  parser.Number("--env-tilt", "DEG",
    "Then leans its zenith toward the south, in degrees. Default: 0",
    [scene](double value) { environmentOf(scene, "--env-tilt")->SetTilt(value); });
  parser.Number("--env-intensity", "I",
    "What its colours are multiplied by. At least 0. Default: 1, 0.3 for sun-and-sky",
    [scene](double value) { environmentOf(scene, "--env-intensity")->SetIntensity(value); });
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void addLightOptions(OptionParser& parser, Options& options)
{
  vtkReliefScene* scene = options.Scene;
  parser.SetGroup("Lights (--sun and --point may be repeated; all add up)");
  addSuns(parser, options);
  // What follows is run in this order, when the suns are there.
  parser.Word("--preset", "multidirectional|sky-dome|sun-and-sky[,AZ,ALT]",
    "Light as cartographers know it: four suns from south-west to north; a uniform white sky; or "
    "the sun and a clear sky, the sun at azimuth and altitude (0 to 90) in degrees, default: "
    "315,45. Adds to the lights",
    [&options](const std::string& word) { addPreset(word, options); });
  addEnvironmentOptions(parser, options);
  parser.Number("--sun-diameter", "DEG",
    "How large suns look, which widens the edges of shadows with distance: 0.533 is the real sun. "
    "From 0, a point, to 90 degrees. Default: 0, 0.533 for sun-and-sky",
    [scene](double degrees) { setDiameter(degrees, scene); });
}

}

// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include "Failure.h"
#include "LightOptions.h"
#include "MemoryBudget.h"
#include "MessageLog.h"
#include "OptionParser.h"
#include "RasterWriter.h"

#include "vtkLightCollection.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefSceneFile.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
std::string text(double value)
{
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

std::string text(const double* values, int count)
{
  std::string list = text(values[0]);
  for (int i = 1; i < count; ++i)
  {
    list += "," + text(values[i]);
  }
  return list;
}

//------------------------------------------------------------------------------
/// CLI11's help with this program's own beginning.
class HelpFormatter : public CLI::Formatter
{
public:
  HelpFormatter() { this->column_width(34); }
  std::string make_usage(const CLI::App*, std::string) const override;
};

//------------------------------------------------------------------------------
/// Reads the scene that --scene names, before the other options, which change it.
void readScene(int argc, char* argv[], Options& options)
{
  CLI::App app;
  app.set_help_flag("");
  app.allow_extras();
  app.add_option("--scene", options.SceneFile);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError&)
  {
    return; // the other parser says what is wrong
  }
  if (options.SceneFile.empty())
  {
    return;
  }
  vtkNew<vtkReliefSceneFile> file;
  file->SetFileName(options.SceneFile.c_str());
  file->SetScene(options.Scene);
  if (!file->Read())
  {
    throw Failure(options.SceneFile, withoutName(takeError(), options.SceneFile));
  }
  options.LightsOfFile = options.Scene->GetLights()->GetNumberOfItems() > 0;
  options.EnvironmentOfFile = options.Scene->GetEnvironment() != nullptr;
}

//------------------------------------------------------------------------------
void addSceneOptions(OptionParser& parser, Options& options)
{
  parser.SetGroup("Scene");
  parser.Word("--scene", "FILE",
    "Material, lights and accuracy from a file, in place of the defaults below. Options change it: "
    "--sun, --point and --preset take the place of its lights, --env and a --preset that of its "
    "environment. Positions of its lights are those of --point",
    [&options](const std::string& word) { options.SceneFile = word; });
  parser.Word("--save-scene", "FILE", "Keeps what was used, for --scene",
    [&options](const std::string& word) { options.SavedScene = word; });
}

//------------------------------------------------------------------------------
void addInputOptions(OptionParser& parser, Options& options)
{
  parser.SetGroup("Heights");
  vtkReliefScene* scene = options.Scene;
  parser.Number("--height-scale", "F",
    "What heights are multiplied by, after they have been converted to metres where the file "
    "names their unit. Negative values turn the relief inside out. Default: " +
      text(scene->GetHeightScale()),
    [scene](double value) { scene->SetHeightScale(value); });
  parser.Numbers("--spacing", "SX[,SY]",
    "Distance between samples along x and y, in the unit of the heights. Above 0. Default: metres "
    "from the file's georeference; 1 without one",
    { 1, 2 },
    [&options](const std::vector<double>& s)
    {
      if (!(s.front() > 0.0) || !(s.back() > 0.0))
      {
        throw Failure("--spacing", "distances are above 0", UsageFailure);
      }
      options.Spacing = { s.front(), s.back() };
    });
  parser.Flag("--degrees",
    "The file does not name its coordinate reference system: it is longitude and latitude in "
    "degrees on WGS 84",
    options.Reading.Degrees);
  parser.Word("--nodata", "V|none",
    "The height, as the file stores it, that stands for no data; none: every height counts. NaN "
    "never does. Default: as the file says",
    [&options](const std::string& word)
    {
      options.Reading.NoDataFromFile = false;
      options.Reading.NoData.reset();
      if (word != "none")
      {
        options.Reading.NoData = toNumber("--nodata", word);
      }
    });
  parser.Word("--mask", "FILE", "A raster of the same size; where it is 0 there is no data",
    [&options](const std::string& word) { options.Mask = word; });
  parser.Word("--band", "N",
    "Which band of the file holds the heights. At least 1. Default: 1, but pictures of several "
    "colours are refused",
    [&options](const std::string& word) { options.Reading.Band = toCount("--band", word); });
}

//------------------------------------------------------------------------------
void addMaterialOptions(OptionParser& parser, Options& options)
{
  parser.SetGroup("Material (colours are linear RGB, 0 black to 1 white)");
  vtkReliefMaterial* material = options.Scene->GetMaterial();
  parser.Numbers("--base", "R,G,B",
    "Colour without any light. At least 0. Default: " + text(material->GetBaseColor(), 3), { 3 },
    [material](const std::vector<double>& c) { material->SetBaseColor(c.data()); });
  parser.Numbers("--diffuse", "R,G,B",
    "Colour of the light that has passed through the material. At least 0. Default: " +
      text(material->GetDiffuseColor(), 3),
    { 3 }, [material](const std::vector<double>& c) { material->SetDiffuseColor(c.data()); });
  parser.Numbers("--specular", "R,G,B",
    "Colour of highlights. At least 0. Default: " + text(material->GetSpecularColor(), 3), { 3 },
    [material](const std::vector<double>& c) { material->SetSpecularColor(c.data()); });
  parser.Number("--ks", "K",
    "Share of highlights, from 0 (none) to 1 (nothing else). Default: " +
      text(material->GetSpecularCoefficient()),
    [material](double k) { material->SetSpecularCoefficient(k); });
  parser.Numbers("--specular-range", "LO,HI",
    "Where a highlight begins and is full: cosines of the angle between light and mirrored view. "
    "LO at most HI. Default: " +
      text(material->GetSpecularRange(), 2),
    { 2 }, [material](const std::vector<double>& r) { material->SetSpecularRange(r.data()); });
  parser.Number("--specular-power", "P",
    "Exponent of the highlight's falloff: larger is narrower. At least 0. Default: " +
      text(material->GetSpecularPower()),
    [material](double p) { material->SetSpecularPower(p); });
  parser.Number("--kf", "K",
    "Share of the diffuse light that is scattered forward, seen when the light is behind the "
    "relief, "
    "from 0 to 1. Default: " +
      text(material->GetForwardScatterCoefficient()),
    [material](double k) { material->SetForwardScatterCoefficient(k); });
  parser.Numbers("--scatter-range", "LO,HI",
    "Where forward scattering begins and is full: cosines of the angle between view and light's "
    "way, 1 for a light straight behind. LO at most HI. Default: " +
      text(material->GetForwardScatterRange(), 2),
    { 2 },
    [material](const std::vector<double>& r) { material->SetForwardScatterRange(r.data()); });
  parser.Number("--scatter-power", "P",
    "Exponent of the scattering's falloff. At least 0. Default: " +
      text(material->GetForwardScatterPower()),
    [material](double p) { material->SetForwardScatterPower(p); });
  parser.Word("--depth", "T|auto",
    "How far below the surface light is gathered, in units of length: small is crisp as stone, "
    "large is soft as wax, 0 is opaque. At least 0. Default: auto, the mean spacing of the samples",
    [material](const std::string& word)
    {
      if (word == "auto")
      {
        material->AutomaticSubsurfaceDepthOn();
        return;
      }
      material->SetSubsurfaceDepth(toNumber("--depth", word));
    });
  parser.Choice("--offset",
    "The way down to that depth: vertical, or normal to the surface, which shades slopes as the "
    "cosine of the light's angle does. Default: vertical",
    { { "vertical", [material] { material->SetOffsetModeToVertical(); } },
      { "normal", [material] { material->SetOffsetModeToSurfaceNormal(); } } });
  parser.Choice("--attenuation",
    "How the thickness r that light has passed dims it: T/r, or exp(-A (r - T)). Default: "
    "reciprocal",
    { { "reciprocal", [material] { material->SetAttenuationToReciprocal(); } },
      { "exponential", [material] { material->SetAttenuationToExponential(); } } });
  parser.Number("--density", "A",
    "Density of the exponential attenuation, per unit of length. At least 0. Default: " +
      text(material->GetDensity()),
    [material](double a) { material->SetDensity(a); });
  parser.Number("--floor", "H",
    "Scaled height at which the material ends below, so that light comes through from behind. "
    "Default: it has no bottom",
    [material](double h)
    {
      material->SetFloorHeight(h);
      material->UseFloorOn();
    });
}

//------------------------------------------------------------------------------
void addPictureOptions(OptionParser& parser, Options& options)
{
  parser.SetGroup("Pictures as colours");
  const std::string where =
    " One component is grey, two are grey and alpha, three red, green and blue, four these and "
    "alpha; where alpha is below 1, and beyond the picture, ";
  parser.Word("--texture", "FILE",
    "A picture in place of --diffuse, see Pictures below." + where + "--tint or --diffuse shows",
    [&options](const std::string& word) { options.DiffuseTexture = word; });
  parser.Word("--base-texture", "FILE", "The same for --base",
    [&options](const std::string& word) { options.BaseTexture = word; });
  parser.Word("--specular-texture", "FILE", "The same for --specular; it shows with --ks",
    [&options](const std::string& word) { options.SpecularTexture = word; });
  parser.Word("--tint", "FILE",
    "Colours by height in place of --diffuse: a text file as for 'gdaldem color-relief'. In each "
    "line a height as the input file has it, or a share of its range (50%), then red, green, blue "
    "and perhaps alpha from 0 to 255, or a colour's name; blanks, commas, colons or tabs between "
    "them, # before a comment. Colours between two heights are interpolated. nv is passed over: "
    "samples without data stay transparent",
    [&options](const std::string& word) { options.Tint = word; });
}

//------------------------------------------------------------------------------
bool isLayerName(const std::string& word)
{
  const LayerNames& names = layerNames();
  return std::find(names.begin(), names.end(), word) != names.end();
}

/// Names of layers, perhaps with an OpenEXR file behind them, whose own name may have commas.
void setLayers(std::string list, Options& options)
{
  const bool file = lowerExtension(list) == ".exr";
  for (bool more = true; more;)
  {
    const std::size_t comma = list.find(',');
    const std::string name = list.substr(0, comma);
    more = comma != std::string::npos;
    if (!isLayerName(name) && file)
    {
      break;
    }
    if (!isLayerName(name))
    {
      std::string names;
      for (const std::string& known : layerNames())
      {
        names += known + ", ";
      }
      throw Failure("--layers", "'" + name + "' is none of " + names + "and no OpenEXR file (.exr)",
        UsageFailure);
    }
    options.Layers.push_back(name);
    list.erase(0, comma + 1);
  }
  if (file)
  {
    options.LayersFile = list;
    options.Layers = options.Layers.empty() ? layerNames() : options.Layers;
  }
}

//------------------------------------------------------------------------------
void addRunOptions(OptionParser& parser, Options& options)
{
  vtkReliefScene* scene = options.Scene;
  parser.SetGroup("Computation");
  parser.Choice("--integrator",
    "Thickness in closed form, or from a fixed number of points along each ray, as the model was "
    "first published. Default: exact",
    { { "exact", [scene] { scene->SetIntegratorToExact(); } },
      { "fixed-step", [scene] { scene->SetIntegratorToFixedStep(); } } });
  parser.Number("--tolerance", "E",
    "How far exact's illumination (0 to 1) may be off. At least 0. Default: " +
      text(scene->GetTolerance()),
    [scene](double e) { scene->SetTolerance(e); });
  parser.Word("--steps", "N",
    "Points along a ray of fixed-step. From 1 to 1000000. Default: " +
      std::to_string(scene->GetNumberOfSteps()),
    [scene](const std::string& word) { scene->SetNumberOfSteps(toCount("--steps", word)); });
  parser.Word("--threads", "N",
    "Threads to shade with. At least 1. Default: one for each processor. The result does not "
    "depend on it",
    [&options](const std::string& word) { options.Threads = toCount("--threads", word); });
  const double mebibyte = 1024.0 * 1024.0;
  options.MemoryLimit = machineMemory();
  parser.Number("--memory-limit", "MIB",
    "Memory that reading, shading and writing may take, in mebibytes: what needs more is refused "
    "by the sizes in the files' headers, before any is taken. At least 0; 0 refuses nothing. "
    "Default: the memory of the machine, " +
      std::to_string(static_cast<long long>(options.MemoryLimit / mebibyte)),
    [&options, mebibyte](double mebibytes)
    {
      if (!(mebibytes >= 0.0))
      {
        throw Failure("--memory-limit", "a number of at least 0 is expected", UsageFailure);
      }
      options.MemoryLimit = mebibytes * mebibyte;
    });

  parser.SetGroup("Output");
  parser.Choice("--type",
    "uint8: sRGB-encoded, 0 to 255; float: linear; auto: float where OUTPUT is OpenEXR, Radiance "
    "HDR or PFM, else uint8. Default: auto",
    { { "auto", [&options] { options.OutputType = VTK_VOID; } },
      { "uint8", [&options] { options.OutputType = VTK_UNSIGNED_CHAR; } },
      { "float", [&options] { options.OutputType = VTK_FLOAT; } } });
  parser.Word("--layers", "NAME[,NAME...]|[NAME,...]FILE.exr",
    "Writes parts of the result. As names: each beside OUTPUT, as OUTPUT's name without its "
    "extension, a hyphen and the layer's name: OpenEXR if OUTPUT is, else TIFF, 32-bit float, NaN "
    "where there is no data. As an OpenEXR file: linear colour and the layers named before it, or "
    "all, in this one file, named as compositing programs expect; OUTPUT may be left out then. "
    "illumination: share of the light that gets through; thickness: length of the first light's "
    "way inside the material; normals: unit surface normals; base, diffuse, scatter, specular: "
    "linear colours that sum to the result",
    [&options](const std::string& list) { setLayers(list, options); });
  parser.Flag("--statistics",
    "Prints what was read and done to the standard output, one 'name: value' in a line",
    options.Statistics);
  parser.Flag("--quiet",
    "Neither warnings nor the progress bar that a terminal (standard error) gets", options.Quiet);
}

//------------------------------------------------------------------------------
const char* const Usage =
  "Usage: reliefshade INPUT OUTPUT [OPTION...]\n\n"
  "Shades a height field: light, soft shadows, translucency and highlights.\n\n"
  "INPUT   heights: "
#ifdef RELIEFSHADE_USE_GDAL
  "any raster that GDAL reads (GeoTIFF, ESRI ASCII grid, ...)\n"
  "        or any grey picture that OpenImageIO reads (PNG, TIFF, OpenEXR, ...).\n"
#else
  "an ESRI ASCII grid or any grey picture that OpenImageIO\n"
  "        reads (PNG, TIFF, OpenEXR, ...); georeferences of GeoTIFF are not read by\n"
  "        this build.\n"
#endif
  "OUTPUT  the picture, in the format of its extension; an existing file is replaced.\n"
  "        Samples without data are transparent, or black where the format has no\n"
  "        transparency."
#ifdef RELIEFSHADE_USE_GDAL
  " TIFF keeps the georeference of INPUT."
#endif
  "\n";

const char* const Footer =
  "Coordinates\n"
  "  Rasters with a georeference: x and y of --point are map coordinates in the map's own\n"
  "  unit (longitude and latitude for geographic ones), z is the scaled height in metres.\n"
  "  Pictures without: x to the right and y upward from the centre of the lower left\n"
  "  sample, z the scaled height, all in the unit of --spacing.\n"
  "Units of length\n"
  "  Metres for georeferenced rasters: map units are converted, and degrees become the\n"
  "  metres that they are along the parallel and the meridian at the raster's centre, on\n"
  "  its ellipsoid. Heights are taken for metres unless the file names another unit. All\n"
  "  this gives way to --spacing, which brings a unit of your own.\n"
  "Pictures\n"
  "  A picture and heights that both have a georeference lie where the map has them, whatever\n"
  "  their resolution; a picture in another coordinate reference system, or of another place,\n"
  "  is refused. Any other picture is stretched over the whole of the heights, edge to edge.\n"
  "  8 and 16 bit pictures are taken for sRGB-encoded, floating point ones for linear.\n"
  "Exit codes\n"
  "  0 done; 1 a file could not be read, shaded or written; 2 the command line was wrong;\n"
  "  130 interrupted. After an error a file that was there before is untouched.\n"
  "Examples\n"
  "  reliefshade terrain.tif shaded.tif\n"
  "  reliefshade terrain.tif shaded.png --sun 315,30 --sun 45,60,0.3 --depth 200\n"
  "  reliefshade grid.asc shaded.exr --degrees --layers illumination,normals\n"
  "  reliefshade terrain.tif --layers comp.exr --ks 0.2\n"
  "  reliefshade terrain.tif shaded.png --preset sun-and-sky,315,30 --texture orthophoto.tif\n"
  "  reliefshade relief.png wax.png --height-scale 0.01 --kf 0.5 --point 100,200,80";

//------------------------------------------------------------------------------
std::string HelpFormatter::make_usage(const CLI::App*, std::string) const
{
  return Usage;
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
bool parseOptions(int argc, char* argv[], Options& options)
{
  readScene(argc, argv, options);
  CLI::App app("", "reliefshade");
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag(""); // for the time being: it is to come last in the help
  app.footer(Footer);
  app.add_option("INPUT", options.Input)->group("");
  app.add_option("OUTPUT", options.Output)->group("");
  OptionParser parser(app);
  addSceneOptions(parser, options);
  addInputOptions(parser, options);
  addLightOptions(parser, options);
  addMaterialOptions(parser, options);
  addPictureOptions(parser, options);
  addRunOptions(parser, options);
  app.set_help_flag("-h,--help", "Prints this and ends")->group("Output");
  app
    .set_version_flag(
      "--version", "reliefshade " RELIEFSHADE_VERSION, "Prints the version and ends")
    ->group("Output");
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::CallForHelp&)
  {
    std::cout << app.help();
    return false;
  }
  catch (const CLI::CallForVersion& version)
  {
    std::cout << version.what() << "\n";
    return false;
  }
  catch (const CLI::ExtrasError&)
  {
    const std::string word = app.remaining(true).front();
    const bool option = word.size() > 1 && word[0] == '-';
    throw Failure(
      word, option ? "unknown option; see --help" : "a third file; see --help", UsageFailure);
  }
  catch (const CLI::ParseError& error)
  {
    const std::string message = oneLine(error.what());
    const bool repeated = message.find("At Most") != std::string::npos;
    throw Failure("",
      repeated ? message.substr(0, message.find(':')) + ": is given more than once" : message,
      UsageFailure);
  }
  if (options.Input.empty() || (options.Output.empty() && options.LayersFile.empty()))
  {
    throw Failure(
      options.Input.empty() ? "INPUT" : "OUTPUT", "is missing; see --help", UsageFailure);
  }
  if (options.MirrorEnvironment && options.Environment.empty())
  {
    throw Failure("--env-mirror", "there is no picture: --env gives it", UsageFailure);
  }
  if (options.MirrorEnvironment && !options.SavedScene.empty())
  {
    throw Failure("--save-scene", "a scene's file cannot say --env-mirror", UsageFailure);
  }
  const auto place = [](const std::string& file)
  { return file.empty() ? file : std::filesystem::absolute(file).lexically_normal().string(); };
  const std::string output = place(options.Output);
  const std::string layers = place(options.LayersFile);
  const std::string scene = place(options.SavedScene);
  if (!layers.empty() && layers == output)
  {
    throw Failure("--layers", "'" + options.LayersFile + "' is OUTPUT as well", UsageFailure);
  }
  if (!scene.empty() && (scene == output || scene == layers))
  {
    throw Failure("--save-scene",
      "'" + options.SavedScene + "' is " + (scene == output ? "OUTPUT" : "the file of layers") +
        " as well",
      UsageFailure);
  }
  return true;
}

}

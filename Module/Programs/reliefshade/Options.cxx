// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include "AccuracyOutput.h"
#include "Failure.h"
#include "ImageFormats.h"
#include "LightOptions.h"
#include "MessageLog.h"
#include "OptionParser.h"
#include "OutputNames.h"
#include "OutputOptions.h"
#include "ParameterList.h"
#include "PictureOutput.h"
#include "SculptingOptions.h"
#include "TilesOutput.h"

#include "vtkLightCollection.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace
{

using namespace reliefshade;

namespace parameters = relief::parameters;

//------------------------------------------------------------------------------
/// CLI11's help with this program's own beginning.
class HelpFormatter : public CLI::Formatter
{
public:
  HelpFormatter() { this->column_width(34); }
  std::string make_usage(const CLI::App*, std::string) const override;
};

//------------------------------------------------------------------------------
/// Of all options, as they are typed.
std::vector<std::string> optionNames(const CLI::App& app)
{
  std::vector<std::string> all;
  for (const CLI::Option* option : app.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      all.push_back("--" + name);
    }
  }
  return all;
}

//------------------------------------------------------------------------------
/// CLI11's, with one empty line between groups.
std::string help(const CLI::App& app)
{
  std::string text = app.help();
  for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;)
  {
    text.erase(at, 1);
  }
  return text;
}

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
  std::string reason;
  bool scaled = false;
  if (!imageFormats().ReadScene(options.SceneFile, options.Scene, scaled, reason))
  {
    takeError(); // it is told here
    throw Failure(options.SceneFile, reason);
  }
  options.Scaling = scaled ? HeightScaling::Given : HeightScaling::Usual;
  options.LightsOfFile = options.Scene->GetLights()->GetNumberOfItems() > 0;
  vtkReliefEnvironment* environment = options.Scene->GetEnvironment();
  options.EnvironmentOfFile = environment != nullptr;
  if (environment && environment->GetFileName())
  {
    options.SceneEnvironment = environment->GetFileName();
  }
}

//------------------------------------------------------------------------------
void addSceneOptions(OptionParser& parser, Options& options)
{
  parser.SetGroup("Scene");
  parser.Word("--scene", "FILE",
    "Material, lights and accuracy from a file. Options change it: "
    "--sun, --sun-at, --frames, --point and --preset take the place of its lights, --env and a "
    "--preset that of its "
    "environment. Positions of its lights are those of --point",
    [&options](const std::string& word) { options.SceneFile = word; });
  parser.Word("--save-scene", "FILE", "Keeps what was used, for --scene",
    [&options](const std::string& word) { options.SavedScene = word; });
}

//------------------------------------------------------------------------------
void addInputOptions(OptionParser& parser, Options& options)
{
  parser.SetGroup("Heights");
  const parameters::Parameter& scale = parameters::Find(parameters::Owner::Scene, "HeightScale");
  parser.Word(scale.Option, "F|auto",
    helpOf(scale, options.Scene,
      "Heights are converted to metres before, where the file names their unit. auto: chosen so "
      "that steep slopes become those of 35 degrees, and told",
      "auto for files without a georeference and pictures, unless --spacing or a scene's file "
      "tells; else 1"),
    [&options, &scale](const std::string& word)
    {
      options.Scaling = word == "auto" ? HeightScaling::Fitted : HeightScaling::Given;
      if (word != "auto")
      {
        scale.Set(options.Scene, toValues(scale, word));
      }
    });
  parser.Flag("--smooth-steps",
    "Smooths the terraces of heights that were stored in few steps, as in 8 bits: each height "
    "stays "
    "within half a step of what the file has",
    options.SmoothSteps);
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
    "The coordinates are degrees. For files that name no coordinate reference system: they are "
    "longitude and latitude on WGS 84",
    options.Reading.Degrees);
  parser.Word("--nodata", "V|none",
    "The height, as the file stores it, that stands for no data; none: every height counts. NaN "
    "and what lies beyond 3.4e38 never do. Default: as the file says",
    [&options](const std::string& word)
    {
      options.Reading.NoDataFromFile = false;
      options.Reading.NoData.reset();
      if (!isWord(word, "none"))
      {
        options.Reading.NoData = toNumber("--nodata", word);
      }
    });
  parser.Word("--mask", "FILE", "A raster of the same size that is 0 where there is no data",
    [&options](const std::string& word) { options.Mask = word; });
  parser.Word("--band", "N",
    "Which band of the file holds the heights. At least 1. Default: 1, but pictures of several "
    "colours are refused",
    [&options](const std::string& word) { options.Reading.Band = toCount("--band", word); });
  using relief::raster::HeightEncoding;
  const auto encode = [&options](HeightEncoding encoding)
  { return [&options, encoding] { options.Reading.Encoding = encoding; }; };
  parser.Choice("--encoding",
    "How red, green and blue of 8 bits stand for heights in metres. terrarium: 256 R + G + B / 256 "
    "- "
    "32768; terrain-rgb: 0.1 (65536 R + 256 G + B) - 10000; none: not at all. Where alpha is 0 "
    "there is no data. Default: none",
    { { "none", encode(HeightEncoding::None) }, { "terrarium", encode(HeightEncoding::Terrarium) },
      { "terrain-rgb", encode(HeightEncoding::TerrainRGB) } });
  parser.Word("--channel", "NAME",
    "Which channel of an OpenEXR file or another picture with names holds the heights: Z, "
    "ViewLayer.Depth.Z, or the end of such a name. Default: the only one, or the one called Z, "
    "depth, height or elevation beside nothing but colours",
    [&options](const std::string& word) { options.Reading.Channel = word; });
  parser.Word("--part", "NAME|N",
    "Which part of such a file is read, by its name or number from 1. Default: the first, or the "
    "first that has the --channel",
    [&options](const std::string& word) { options.Reading.Part = word; });
}

//------------------------------------------------------------------------------
void addMaterialOptions(OptionParser& parser, Options& options)
{
  const char* const usual = "Material (colours are linear RGB, 0 black to 1 white)";
  vtkReliefMaterial* material = options.Scene->GetMaterial();
  for (const parameters::Parameter* parameter : parameters::Of(parameters::Owner::Material))
  {
    parser.SetGroup(parameter->In == parameters::Group::Highlights ? "Highlights"
        : parameter->In == parameters::Group::Backlight            ? "Light from behind"
                                                                   : usual);
    const std::string name = parameter->Name;
    if (name == "SubsurfaceDepth")
    {
      const std::string usual = "auto, the mean spacing of the samples";
      parser.Parameter(*parameter, helpOf(*parameter, material, std::string(), usual),
        [material] { return material; });
    }
    else if (name == "FloorHeight")
    {
      parser.Word(parameter->Option, parameter->OptionValue,
        helpOf(*parameter, material, "Light then comes through from behind", "it has no bottom"),
        [material, parameter](const std::string& word)
        {
          parameter->Set(material, toValues(*parameter, word));
          material->UseFloorOn();
        });
    }
    else if (parameter->Option)
    {
      parser.Parameter(*parameter, helpOf(*parameter, material), [material] { return material; });
    }
  }
}

//------------------------------------------------------------------------------
void addPictureOptions(OptionParser& parser, Options& options)
{
  parser.SetGroup("Pictures as colours");
  const std::string where =
    " One component is grey, two are grey and alpha, three red, green and blue, four these and "
    "alpha; where alpha is below 1, and beyond the picture, ";
  parser.Word("--texture", "FILE",
    "A picture in place of --diffuse. See Pictures below." + where + "--tint or --diffuse shows",
    [&options](const std::string& word) { options.DiffuseTexture = word; });
  parser.Word("--base-texture", "FILE", "The same for --base",
    [&options](const std::string& word) { options.BaseTexture = word; });
  parser.Word("--specular-texture", "FILE", "The same for --specular; it shows with --ks",
    [&options](const std::string& word) { options.SpecularTexture = word; });
  parser.Word("--tint", "FILE",
    "Colours by height in place of --diffuse: a colour table of GMT (.cpt), one that QGIS exports, "
    "or a text file as for 'gdaldem color-relief'. In each "
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
      throw Failure("--layers",
        "'" + name + "' is none of " + names + "and no OpenEXR file (.exr)" +
          suggestion(name, layerNames()),
        UsageFailure);
    }
    if (std::find(options.Layers.begin(), options.Layers.end(), name) == options.Layers.end())
    {
      options.Layers.push_back(name);
    }
    list.erase(0, comma + 1);
  }
  if (file)
  {
    options.LayersFile = list;
    options.Layers = options.Layers.empty() ? usualLayerNames() : options.Layers;
  }
}

//------------------------------------------------------------------------------
void setShadowMask(const std::string& file, Options& options)
{
  if (usualScalarType(file) == VTK_FLOAT)
  {
    throw Failure("--shadow-mask",
      "'" + file + "' has no 8-bit pictures; name a TIFF or PNG, or take --layers shadow",
      UsageFailure);
  }
  options.ShadowMask = file;
}

//------------------------------------------------------------------------------
void setVerification(const std::string& words, Options& options)
{
  const std::vector<std::string> parts = split(words);
  if (parts.size() > 2)
  {
    throw Failure("--verify", "'" + words + "' was given, N or N,SEED is expected", UsageFailure);
  }
  options.VerifiedSamples = toCount("--verify", parts[0]);
  options.VerifiedSeed =
    parts.size() > 1 ? static_cast<unsigned int>(toCount("--verify", parts[1])) : 1;
}

//------------------------------------------------------------------------------
void addRunOptions(OptionParser& parser, Options& options)
{
  parser.SetGroup("Computation");
  addSceneParameters(parser, options.Scene, parameters::Group::Accuracy);
  parser.Word("--threads", "N",
    "Threads to shade with. At least 1. Default: one for each processor. The result does not "
    "depend on it",
    [&options](const std::string& word) { options.Threads = toCount("--threads", word); });
  parser.Word("--accuracy-report", "FILE.png|FILE.csv|FILE.html",
    "Measures what accuracy costs on INPUT with this scene. Error of the illumination against "
    "time, "
    "over tolerances and the thesis's fixed steps, as a chart, as numbers or as a page with both; "
    "prints which --tolerance to take. Takes some seconds, more with many lights. OUTPUT may be "
    "left out then",
    [&options](const std::string& file)
    {
      if (!isReport(file))
      {
        throw Failure("--accuracy-report",
          "'" + file + "' is none of .png, .csv and .html, which are written", UsageFailure);
      }
      options.AccuracyReport = file;
    });
  parser.Word("--verify", "N[,SEED]",
    "Retraces N random samples in double precision after shading. Prints the largest error of the "
    "illumination beside what the tolerance promises; ends with 1, and writes nothing, if that is "
    "not kept. OUTPUT may be left out then. SEED draws other samples. Default: no samples, seed 1",
    [&options](const std::string& words) { setVerification(words, options); });
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
      options.MemoryLimitGiven = true;
    });
  parser.Word("--memory", "SIZE",
    "Memory to keep to, in bytes, or with K, M, G or T behind the number. Heights that do not fit "
    "are read as they are needed, and shaded in pieces, which wait in the folder OUTPUT.parts "
    "until "
    "all are done. The picture, layers and what --verify tells are the same. A run that has been "
    "stopped goes on where it was when "
    "the same is asked for again. Default: all of the machine's, unless --memory-limit is given",
    [&options](const std::string& word) { options.Memory = toBytes("--memory", word); });
  parser.Choice("--beyond-memory",
    "What is done where even small pieces depend on more heights than fit. "
    "refuse: the run ends; bounds: the farthest heights are known by their bounds only, as few as "
    "need be, and the run ends where that may change an illumination by more than --tolerance. "
    "Default: refuse",
    { { "refuse", [&options] { options.BoundsBeyondMemory = false; } },
      { "bounds", [&options] { options.BoundsBeyondMemory = true; } } });

  parser.SetGroup("Output");
  parser.Choice("--type",
    "Which numbers OUTPUT has. uint8: sRGB-encoded, 0 to 255; float: linear; auto: float where "
    "OUTPUT is OpenEXR, Radiance HDR or PFM, else uint8. Default: auto",
    { { "auto", [&options] { options.OutputType = VTK_VOID; } },
      { "uint8", [&options] { options.OutputType = VTK_UNSIGNED_CHAR; } },
      { "float", [&options] { options.OutputType = VTK_FLOAT; } } });
  addOutputOptions(parser, options);
  parser.Word("--layers", "NAME[,NAME...]|[NAME,...]FILE.exr",
    "Writes parts of the result. As names: each beside OUTPUT, as OUTPUT's name without its "
    "extension, a hyphen and the layer's name: OpenEXR if OUTPUT is, else TIFF, 32-bit float, NaN "
    "where there is no data. As an OpenEXR file: linear colour and the layers named before it, or "
    "all, in this one file, named as compositing programs expect; OUTPUT may be left out then. "
    "illumination: share of the light that gets through; thickness: length of the first light's "
    "way inside the material; shadow: share of the first sun that the relief hides, only where it "
    "is named; normals: unit surface normals; base, diffuse, scatter, specular: linear colours "
    "that "
    "sum to the result",
    [&options](const std::string& list) { setLayers(list, options); });
  parser.Word("--shadow-mask", "FILE",
    "Writes where the relief hides the first sun, whatever the material. An 8-bit grey picture: "
    "255 in shadow, 0 in the sun, between them the share that is hidden of a sun with a width. As "
    "OUTPUT, it has the georeference and tells where there is no data; with --nodata-out value 0 "
    "says that, and 1 to 255 is what 0 to 255 was. OUTPUT may be left out",
    [&options](const std::string& file) { setShadowMask(file, options); });
  parser.Flag("--statistics",
    "Prints what was read and done. To the standard output, one 'name: value' in a line",
    options.Statistics);
  parser.Flag("--quiet",
    "No warnings and no progress bar. Only a terminal (standard error) gets the bar",
    options.Quiet);
}

//------------------------------------------------------------------------------
const char* const Usage =
  "Usage: reliefshade INPUT OUTPUT [OPTION...]\n\n"
  "Examples\n"
  "  reliefshade terrain.tif shaded.tif\n"
  "  reliefshade terrain.tif shaded.png --height-scale 2 --depth 200 --sun 315,30\n"
  "  reliefshade terrain.tif sky.png --preset sun-and-sky --texture orthophoto.tif\n"
  "  reliefshade grid.asc shaded.exr --layers illumination,normals\n"
  "  reliefshade relief.png wax.png --height-scale 0.01 --kf 0.5 --point 9,9,20\n\n"
  "Shades a height field: light, soft shadows, translucency and highlights.\n\n"
  "INPUT   heights: "
#ifdef RELIEFRASTER_USE_GDAL
  "any raster that GDAL reads (GeoTIFF, ESRI ASCII grid, ...)\n"
  "        or any grey picture that OpenImageIO reads (PNG, TIFF, OpenEXR, ...).\n"
#else
  "an ESRI ASCII grid or any grey picture that OpenImageIO\n"
  "        reads (PNG, TIFF, OpenEXR, ...); georeferences of GeoTIFF are not read by\n"
  "        this build.\n"
#endif
  "        Or a mesh, seen from one side (.obj .ply .stl .vtp .vtk .gltf .glb).\n"
  "OUTPUT  the picture, in the format of its extension; an old one is replaced.\n"
  "        Samples without data are transparent, or black where the format has no\n"
  "        transparency."
#ifdef RELIEFRASTER_USE_GDAL
  " TIFF keeps the georeference of INPUT."
#endif
  "\n"
  "        /vsistdin/ and /vsistdout/, or - for either, are the standard streams;\n"
  "        --format tells what is written to them.\n";

const char* const Footer =
  "Coordinates\n"
  "  Rasters with a georeference: x and y of --point are map coordinates in the map's own\n"
  "  unit (longitude and latitude for geographic ones), z is the scaled height in metres.\n"
  "  Pictures without: x to the right and y upward from the centre of the lower left\n"
  "  sample, z the scaled height, all in the unit of --spacing.\n"
  "Units of length\n"
  "  Metres on the ground for georeferenced rasters: map units are converted, a projection's\n"
  "  scale at the raster's centre counts if it is half a per cent off, and degrees become\n"
  "  the metres that they are along the parallel and the meridian there, on the ellipsoid.\n"
  "  Heights are taken for metres unless the file names another unit. All\n"
  "  this gives way to --spacing, which brings a unit of your own.\n"
  "Pictures\n"
  "  A picture and heights that both have a georeference lie where the map has them, whatever\n"
  "  their resolution; a picture in another coordinate reference system, or of another place,\n"
  "  is refused. Any other picture is stretched over the whole of the heights, edge to edge.\n"
  "  8 and 16 bit pictures are taken for sRGB-encoded, floating point ones for linear.\n"
  "Exit codes\n"
  "  0 done; 1 a file could not be read, shaded or written, or --verify found the\n"
  "  illumination wrong; 2 the command line was wrong; 130 interrupted. After an error a file\n"
  "  that was there before is untouched.\n";

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
  addSculptingOptions(parser, options);
  addLightOptions(parser, options);
  addMaterialOptions(parser, options);
  addPictureOptions(parser, options);
  addRunOptions(parser, options);
  addTilesOptions(parser, options);
  parser.SetGroup("Help");
  bool lists = false;
  parser.Flag("--parameters",
    "Prints the parameters of the scene that are options as JSON and ends. For programs that offer "
    "them: names, kinds, ranges, defaults, help",
    lists);
  parser.Explain(app.set_help_flag("-h,--help"), "Prints the options in short and ends");
  parser.Explain(app.set_help_all_flag("--help-all"),
    "Prints all about them and ends, as 'man reliefshade' does");
  parser.Explain(app.set_version_flag("--version", "reliefshade " RELIEFSHADE_VERSION),
    "Prints the version and ends");
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::CallForHelp&)
  {
    parser.BeBrief();
    app.get_formatter()->column_width(30);
    app.footer("reliefshade --help-all tells all about them, coordinates, units and exit codes.");
    std::cout << help(app);
    return false;
  }
  catch (const CLI::CallForAllHelp&)
  {
    std::cout << help(app);
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
    throw Failure(word,
      option ? "unknown option; see --help" +
          suggestion(word.substr(0, word.find('=')), optionNames(app))
             : "a third file; see --help",
      UsageFailure);
  }
  catch (const CLI::ParseError& error)
  {
    for (const CLI::Option* option : app.get_options())
    {
      const bool once = option->get_items_expected_max() == 1 && !option->get_trigger_on_parse();
      if (once && option->count() > 1)
      {
        throw Failure(option->get_name(), "is given more than once", UsageFailure);
      }
    }
    throw Failure("", oneLine(error.what()), UsageFailure);
  }
  if (lists)
  {
    std::cout << parameterList();
    return false;
  }
  const bool pictureless = !options.TilesFolder.empty() || !options.LayersFile.empty() ||
    (options.Layers.empty() && !options.ShadowMask.empty()) ||
    (options.Layers.empty() && (!options.AccuracyReport.empty() || options.VerifiedSamples > 0));
  if (options.Input.empty() || (options.Output.empty() && !pictureless))
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
  if (options.VerifiedSamples > 0 && options.Scene->GetIntegrator() != vtkReliefScene::Exact)
  {
    throw Failure("--verify", "fixed steps promise nothing; --integrator exact does", UsageFailure);
  }
  if (options.Times.Frames && !options.SavedScene.empty())
  {
    throw Failure("--save-scene", "a scene has one sun; --sun-at instead of --frames is expected",
      UsageFailure);
  }
  if (options.Times.Frames && !options.AccuracyReport.empty())
  {
    throw Failure("--accuracy-report",
      "it is of one scene; --sun-at instead of --frames is expected", UsageFailure);
  }
  putFramesFirst(options);
  nameStreams(options);
  checkMeshOptions(
    options.Input, options.View, options.Reading, options.Sculpted.Green.has_value());
  checkSculpting(options.Sculpted, !options.Tint.empty());
  checkNames(options);
  checkOutputOptions(options);
  placeTiles(options);
  return true;
}

}

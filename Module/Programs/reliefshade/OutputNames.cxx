// SPDX-License-Identifier: BSD-3-Clause
#include "OutputNames.h"

#include "Failure.h"
#include "Options.h"
#include "OutputFile.h"
#include "PictureOutput.h"

#include <filesystem>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
bool isTiffFormat(const std::string& format)
{
  return format.empty() || format == "gtiff" || format == "cog";
}

//------------------------------------------------------------------------------
void refuseStreams(const std::vector<NamedFile>& files, bool (*isStream)(const std::string&),
  const char* place, const char* stream)
{
  for (const NamedFile& file : files)
  {
    // "-" is a file's name there.
    if (file.Role != place && file.Name != "-" && isStream(file.Name))
    {
      throw Failure(file.Role,
        "only " + std::string(place) + " is the standard " + stream + "; expected a file",
        UsageFailure);
    }
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void nameStreams(Options& options)
{
  options.StreamsOutput = isStandardOutput(options.Output);
  if (!options.StreamsOutput && !isTiffFormat(options.Format))
  {
    throw Failure("--format",
      options.Format + " is for the standard output, /vsistdout/; of a file the extension tells",
      UsageFailure);
  }
  if (options.StreamsOutput && options.Times.Frames)
  {
    throw Failure(
      "--frames", "the standard output takes one picture; expected a file", UsageFailure);
  }
  if (options.StreamsOutput && !options.Layers.empty() && options.LayersFile.empty())
  {
    throw Failure("--layers",
      "the standard output has no files beside it; expected an OpenEXR file (.exr)", UsageFailure);
  }
  if (isStandardInput(options.Input) || options.StreamsOutput)
  {
    options.Streams = std::make_unique<StandardStreams>();
  }
  if (options.StreamsOutput)
  {
    options.Output =
      options.Streams->Reserve(isTiffFormat(options.Format) ? ".tif" : "." + options.Format);
  }
}

//------------------------------------------------------------------------------
std::string layerFile(const std::string& picture, const std::string& layer)
{
  const std::filesystem::path output(picture);
  const std::string extension = lowerExtension(picture) == ".exr" ? ".exr" : ".tif";
  return (output.parent_path() / (output.stem().string() + "-" + layer + extension)).string();
}

//------------------------------------------------------------------------------
void checkNames(const Options& options)
{
  std::vector<NamedFile> inputs;
  std::vector<NamedFile> outputs;
  const auto add = [](std::vector<NamedFile>& files, const std::string& name, const char* role)
  {
    if (!name.empty())
    {
      files.push_back({ name, role });
    }
  };
  add(inputs, isStandardInput(options.Input) ? fileOfStream(0) : options.Input, "INPUT");
  add(inputs, options.Mask, "--mask");
  add(inputs, options.SceneFile, "--scene");
  add(inputs, options.SceneEnvironment, "the environment of --scene");
  add(inputs, options.Environment, "--env");
  add(inputs, options.DiffuseTexture, "--texture");
  add(inputs, options.BaseTexture, "--base-texture");
  add(inputs, options.SpecularTexture, "--specular-texture");
  add(inputs, options.Tint, "--tint");
  for (int frame = 0; frame < frameCount(options); ++frame)
  {
    add(outputs, frameFile(options, options.Output, frame), "OUTPUT");
    add(outputs, frameFile(options, options.LayersFile, frame), "--layers");
    add(outputs, frameFile(options, options.ShadowMask, frame), "--shadow-mask");
    for (const std::string& layer : options.LayersFile.empty() ? options.Layers : LayerNames())
    {
      add(outputs, layerFile(frameFile(options, options.Output, frame), layer), "--layers");
    }
  }
  add(outputs, options.SavedScene, "--save-scene");
  add(outputs, options.AccuracyReport, "--accuracy-report");
  refuseStreams(inputs, isStandardInput, "INPUT", "input");
  refuseStreams(outputs, isStandardOutput, "OUTPUT", "output");
  add(outputs, options.StreamsOutput ? options.Streams->GetFile() : std::string(), "OUTPUT");
  keepApart(inputs, outputs);
}

}

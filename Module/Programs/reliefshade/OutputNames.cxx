// SPDX-License-Identifier: BSD-3-Clause
#include "OutputNames.h"

#include "Options.h"
#include "OutputFile.h"
#include "PictureOutput.h"

#include <filesystem>

namespace reliefshade
{

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
  add(inputs, options.Input, "INPUT");
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
  keepApart(inputs, outputs);
}

}

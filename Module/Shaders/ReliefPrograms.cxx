// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefPrograms.h"

#include "ReliefComposeFS.h"
#include "ReliefFieldGLSL.h"
#include "ReliefGatherFS.h"
#include "ReliefGridGLSL.h"
#include "ReliefLeavesGLSL.h"
#include "ReliefLightGLSL.h"
#include "ReliefModelGLSL.h"
#include "ReliefPreludeGLSL.h"
#include "ReliefSurfaceGLSL.h"
#include "ReliefSurroundingsGLSL.h"
#include "ReliefThicknessGLSL.h"
#include "ReliefTraceFS.h"

#include <sstream>
#include <stdexcept>
#include <vector>

namespace relief
{

namespace
{

using Features = std::set<std::string>;

void Add(Features& features, const char* name, bool wanted)
{
  if (wanted)
  {
    features.insert(name);
  }
}

void AddLayout(Features& features, const FieldLayout& layout)
{
  Add(features, "TiledHeights", layout.tiledHeights);
  Add(features, "TiledBounds", layout.tiledBounds);
  Add(features, "Tiled", layout.tiledHeights || layout.tiledBounds);
}

void AddLight(Features& features, const LightFeatures& light)
{
  Add(features, "Positional", light.positional);
  Add(features, "SurfaceNormal", light.surfaceNormal);
  Add(features, "TangentPlane", light.tangentPlane);
  Add(features, "Exponential", light.exponential);
  Add(features, "Floor", light.floor);
  Add(features, "Deep", light.deep);
  Add(features, "FixedStep", light.fixedStep);
  Add(features, "Combined", light.combined);
  Add(features, "Igor", light.igor);
}

void AddSums(Features& features, const SumFeatures& sums)
{
  Add(features, "Diffuse", sums.diffuse);
  Add(features, "Scatter", sums.scatter);
  Add(features, "Specular", sums.specular);
}

// VTK's shader cache puts the version and the outputs where these lines are.
const char* const Header = "//VTK::System::Dec\n//VTK::Output::Dec\n";

}

std::string SelectLines(const std::string& text, const Features& features)
{
  const std::string mark = "//RELIEF::";
  std::vector<bool> kept; // of the enclosing conditions
  auto all = [&kept]()
  {
    bool keep = true;
    for (bool one : kept)
    {
      keep = keep && one;
    }
    return keep;
  };
  std::istringstream lines(text);
  std::string line;
  std::string result;
  while (std::getline(lines, line))
  {
    const std::size_t at = line.find(mark);
    if (at == std::string::npos)
    {
      result += all() ? line + "\n" : std::string();
      continue;
    }
    std::istringstream words(line.substr(at + mark.size()));
    std::string what;
    std::string name;
    words >> what >> name;
    if (what == "If" && !name.empty())
    {
      kept.push_back(features.count(name) > 0);
    }
    else if (what == "Else" && !kept.empty())
    {
      kept.back() = !kept.back();
    }
    else if (what == "End" && !kept.empty())
    {
      kept.pop_back();
    }
    else
    {
      throw std::logic_error("in a shader: " + line);
    }
  }
  if (!kept.empty())
  {
    throw std::logic_error("in a shader: //RELIEF::End is missing");
  }
  return result;
}

std::string TraceProgram(const FieldLayout& layout, const LightFeatures& light)
{
  Features features;
  AddLayout(features, layout);
  AddLight(features, light);
  Add(features, "Normals", light.surfaceNormal || light.combined || light.igor);
  return Header + std::string(ReliefPreludeGLSL) + SelectLines(ReliefFieldGLSL, features) +
    ReliefLeavesGLSL + ReliefModelGLSL + ReliefSurfaceGLSL + ReliefSurroundingsGLSL +
    ReliefThicknessGLSL + ReliefGridGLSL + SelectLines(ReliefLightGLSL, features) +
    SelectLines(ReliefTraceFS, features);
}

std::string GatherProgram(
  const FieldLayout& layout, const LightFeatures& light, const SumFeatures& sums, int lights)
{
  Features features;
  AddLayout(features, layout);
  AddSums(features, sums);
  const bool needsRay = sums.NeedsDirection() && light.positional;
  const bool needsNormal = sums.specular || (needsRay && light.surfaceNormal);
  Add(features, "Illumination", sums.NeedsIllumination());
  Add(features, "Direction", sums.NeedsDirection());
  Add(features, "Normals", needsNormal);
  // Where there is no data there is no surface, but what the sums hold there shows nowhere.
  Add(features, "Surface", needsNormal || needsRay);
  Add(features, "Second", lights > 1);
  Add(features, "Third", lights > 2);
  Add(features, "Fourth", lights > 3);
  Add(features, "Positional", needsRay);
  Add(features, "SurfaceNormal", light.surfaceNormal);
  Add(features, "TangentPlane", light.tangentPlane);

  std::string text = Header + ("#define LIGHTS " + std::to_string(lights) + "\n");
  int output = 0;
  auto addOutput = [&](const char* name, bool wanted)
  {
    if (wanted)
    {
      text += "#define " + std::string(name) + " gl_FragData[" + std::to_string(output++) + "]\n";
    }
  };
  addOutput("DIFFUSE_SUM", sums.diffuse);
  addOutput("SCATTER_SUM", sums.scatter);
  addOutput("SPECULAR_SUM", sums.specular);
  text +=
    ReliefPreludeGLSL + SelectLines(ReliefFieldGLSL, features) + ReliefLeavesGLSL + ReliefModelGLSL;
  text += needsRay || needsNormal ? ReliefSurfaceGLSL : "";
  text += needsRay ? ReliefSurroundingsGLSL + std::string(ReliefThicknessGLSL) : "";
  text += ReliefGridGLSL;
  text += needsRay ? SelectLines(ReliefLightGLSL, features) : std::string();
  return text + SelectLines(ReliefGatherFS, features);
}

std::string ComposeProgram(const FieldLayout& layout, const ComposeFeatures& compose)
{
  Features features;
  AddLayout(features, layout);
  AddSums(features, compose.sums);
  Add(features, "DiffuseColor", compose.sums.NeedsIllumination());
  Add(features, "First", compose.first && compose.sums.Any());
  Add(features, "Later", compose.later && compose.sums.Any());
  Add(features, "BaseTexture", compose.baseTexture);
  Add(features, "DiffuseTexture", compose.diffuseTexture);
  Add(features, "SpecularTexture", compose.specularTexture);
  return Header + std::string(ReliefPreludeGLSL) + SelectLines(ReliefFieldGLSL, features) +
    ReliefLeavesGLSL + ReliefModelGLSL + ReliefGridGLSL + SelectLines(ReliefComposeFS, features);
}

std::string EncodingFunctions()
{
  return std::string(ReliefPreludeGLSL) + ReliefLeavesGLSL + ReliefModelGLSL;
}

}

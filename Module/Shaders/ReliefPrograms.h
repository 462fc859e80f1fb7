// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefPrograms_h
#define ReliefPrograms_h

#include <set>
#include <string>

/// @file
/// The texts of the shading programs: each holds what a scene calls for and nothing else. No OpenGL
/// here.
///
/// The files in Module/Shaders have lines `//RELIEF::If Name`, `//RELIEF::Else` and
/// `//RELIEF::End`, which keep or drop the lines between them.

namespace relief
{

/// How the heights lie in textures.
struct FieldLayout
{
  bool tiledHeights = false;
  bool tiledBounds = false;
  bool operator==(const FieldLayout& other) const
  {
    return this->tiledHeights == other.tiledHeights && this->tiledBounds == other.tiledBounds;
  }
};

/// What the ray toward a light depends on.
struct LightFeatures
{
  bool positional = false;
  bool surfaceNormal = false;
  bool tangentPlane = false;
  bool exponential = false;
  bool floor = false;
  bool deep = false; ///< there is no limit at depth 0 to be found, which is half of the program
  bool fixedStep = false;
  bool combined = false; ///< the surface's answer stands for its illumination
  bool igor = false;
};

/// Which sums over lights a scene needs.
struct SumFeatures
{
  bool diffuse = false;
  bool scatter = false;
  bool specular = false;
  bool Any() const { return this->diffuse || this->scatter || this->specular; }
  bool NeedsIllumination() const { return this->diffuse || this->scatter; }
  bool NeedsDirection() const { return this->scatter || this->specular; }
  bool operator==(const SumFeatures& other) const
  {
    return this->diffuse == other.diffuse && this->scatter == other.scatter &&
      this->specular == other.specular;
  }
};

/// What the colours are made of.
struct ComposeFeatures
{
  SumFeatures sums;
  bool first = false; ///< sums over the first lights
  bool later = false; ///< sums over the rest
  bool baseTexture = false;
  bool diffuseTexture = false;
  bool specularTexture = false;
};

/// How many lights a program for gathering adds at once, at most; of those whose direction it must
/// find at each sample, one.
constexpr int MostGathered = 4;

/// Fragment programs in GLSL 1.50, as vtkOpenGLShaderCache takes them.
///@{
std::string TraceProgram(const FieldLayout& layout, const LightFeatures& light);
std::string GatherProgram(
  const FieldLayout& layout, const LightFeatures& light, const SumFeatures& sums, int lights = 1);
std::string ComposeProgram(const FieldLayout& layout, const ComposeFeatures& compose);
///@}

/// The functions of the model that encode colours for the screen, for use in another program.
std::string EncodingFunctions();

/// Keeps of a text what the features ask for. Throws std::logic_error where its lines do not match.
std::string SelectLines(const std::string& text, const std::set<std::string>& features);

}

#endif

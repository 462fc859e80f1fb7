// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneParameters_h
#define SceneParameters_h

/// @file
/// Every parameter of a scene, its material, its environment and its lights, once. Setters,
/// printing, copies, scene files, headers of OpenEXR files, options of reliefshade, fields of
/// reliefviewer and Python's list are made from this table. Not installed.

#include "vtkIndent.h"
#include "vtkReliefShadingModule.h" // For export macro

#include "UsualLight.h"

#include <array>
#include <functional>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

class vtkObject;

namespace relief::parameters
{
/// What a parameter belongs to.
enum class Owner
{
  Scene,
  Material,
  Environment,
  Light
};

/// A Length may be infinite. A Range is two numbers, the first not the larger.
enum class Kind
{
  Number,
  Length,
  Count,
  Flag,
  Color,
  Range,
  Choice
};

/// What belongs together for whoever sets it.
enum class Group
{
  Relief,
  Lights,
  Environment,
  Highlights,
  Backlight,
  Accuracy
};

/// The value of any parameter: as many numbers as its kind has, 1 or 0 for a flag, a choice's
/// place.
using Values = std::array<double, 3>;

struct Interval
{
  double Least = -std::numeric_limits<double>::infinity();
  double Greatest = std::numeric_limits<double>::infinity();
  bool Open = false; // Least itself is not in it
};

/// One of the values of a Choice.
struct Choice
{
  const char* Name;  // as the enumerator's, and as files have it
  std::string Word;  // on the command line
  std::string Label; // for people
};

struct Parameter
{
  Owner Of = Owner::Scene;
  Kind Is = Kind::Number;
  /// As the setter's, behind its Set.
  const char* Name = "";
  /// In files.
  std::string Key;
  /// Empty for a number without one.
  const char* Unit = "";
  Values Default{ 0.0, 0.0, 0.0 };
  /// For each of its numbers.
  Interval Taken;
  std::vector<Choice> Choices;
  /// A sentence without its full stop.
  const char* Help = "";
  Group In = Group::Relief;
  const char* Label = "";
  /// Of a slider: its ends, and the power that makes it finer near its beginning.
  double SliderFrom = 0.0;
  double SliderTo = 1.0;
  double SliderPower = 1.0;
  /// Of reliefshade, and what its help calls the value. Null: no option of its own.
  const char* Option = nullptr;
  const char* OptionValue = "";
  /// It counts only while this other parameter of the same owner, a Choice or a Flag, has this
  /// value.
  const char* With = nullptr;
  int WithValue = 0;
  /// Of a light: it means nothing for one at a place.
  bool OfSuns = false;

  std::function<Values(vtkObject*)> Get;
  std::function<void(vtkObject*, const Values&)> Set;
};

using relief::UsualAltitude;
using relief::UsualAzimuth;
using relief::UsualIntensity;
using relief::UsualTurbidity;

/// In the order of files.
VTKRELIEFSHADING_EXPORT const std::vector<Parameter>& All();
VTKRELIEFSHADING_EXPORT std::vector<const Parameter*> Of(Owner owner);
/// The parameter must be there.
VTKRELIEFSHADING_EXPORT const Parameter& Find(Owner owner, const std::string& name);

VTKRELIEFSHADING_EXPORT const char* NameOf(Owner owner);
VTKRELIEFSHADING_EXPORT const char* NameOf(Kind kind);
VTKRELIEFSHADING_EXPORT const char* NameOf(Group group);
/// Of vtkReliefEnvironment::ImageSources, as printed. As a key: NameAsKey.
VTKRELIEFSHADING_EXPORT const std::vector<const char*>& ImageSourceNames();
VTKRELIEFSHADING_EXPORT std::string NameAsKey(const std::string& name);

/// How many numbers it is.
VTKRELIEFSHADING_EXPORT int Size(const Parameter& parameter);
/// Whether it counts, as its With and OfSuns tell.
VTKRELIEFSHADING_EXPORT bool Counts(const Parameter& parameter, vtkObject* owner);
/// Whether two words are one, in any spelling: FixedStep is fixed-step and fixed step.
VTKRELIEFSHADING_EXPORT bool SameWord(const std::string& one, const std::string& other);
/// The place of a Choice's value by any of its names; -1 for another word.
VTKRELIEFSHADING_EXPORT int FindChoice(const Parameter& parameter, const std::string& word);
/// A value as part of a sentence.
VTKRELIEFSHADING_EXPORT std::string Text(const Parameter& parameter, const Values& values);

/// Why a value is not taken. A sentence is made of it where it is shown.
struct Refusal
{
  std::string What;     // the parameter's name
  std::string Given;    // the value
  std::string Expected; // "a number in [0, 1] is expected"
  std::string Reason() const { return this->Given + " was given, " + this->Expected; }
};

/// Nothing if the parameter takes the value.
VTKRELIEFSHADING_EXPORT std::optional<Refusal> Check(
  const Parameter& parameter, const Values& values);
/// What vtkReliefScene::AddSun, SetLightsToSunAndSky and vtkReliefEnvironment::SetImageToClearSky
/// take, in degrees.
VTKRELIEFSHADING_EXPORT std::optional<Refusal> CheckSun(
  double azimuth, double altitude, double angularDiameter);
VTKRELIEFSHADING_EXPORT std::optional<Refusal> CheckSunAndSky(double azimuth, double altitude);
VTKRELIEFSHADING_EXPORT std::optional<Refusal> CheckClearSky(
  double azimuth, double altitude, double turbidity);

/// The bodies of setters. A value that the table does not take is refused with one error, and the
/// old one stays; another value than the old one marks the object as modified.
VTKRELIEFSHADING_EXPORT void Set(vtkObject* owner, double& member, double value, const char* name);
VTKRELIEFSHADING_EXPORT void Set(vtkObject* owner, int& member, int value, const char* name);
VTKRELIEFSHADING_EXPORT void Set(
  vtkObject* owner, double (&member)[2], const Values& value, const char* name);
VTKRELIEFSHADING_EXPORT void Set(
  vtkObject* owner, double (&member)[3], const Values& value, const char* name);

/// All parameters of an object: a scene, material, environment or light.
VTKRELIEFSHADING_EXPORT void SetDefaults(vtkObject* owner);
VTKRELIEFSHADING_EXPORT void Copy(vtkObject* from, vtkObject* to);
VTKRELIEFSHADING_EXPORT bool Same(vtkObject* a, vtkObject* b);
VTKRELIEFSHADING_EXPORT void Print(vtkObject* owner, std::ostream& os, vtkIndent indent);
}

#endif

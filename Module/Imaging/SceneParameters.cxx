// SPDX-License-Identifier: BSD-3-Clause
#include "SceneParameters.h"

#include "vtkLight.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace relief::parameters
{
namespace
{
//------------------------------------------------------------------------------
Owner OwnerOf(vtkObject* object)
{
  return vtkReliefMaterial::SafeDownCast(object) ? Owner::Material
    : vtkReliefScene::SafeDownCast(object)       ? Owner::Scene
    : vtkReliefEnvironment::SafeDownCast(object) ? Owner::Environment
                                                 : Owner::Light;
}

std::string NumberText(double value)
{
  std::ostringstream text;
  if (std::abs(value) < 1e15 && value == std::floor(value))
  {
    text << static_cast<long long>(value); // 1000000, not 1e+06
  }
  else
  {
    text << value;
  }
  return text.str();
}

bool IsIn(double value, const Interval& interval)
{
  return (interval.Open ? value > interval.Least : value >= interval.Least) &&
    value <= interval.Greatest;
}

// What the values of a parameter are, as part of a message.
std::string Expectation(const Parameter& parameter)
{
  const Interval& taken = parameter.Taken;
  switch (parameter.Is)
  {
    case Kind::Choice:
    {
      std::string names;
      const std::size_t count = parameter.Choices.size();
      for (std::size_t i = 0; i < count; ++i)
      {
        names += i == 0 ? "" : i + 1 < count ? ", " : " or ";
        names += parameter.Choices[i].Name + (" (" + std::to_string(i) + ")");
      }
      return names + " is expected";
    }
    case Kind::Color:
      return std::isfinite(taken.Least)
        ? "finite components of at least " + NumberText(taken.Least) + " are expected"
        : std::string("finite components are expected");
    case Kind::Range:
      return "two finite numbers of which the first is not the larger are expected";
    default:
      break;
  }
  const std::string least = NumberText(taken.Least);
  if (std::isfinite(taken.Least) && std::isfinite(taken.Greatest))
  {
    return "a number in [" + least + ", " + NumberText(taken.Greatest) + "] is expected";
  }
  const std::string number = parameter.Is == Kind::Length ? "a number" : "a finite number";
  return number +
    (!std::isfinite(taken.Least) ? ""
        : taken.Open             ? " above " + least
                                 : " of at least " + least) +
    " is expected";
}

//------------------------------------------------------------------------------
// Whether a setter may go on; else it has said why not.
bool Accept(vtkObject* owner, const Parameter& parameter, const Values& old, const Values& value)
{
  const std::optional<Refusal> refusal = Check(parameter, value);
  if (refusal)
  {
    vtkErrorWithObjectMacro(owner,
      "Set" << refusal->What << ": " << refusal->Reason() << "; " << Text(parameter, old)
            << " is kept.");
  }
  return !refusal && value != old;
}

template <int Size>
void SetArray(vtkObject* owner, double (&member)[Size], const Values& value, const char* name)
{
  Values old{ 0.0, 0.0, 0.0 };
  std::copy_n(member, Size, old.begin());
  if (Accept(owner, Find(OwnerOf(owner), name), old, value))
  {
    std::copy_n(value.begin(), Size, member);
    owner->Modified();
  }
}
}

//------------------------------------------------------------------------------
std::vector<const Parameter*> Of(Owner owner)
{
  std::vector<const Parameter*> rows;
  for (const Parameter& parameter : All())
  {
    if (parameter.Of == owner)
    {
      rows.push_back(&parameter);
    }
  }
  return rows;
}

//------------------------------------------------------------------------------
const Parameter& Find(Owner owner, const std::string& name)
{
  for (const Parameter& parameter : All())
  {
    if (parameter.Of == owner && parameter.Name == name)
    {
      return parameter;
    }
  }
  throw std::logic_error("there is no parameter " + name);
}

//------------------------------------------------------------------------------
const char* NameOf(Owner owner)
{
  static const char* const names[] = { "Scene", "Material", "Environment", "Light" };
  return names[static_cast<int>(owner)];
}

//------------------------------------------------------------------------------
const char* NameOf(Kind kind)
{
  static const char* const names[] = { "number", "length", "count", "flag", "color", "range",
    "choice" };
  return names[static_cast<int>(kind)];
}

const char* NameOf(Group group)
{
  static const char* const names[] = { "Relief", "Lights", "Environment", "Highlights", "Backlight",
    "Accuracy" };
  return names[static_cast<int>(group)];
}

//------------------------------------------------------------------------------
const std::vector<const char*>& ImageSourceNames()
{
  static const std::vector<const char*> names = { "UserImage", "WhiteDome", "ClearSky", "File" };
  return names;
}

//------------------------------------------------------------------------------
std::string NameAsKey(const std::string& name)
{
  std::string key = name;
  key[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(key[0])));
  return key;
}

//------------------------------------------------------------------------------
int Size(const Parameter& parameter)
{
  return parameter.Is == Kind::Color ? 3 : parameter.Is == Kind::Range ? 2 : 1;
}

//------------------------------------------------------------------------------
bool Counts(const Parameter& parameter, vtkObject* owner)
{
  return parameter.OfSuns
    ? !static_cast<vtkLight*>(owner)->GetPositional()
    : !parameter.With || Find(parameter.Of, parameter.With).Get(owner)[0] == parameter.WithValue;
}

//------------------------------------------------------------------------------
std::string Text(const Parameter& parameter, const Values& values)
{
  switch (parameter.Is)
  {
    case Kind::Flag:
      return values[0] != 0.0 ? "On" : "Off";
    case Kind::Choice:
      return values[0] >= 0.0 && values[0] < static_cast<double>(parameter.Choices.size())
        ? parameter.Choices[static_cast<std::size_t>(values[0])].Name
        : NumberText(values[0]);
    case Kind::Color:
      return "(" + NumberText(values[0]) + ", " + NumberText(values[1]) + ", " +
        NumberText(values[2]) + ")";
    case Kind::Range:
      return "(" + NumberText(values[0]) + ", " + NumberText(values[1]) + ")";
    default:
      return NumberText(values[0]);
  }
}

//------------------------------------------------------------------------------
bool SameWord(const std::string& one, const std::string& other)
{
  const auto plain = [](const std::string& word)
  {
    std::string letters;
    for (const char c : word)
    {
      letters += c == '-' || c == '_' || c == ' '
        ? std::string()
        : std::string(1, static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
    }
    return letters;
  };
  return plain(one) == plain(other);
}

//------------------------------------------------------------------------------
int FindChoice(const Parameter& parameter, const std::string& word)
{
  const auto& choices = parameter.Choices;
  const auto found = std::find_if(choices.begin(), choices.end(),
    [&word](const Choice& choice)
    { return SameWord(choice.Name, word) || SameWord(choice.Word, word); });
  return found == choices.end() ? -1 : static_cast<int>(found - choices.begin());
}

//------------------------------------------------------------------------------
std::optional<Refusal> Check(const Parameter& parameter, const Values& values)
{
  bool good = true;
  for (int i = 0; i < Size(parameter); ++i)
  {
    good = good && IsIn(values[i], parameter.Taken) &&
      (std::isfinite(values[i]) || parameter.Is == Kind::Length);
  }
  if (parameter.Is == Kind::Choice)
  {
    good = good && values[0] >= 0.0 && values[0] < static_cast<double>(parameter.Choices.size());
  }
  good = good && (parameter.Is != Kind::Range || values[0] <= values[1]);
  return good ? std::nullopt
              : std::make_optional(
                  Refusal{ parameter.Name, Text(parameter, values), Expectation(parameter) });
}

//------------------------------------------------------------------------------
std::optional<Refusal> CheckSun(double azimuth, double altitude, double angularDiameter)
{
  if (std::isfinite(azimuth) && std::abs(altitude) <= 90.0 &&
    !Check(Find(Owner::Light, "AngularDiameter"), { angularDiameter, 0.0, 0.0 }))
  {
    return std::nullopt;
  }
  return Refusal{ "Sun",
    "azimuth " + NumberText(azimuth) + ", altitude " + NumberText(altitude) +
      ", angular diameter " + NumberText(angularDiameter),
    "a finite azimuth, an altitude in [-90, 90] and a diameter in [0, 90] degrees are expected" };
}

//------------------------------------------------------------------------------
std::optional<Refusal> CheckSunAndSky(double azimuth, double altitude)
{
  if (std::isfinite(azimuth) && altitude >= 0.0 && altitude <= 90.0)
  {
    return std::nullopt;
  }
  return Refusal{ "SunAndSky",
    "azimuth " + NumberText(azimuth) + ", altitude " + NumberText(altitude),
    "a finite azimuth and an altitude in [0, 90] degrees are expected" };
}

//------------------------------------------------------------------------------
std::optional<Refusal> CheckClearSky(double azimuth, double altitude, double turbidity)
{
  if (!CheckSunAndSky(azimuth, altitude) && turbidity >= 2.0 && turbidity <= 10.0)
  {
    return std::nullopt;
  }
  return Refusal{ "ClearSky",
    "azimuth " + NumberText(azimuth) + ", altitude " + NumberText(altitude) + ", turbidity " +
      NumberText(turbidity),
    "a finite azimuth, an altitude in [0, 90] degrees and a turbidity in [2, 10] are expected" };
}

//------------------------------------------------------------------------------
void Set(vtkObject* owner, double& member, double value, const char* name)
{
  if (Accept(owner, Find(OwnerOf(owner), name), { member, 0.0, 0.0 }, { value, 0.0, 0.0 }))
  {
    member = value;
    owner->Modified();
  }
}

//------------------------------------------------------------------------------
void Set(vtkObject* owner, int& member, int value, const char* name)
{
  if (Accept(
        owner, Find(OwnerOf(owner), name), { 1.0 * member, 0.0, 0.0 }, { 1.0 * value, 0.0, 0.0 }))
  {
    member = value;
    owner->Modified();
  }
}

//------------------------------------------------------------------------------
void Set(vtkObject* owner, double (&member)[2], const Values& value, const char* name)
{
  SetArray(owner, member, value, name);
}

//------------------------------------------------------------------------------
void Set(vtkObject* owner, double (&member)[3], const Values& value, const char* name)
{
  SetArray(owner, member, value, name);
}

//------------------------------------------------------------------------------
void SetDefaults(vtkObject* owner)
{
  for (const Parameter* parameter : Of(OwnerOf(owner)))
  {
    parameter->Set(owner, parameter->Default);
  }
}

//------------------------------------------------------------------------------
void Copy(vtkObject* from, vtkObject* to)
{
  for (const Parameter* parameter : Of(OwnerOf(from)))
  {
    parameter->Set(to, parameter->Get(from));
  }
}

//------------------------------------------------------------------------------
bool Same(vtkObject* a, vtkObject* b)
{
  const std::vector<const Parameter*> rows = Of(OwnerOf(a));
  return std::all_of(rows.begin(), rows.end(),
    [a, b](const Parameter* parameter) { return parameter->Get(a) == parameter->Get(b); });
}

//------------------------------------------------------------------------------
void Print(vtkObject* owner, std::ostream& os, vtkIndent indent)
{
  for (const Parameter* parameter : Of(OwnerOf(owner)))
  {
    os << indent << parameter->Name << ": " << Text(*parameter, parameter->Get(owner)) << "\n";
  }
}
}

// SPDX-License-Identifier: BSD-3-Clause

// The table of parameters: a row for each, in the order of files.

#include "SceneParameters.h"

#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <cctype>

namespace relief::parameters
{
namespace
{
using M = vtkReliefMaterial;
using S = vtkReliefScene;
using E = vtkReliefEnvironment;

constexpr double Infinity = std::numeric_limits<double>::infinity();

Owner OwnerOf(const M*)
{
  return Owner::Material;
}
Owner OwnerOf(const S*)
{
  return Owner::Scene;
}
Owner OwnerOf(const E*)
{
  return Owner::Environment;
}
Owner OwnerOf(const vtkLight*)
{
  return Owner::Light;
}

// Words from a name of several: FixedStep is fixed-step, and Fixed step.
std::string Spaced(const std::string& name, char space)
{
  std::string words;
  for (const char c : name)
  {
    const bool begins = std::isupper(static_cast<unsigned char>(c)) && !words.empty();
    words += begins ? std::string(1, space) : std::string();
    words += begins ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : c;
  }
  return words;
}

std::string Word(const std::string& name)
{
  return NameAsKey(Spaced(name, '-'));
}

Interval Between(double least, double greatest)
{
  return { least, greatest, false };
}
Interval AtLeast(double least)
{
  return { least, Infinity, false };
}
Interval Above(double least)
{
  return { least, Infinity, true };
}

//------------------------------------------------------------------------------
/// Fills a row of the table, one column after the other.
class Row : public Parameter
{
public:
  Row(Owner owner, Kind kind, const char* name)
  {
    this->Of = owner;
    this->Is = kind;
    this->Name = name;
    this->Key = NameAsKey(name);
    this->Taken = kind == Kind::Flag ? Between(0.0, 1.0)
      : kind == Kind::Color          ? AtLeast(0.0)
                                     : Interval();
  }
  Row& Keyed(const char* key)
  {
    this->Key = key;
    return *this;
  }
  Row& InUnit(const char* unit)
  {
    this->Unit = unit;
    return *this;
  }
  Row& Usually(double a, double b = 0.0, double c = 0.0)
  {
    this->Default = { a, b, c };
    return *this;
  }
  Row& Takes(const Interval& interval)
  {
    this->Taken = interval;
    return *this;
  }
  Row& Among(const std::vector<Choice>& choices)
  {
    this->Choices = choices;
    this->Taken = Between(0.0, static_cast<double>(choices.size()) - 1.0);
    for (Choice& choice : this->Choices)
    {
      choice.Word = choice.Word.empty() ? Word(choice.Name) : choice.Word;
      choice.Label = choice.Label.empty() ? Spaced(choice.Name, ' ') : choice.Label;
    }
    return *this;
  }
  Row& Means(const char* help)
  {
    this->Help = help;
    return *this;
  }
  Row& Field(Group group, const char* label)
  {
    this->In = group;
    this->Label = label;
    return *this;
  }
  Row& Slides(double from, double to, double power = 1.0)
  {
    this->SliderFrom = from;
    this->SliderTo = to;
    this->SliderPower = power;
    return *this;
  }
  Row& OnCommandLine(const char* option, const char* value = "")
  {
    this->Option = option;
    this->OptionValue = value;
    return *this;
  }
  Row& CountsWith(const char* other, int value)
  {
    this->With = other;
    this->WithValue = value;
    return *this;
  }
};

//------------------------------------------------------------------------------
// Rows by the methods of their class. What is set is of the type that is got.
template <class T, class Get, class Number>
Row Single(Kind kind, const char* name, Get get, void (T::*set)(Number))
{
  Row row(OwnerOf(static_cast<T*>(nullptr)), kind, name);
  row.Get = [get](vtkObject* owner) {
    return Values{ static_cast<double>((static_cast<T*>(owner)->*get)()), 0.0, 0.0 };
  };
  row.Set = [set](vtkObject* owner, const Values& v)
  { (static_cast<T*>(owner)->*set)(static_cast<Number>(v[0])); };
  return row;
}

template <class T>
Row Color(const char* name, double* (T::*get)(), void (T::*set)(double, double, double))
{
  Row row(OwnerOf(static_cast<T*>(nullptr)), Kind::Color, name);
  row.Get = [get](vtkObject* owner)
  {
    const double* v = (static_cast<T*>(owner)->*get)();
    return Values{ v[0], v[1], v[2] };
  };
  row.Set = [set](vtkObject* owner, const Values& v)
  { (static_cast<T*>(owner)->*set)(v[0], v[1], v[2]); };
  return row;
}

template <class T>
Row Range(const char* name, double* (T::*get)(), void (T::*set)(double, double))
{
  Row row(OwnerOf(static_cast<T*>(nullptr)), Kind::Range, name);
  row.Get = [get](vtkObject* owner)
  {
    const double* v = (static_cast<T*>(owner)->*get)();
    return Values{ v[0], v[1], 0.0 };
  };
  row.Set = [set](vtkObject* owner, const Values& v)
  { (static_cast<T*>(owner)->*set)(v[0], v[1]); };
  return row;
}

//------------------------------------------------------------------------------
void SetAngularDiameter(vtkLight* light, double degrees)
{
  if (vtkReliefScene::GetAngularDiameter(light) != degrees)
  {
    if (!light->GetInformation())
    {
      vtkNew<vtkInformation> information;
      light->SetInformation(information);
    }
    light->GetInformation()->Set(vtkReliefScene::ANGULAR_DIAMETER(), degrees);
    light->Modified();
  }
}

//------------------------------------------------------------------------------
std::vector<Parameter> SceneRows()
{
  return {
    Single(Kind::Number, "HeightScale", &S::GetHeightScale, &S::SetHeightScale)
      .InUnit("spacing per height")
      .Usually(1.0)
      .Field(Group::Relief, "Height scale")
      .Slides(0.0, 10.0, 3.0)
      .OnCommandLine("--height-scale", "F")
      .Means("What heights are multiplied by; negative values turn the relief inside out"),
    Single(Kind::Choice, "Integrator", &S::GetIntegrator, &S::SetIntegrator)
      .Among({ { "Exact", "", "" }, { "FixedStep", "", "Fixed steps" } })
      .Usually(S::Exact)
      .Field(Group::Accuracy, "Integrator")
      .OnCommandLine("--integrator")
      .Means("Thickness in closed form, or from a fixed number of points along each ray, as the "
             "model was first published"),
    Single(Kind::Number, "Tolerance", &S::GetTolerance, &S::SetTolerance)
      .Takes(AtLeast(0.0))
      .Usually(0.0003)
      .Field(Group::Accuracy, "Tolerance")
      .Slides(0.0, 0.1, 3.0)
      .OnCommandLine("--tolerance", "E")
      .CountsWith("Integrator", S::Exact)
      .Means("How far exact's illumination, 0 to 1, may be off; more is quicker"),
    Single(Kind::Count, "NumberOfSteps", &S::GetNumberOfSteps, &S::SetNumberOfSteps)
      .Takes(Between(1.0, 1000000.0))
      .Usually(256.0)
      .Field(Group::Accuracy, "Steps")
      .Slides(1.0, 2048.0, 2.0)
      .OnCommandLine("--steps", "N")
      .CountsWith("Integrator", S::FixedStep)
      .Means("Points along a ray of fixed-step"),
    Single(Kind::Choice, "Response", &S::GetResponse, &S::SetResponse)
      .Among({ { "Illumination", "", "" }, { "Combined", "", "" }, { "Igor", "", "" } })
      .Usually(S::Illumination)
      .Field(Group::Lights, "Response")
      .OnCommandLine("--response")
      .Means("How a surface answers light: by the share that reaches it; or darker the steeper it "
             "is and the less light comes, or the farther it faces away on the map"),
    Single(Kind::Count, "NumberOfSunSamples", &S::GetNumberOfSunSamples, &S::SetNumberOfSunSamples)
      .Takes(Between(1.0, 4096.0))
      .Usually(16.0)
      .Field(Group::Lights, "Sun samples")
      .Slides(1.0, 128.0, 2.0)
      .OnCommandLine("--sun-samples", "N")
      .Means("How many lights stand for a sun that has a diameter; each is traced"),
    // In this order: setting an exposure turns the automatic one off.
    Single(Kind::Number, "Exposure", &S::GetExposure, &S::SetExposure)
      .InUnit("stops")
      .Takes(Between(-20.0, 20.0))
      .Field(Group::Lights, "Exposure")
      .Slides(-4.0, 4.0)
      .OnCommandLine("--exposure", "EV|auto")
      .Means("Brightens 8-bit pictures and the screen by so many doublings, and leaves float "
             "output alone"),
    Single(Kind::Flag, "AutomaticExposure", &S::GetAutomaticExposure, &S::SetAutomaticExposure)
      .Field(Group::Lights, "Automatic exposure")
      .Means("The exposure is found from the picture: as bright as can be with next to nothing "
             "that is pure white"),
  };
}

//------------------------------------------------------------------------------
std::vector<Parameter> ColorRows()
{
  return {
    Color("BaseColor", &M::GetBaseColor, &M::SetBaseColor)
      .Usually(0.0, 0.0, 0.0)
      .Field(Group::Relief, "Base")
      .OnCommandLine("--base", "R,G,B")
      .Means("Colour without any light"),
    Color("DiffuseColor", &M::GetDiffuseColor, &M::SetDiffuseColor)
      .Usually(1.0, 1.0, 1.0)
      .Field(Group::Relief, "Diffuse")
      .OnCommandLine("--diffuse", "R,G,B")
      .Means("Colour of the light that has passed through the material"),
    Color("SpecularColor", &M::GetSpecularColor, &M::SetSpecularColor)
      .Usually(1.0, 1.0, 1.0)
      .Field(Group::Highlights, "Colour")
      .OnCommandLine("--specular", "R,G,B")
      .Means("Colour of highlights"),
    Single(
      Kind::Number, "SpecularCoefficient", &M::GetSpecularCoefficient, &M::SetSpecularCoefficient)
      .Takes(Between(0.0, 1.0))
      .Field(Group::Highlights, "Share k_s")
      .OnCommandLine("--ks", "K")
      .Means("Share of highlights: 0 is none, 1 nothing else"),
    Range("SpecularRange", &M::GetSpecularRange, &M::SetSpecularRange)
      .Usually(0.0, 1.0)
      .Field(Group::Highlights, "Range")
      .Slides(-1.0, 1.0)
      .OnCommandLine("--specular-range", "LO,HI")
      .Means(
        "Where a highlight begins and is full: cosines of the angle between light and mirrored "
        "view"),
    Single(Kind::Number, "SpecularPower", &M::GetSpecularPower, &M::SetSpecularPower)
      .Takes(AtLeast(0.0))
      .Usually(1.0)
      .Field(Group::Highlights, "Power")
      .Slides(0.0, 100.0, 3.0)
      .OnCommandLine("--specular-power", "P")
      .Means("Exponent of the highlight's falloff: above 1 it is narrower, below 1 wider"),
    Single(Kind::Number, "ForwardScatterCoefficient", &M::GetForwardScatterCoefficient,
      &M::SetForwardScatterCoefficient)
      .Takes(Between(0.0, 1.0))
      .Field(Group::Backlight, "Share k_f")
      .OnCommandLine("--kf", "K")
      .Means("Share of the diffuse light that is scattered forward, seen when the light is behind "
             "the relief"),
    Range("ForwardScatterRange", &M::GetForwardScatterRange, &M::SetForwardScatterRange)
      .Usually(0.0, 1.0)
      .Field(Group::Backlight, "Range")
      .Slides(-1.0, 1.0)
      .OnCommandLine("--scatter-range", "LO,HI")
      .Means("Where forward scattering begins and is full: cosines of the angle between view and "
             "light's way, 1 for a light straight behind"),
    Single(
      Kind::Number, "ForwardScatterPower", &M::GetForwardScatterPower, &M::SetForwardScatterPower)
      .Takes(AtLeast(0.0))
      .Usually(1.0)
      .Field(Group::Backlight, "Power")
      .Slides(0.0, 100.0, 3.0)
      .OnCommandLine("--scatter-power", "P")
      .Means("Exponent of the scattering's falloff: above 1 it is narrower, below 1 wider"),
  };
}

//------------------------------------------------------------------------------
std::vector<Parameter> MediumRows()
{
  return {
    // In this order: setting a depth turns the automatic one off.
    Single(Kind::Number, "SubsurfaceDepth", &M::GetSubsurfaceDepth, &M::SetSubsurfaceDepth)
      .InUnit("spacing")
      .Takes(AtLeast(0.0))
      .Usually(1.0)
      .Field(Group::Relief, "Depth t")
      .Slides(0.0, 100.0, 3.0)
      .OnCommandLine("--depth", "T|auto")
      .Means("How far below the surface light is gathered, in units of length: small is crisp as "
             "stone, large is soft as wax, 0 is opaque"),
    Single(Kind::Flag, "AutomaticSubsurfaceDepth", &M::GetAutomaticSubsurfaceDepth,
      &M::SetAutomaticSubsurfaceDepth)
      .Usually(1.0)
      .Field(Group::Relief, "Automatic depth")
      .Means("Light is gathered one sample's width below the surface"),
    Single(Kind::Choice, "OffsetMode", &M::GetOffsetMode, &M::SetOffsetMode)
      .Among(
        { { "Vertical", "", "" }, { "SurfaceNormal", "normal", "" }, { "TangentPlane", "", "" } })
      .Usually(M::TangentPlane)
      .Field(Group::Relief, "Offset")
      .OnCommandLine("--offset")
      .Means("The way down to the depth: vertical by t, normal to the surface, or vertical to t "
             "below the "
             "tangent plane; the last two shade slopes as the cosine of the light's angle does"),
    Single(Kind::Choice, "Attenuation", &M::GetAttenuation, &M::SetAttenuation)
      .Among({ { "Reciprocal", "", "" }, { "Exponential", "", "" } })
      .Usually(M::Reciprocal)
      .Field(Group::Relief, "Attenuation")
      .OnCommandLine("--attenuation")
      .Means("How the thickness r that light has passed dims it: T/r, or exp(-A (r - T))"),
    Single(Kind::Number, "Density", &M::GetDensity, &M::SetDensity)
      .InUnit("1/spacing")
      .Takes(AtLeast(0.0))
      .Usually(1.0)
      .Field(Group::Relief, "Density")
      .Slides(0.0, 2.0, 3.0)
      .OnCommandLine("--density", "A")
      .CountsWith("Attenuation", M::Exponential)
      .Means("Density of the exponential attenuation, per unit of length"),
    Single(Kind::Flag, "UseFloor", &M::GetUseFloor, &M::SetUseFloor)
      .Field(Group::Backlight, "Floor")
      .Means("The material ends below, so that light comes through from behind"),
    Single(Kind::Number, "FloorHeight", &M::GetFloorHeight, &M::SetFloorHeight)
      .InUnit("spacing")
      .Field(Group::Backlight, "Floor height")
      .Slides(-10.0, 10.0)
      .OnCommandLine("--floor", "H")
      .CountsWith("UseFloor", 1)
      .Means("Scaled height at which the material ends below"),
  };
}

//------------------------------------------------------------------------------
std::vector<Parameter> EnvironmentRows()
{
  return {
    Single(Kind::Number, "RotationZ", &E::GetRotationZ, &E::SetRotationZ)
      .InUnit("degrees")
      .Field(Group::Environment, "Turn")
      .Slides(0.0, 360.0)
      .OnCommandLine("--env-rotation", "DEG")
      .Means("Turns the environment about the vertical, counter-clockwise seen from above"),
    Single(Kind::Number, "Tilt", &E::GetTilt, &E::SetTilt)
      .InUnit("degrees")
      .Field(Group::Environment, "Tilt")
      .Slides(-180.0, 180.0)
      .OnCommandLine("--env-tilt", "DEG")
      .Means("Then leans its zenith toward the south"),
    Single(Kind::Number, "Intensity", &E::GetIntensity, &E::SetIntensity)
      .Takes(AtLeast(0.0))
      .Usually(1.0)
      .Field(Group::Environment, "Intensity")
      .Slides(0.0, 4.0, 2.0)
      .OnCommandLine("--env-intensity", "I")
      .Means("What the environment's colours are multiplied by"),
    Single(Kind::Length, "Radius", &E::GetRadius, &E::SetRadius)
      .InUnit("spacing")
      .Takes(Above(0.0))
      .Usually(Infinity)
      .Field(Group::Environment, "Radius")
      .Slides(0.0, 1000.0, 3.0)
      .OnCommandLine("--env-radius", "R|infinite")
      .Means("How far away the environment is, from the middle of the relief, in units of length"),
    Single(Kind::Choice, "Sampling", &E::GetSampling, &E::SetSampling)
      .Among({ { "Uniform", "", "" }, { "SolidAngle", "", "Evenly" },
        { "Importance", "", "Where light is" } })
      .Usually(E::SolidAngle)
      .Field(Group::Environment, "Spread")
      .OnCommandLine("--env-sampling")
      .Means(
        "How the environment's lights are spread: uniform in azimuth and polar angle, as the "
        "model was first published; evenly over the sphere; or where the light is, for pictures "
        "with a sun or lamps"),
    Single(Kind::Count, "NumberOfSamples", &E::GetNumberOfSamples, &E::SetNumberOfSamples)
      .Takes(Between(1.0, 65536.0))
      .Usually(64.0)
      .Field(Group::Environment, "Samples")
      .Slides(8.0, 1024.0, 2.0)
      .OnCommandLine("--env-samples", "N")
      .Means("How many lights stand for the environment, best a multiple of 8; each is traced"),
  };
}

//------------------------------------------------------------------------------
// Of a light: what its direction or place does not tell. VTK's lights take any number.
std::vector<Parameter> LightRows()
{
  Row diameter = Row(Owner::Light, Kind::Number, "AngularDiameter")
                   .InUnit("degrees")
                   .Takes(Between(0.0, 90.0))
                   .Field(Group::Lights, "Diameter")
                   .Slides(0.0, 30.0, 2.0)
                   .OnCommandLine("--sun-diameter", "DEG")
                   .Means("How large a sun looks, which widens the edges of shadows with distance: "
                          "0.533 is the real sun, 0 a point");
  diameter.OfSuns = true;
  diameter.Get = [](vtkObject* light) {
    return Values{ S::GetAngularDiameter(static_cast<vtkLight*>(light)), 0.0, 0.0 };
  };
  diameter.Set = [](vtkObject* light, const Values& v)
  { SetAngularDiameter(static_cast<vtkLight*>(light), v[0]); };
  return {
    diameter,
    Color("DiffuseColor", &vtkLight::GetDiffuseColor, &vtkLight::SetDiffuseColor)
      .Keyed("color")
      .Takes(Interval())
      .Usually(1.0, 1.0, 1.0)
      .Field(Group::Lights, "Colour")
      .Means("Colour of this light"),
    Single(Kind::Number, "Intensity", &vtkLight::GetIntensity, &vtkLight::SetIntensity)
      .Usually(1.0)
      .Field(Group::Lights, "Intensity")
      .Slides(0.0, 4.0, 2.0)
      .Means("What the light's colour is multiplied by"),
    Single(Kind::Flag, "Switch", &vtkLight::GetSwitch, &vtkLight::SetSwitch)
      .Keyed("on")
      .Usually(1.0)
      .Field(Group::Lights, "On")
      .Means("Whether the light shines"),
  };
}
}

//------------------------------------------------------------------------------
const std::vector<Parameter>& All()
{
  static const std::vector<Parameter> table = []
  {
    std::vector<Parameter> rows;
    for (const auto& part :
      { SceneRows(), ColorRows(), MediumRows(), EnvironmentRows(), LightRows() })
    {
      rows.insert(rows.end(), part.begin(), part.end());
    }
    return rows;
  }();
  return table;
}
}

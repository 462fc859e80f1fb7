// SPDX-License-Identifier: BSD-3-Clause
// Every parameter of the table is what its class has: default, refusals, printing, copies.
#include "SceneParameters.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkReliefAngles.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefParameters.h"
#include "vtkReliefScene.h"

#include "ParameterTestUtilities.h"
#include "ReliefTestUtilities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

using namespace relief::parameters;

namespace
{
int Failures = 0;
const double NaN = std::numeric_limits<double>::quiet_NaN();

vtkSmartPointer<vtkObject> New(Owner owner)
{
  switch (owner)
  {
    case Owner::Scene:
      return vtkSmartPointer<vtkReliefScene>::New();
    case Owner::Material:
      return vtkSmartPointer<vtkReliefMaterial>::New();
    case Owner::Environment:
      return vtkSmartPointer<vtkReliefEnvironment>::New();
    default:
      return vtkSmartPointer<vtkLight>::New();
  }
}

bool Complain(const Parameter& parameter, const char* what)
{
  std::cerr << NameOf(parameter.Of) << "." << parameter.Name << ": " << what << std::endl;
  return false;
}

// Values that are not taken.
std::vector<Values> BadValues(const Parameter& parameter)
{
  std::vector<Values> bad;
  const Interval& taken = parameter.Taken;
  switch (parameter.Is)
  {
    case Kind::Flag:
      break;
    case Kind::Choice:
      bad = { { -1.0, 0.0, 0.0 }, { static_cast<double>(parameter.Choices.size()), 0.0, 0.0 } };
      break;
    case Kind::Range:
      bad = { { 1.0, 0.5, 0.0 }, { NaN, 1.0, 0.0 } };
      break;
    case Kind::Color:
      bad = { { 0.0, NaN, 0.0 } };
      break;
    case Kind::Count:
      break;
    default:
      bad = { { NaN, 0.0, 0.0 } };
  }
  if (parameter.Is != Kind::Flag && std::isfinite(taken.Least))
  {
    bad.push_back({ taken.Least - 1.0, taken.Least, taken.Least });
  }
  if (parameter.Is != Kind::Flag && std::isfinite(taken.Greatest))
  {
    bad.push_back({ taken.Greatest + 1.0, taken.Greatest, taken.Greatest });
  }
  return bad;
}

void TestParameter(const Parameter& parameter)
{
  const auto good = [&](bool condition, const char* what)
  { CHECK(condition || Complain(parameter, what)); };
  const Values other = OtherValue(parameter);
  good(std::strlen(parameter.Help) > 0 && parameter.Help[std::strlen(parameter.Help) - 1] != '.',
    "has help without a full stop");
  good(!Check(parameter, parameter.Default) && !Check(parameter, other), "takes its values");

  vtkSmartPointer<vtkObject> owner = New(parameter.Of);
  good(parameter.Get(owner) == parameter.Default, "has its default at first");
  const vtkMTimeType time = owner->GetMTime();
  parameter.Set(owner, other);
  good(parameter.Get(owner) == other && owner->GetMTime() > time, "can be set");

  std::ostringstream printed;
  Print(owner, printed, vtkIndent());
  good(printed.str().find(std::string(parameter.Name) + ": " + Text(parameter, other)) !=
      std::string::npos,
    "is printed");

  vtkSmartPointer<vtkObject> copy = New(parameter.Of);
  good(!Same(owner, copy), "makes a difference");
  Copy(owner, copy);
  good(parameter.Get(copy) == other && Same(owner, copy), "is copied");

  // The class refuses what the table does, in one message that names the setter and is short. A
  // light is VTK's own class.
  MessageKeeper messages(owner);
  for (const Values& bad : BadValues(parameter))
  {
    const auto refusal = Check(parameter, bad);
    good(refusal && refusal->What == parameter.Name, "is refused by the table");
    if (refusal && parameter.Of != Owner::Light)
    {
      parameter.Set(owner, bad);
      good(messages.OneError("Set" + std::string(parameter.Name) + ": " + refusal->Reason()),
        "is refused by the class");
      good(parameter.Get(owner) == other, "keeps its value");
      good(refusal->Reason().size() < 160, "is refused in short");
    }
  }
}

void TestAngles()
{
  for (double azimuth = 0.0; azimuth < 360.0; azimuth += 7.5)
  {
    for (double altitude = -82.5; altitude < 90.0; altitude += 7.5)
    {
      double v[3];
      double a;
      double b;
      vtkReliefDirection(azimuth, altitude, v);
      vtkMath::MultiplyScalar(v, 3.0);
      vtkReliefAngles(v, a, b);
      CHECK_NEAR(a, azimuth, 1e-12 * 360.0);
      CHECK_NEAR(b, altitude, 1e-12 * 90.0);
    }
  }
}

void TestSceneCopies()
{
  vtkNew<vtkReliefScene> scene;
  for (const Parameter* parameter : Of(Owner::Scene))
  {
    parameter->Set(scene, OtherValue(*parameter));
  }
  scene->GetMaterial()->SetDensity(3.0);
  vtkLight* sun = scene->AddSun(12.0, 34.0, 0.533);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(1.0, 2.0, 3.0);
  vtkNew<vtkMatrix4x4> shift;
  shift->SetElement(0, 3, 10.0);
  lamp->SetTransformMatrix(shift);
  scene->AddLight(lamp);
  vtkNew<vtkReliefEnvironment> sky;
  sky->SetImageToClearSky(100.0, 20.0, 4.0);
  sky->SetTilt(5.0);
  scene->SetEnvironment(sky);

  const auto light = [](vtkReliefScene* of, int i)
  { return vtkLight::SafeDownCast(of->GetLights()->GetItemAsObject(i)); };
  vtkNew<vtkReliefScene> deep;
  deep->DeepCopy(scene);
  CHECK(Same(scene, deep) && Same(scene->GetMaterial(), deep->GetMaterial()));
  CHECK(deep->GetMaterial() != scene->GetMaterial() && deep->GetEnvironment() != sky);
  CHECK(deep->GetLights()->GetNumberOfItems() == 2 && light(deep, 0) != sun);
  CHECK(Same(sun, light(deep, 0)) && vtkReliefScene::GetAngularDiameter(light(deep, 0)) == 0.533);
  CHECK(std::equal(sun->GetPosition(), sun->GetPosition() + 3, light(deep, 0)->GetPosition()));
  double position[3];
  light(deep, 1)->GetTransformedPosition(position);
  CHECK(position[0] == 11.0 && position[2] == 3.0 && light(deep, 1)->GetPositional());
  // What is done to the copy does nothing to the first.
  light(deep, 1)->GetTransformMatrix()->SetElement(0, 3, 0.0);
  deep->SetAngularDiameter(light(deep, 0), 3.0);
  deep->GetMaterial()->SetDensity(5.0);
  CHECK(shift->GetElement(0, 3) == 10.0 && scene->GetMaterial()->GetDensity() == 3.0);
  CHECK(vtkReliefScene::GetAngularDiameter(sun) == 0.533);
  vtkReliefEnvironment* copied = deep->GetEnvironment();
  CHECK(copied->GetTilt() == 5.0 && copied->GetImageSource() == vtkReliefEnvironment::ClearSky);
  CHECK(copied->GetClearSkyParameters()[2] == 4.0 && copied->GetImage() != sky->GetImage());
  CHECK(SameBytes(copied->GetImage()->GetPointData()->GetScalars(),
    sky->GetImage()->GetPointData()->GetScalars()));

  vtkNew<vtkReliefScene> step;
  step->CopySharingImage(scene);
  CHECK(step->GetEnvironment() != sky && step->GetEnvironment()->GetImage() == sky->GetImage());
  CHECK(step->GetMaterial() != scene->GetMaterial() && light(step, 0) != sun);
  CHECK(Same(step->GetEnvironment(), sky));

  vtkNew<vtkReliefScene> shallow;
  shallow->AddSun(1.0, 1.0);
  shallow->ShallowCopy(scene);
  CHECK(Same(scene, shallow) && shallow->GetMaterial() == scene->GetMaterial());
  CHECK(shallow->GetEnvironment() == sky && light(shallow, 0) == sun && light(shallow, 1) == lamp);
  CHECK(shallow->GetLights()->GetNumberOfItems() == 2);

  // A scene is its own copy, and there is nothing to copy from nothing.
  scene->ShallowCopy(scene);
  scene->DeepCopy(scene);
  scene->DeepCopy(nullptr);
  CHECK(scene->GetLights()->GetNumberOfItems() == 2 && scene->GetEnvironment() == sky);
  vtkNew<vtkReliefScene> plain;
  shallow->DeepCopy(plain);
  CHECK(!shallow->GetEnvironment() && shallow->GetLights()->GetNumberOfItems() == 0);

  vtkNew<vtkReliefEnvironment> file;
  file->SetImage(sky->GetImage());
  file->SetFileName("sky.exr");
  vtkNew<vtkReliefEnvironment> other;
  other->ShallowCopy(file);
  CHECK(other->GetImage() == file->GetImage() && std::string(other->GetFileName()) == "sky.exr");
}
}

int TestSceneParameters(int, char*[])
{
  std::set<std::string> names;
  std::set<std::string> keys;
  std::set<std::string> options;
  for (const Parameter& parameter : All())
  {
    TestParameter(parameter);
    const std::string owner = NameOf(parameter.Of);
    CHECK(names.insert(owner + parameter.Name).second);
    CHECK(keys.insert(owner + parameter.Key).second);
    CHECK(!parameter.Option || options.insert(parameter.Option).second);
    CHECK(&Find(parameter.Of, parameter.Name) == &parameter);
    CHECK(!parameter.With || Size(Find(parameter.Of, parameter.With)) == 1);
  }
  // Those that the program sets in another way than by an option of their own.
  const std::set<std::string> withoutOption = {
    "MaterialAutomaticSubsurfaceDepth", // --depth auto
    "SceneAutomaticExposure",           // --exposure auto
    "MaterialUseFloor",                 // --floor
    "LightDiffuseColor",                // --sun and --point
    "LightIntensity",                   // --sun and --point
    "LightSwitch",                      // a light that is off is left out
  };
  for (const Parameter& parameter : All())
  {
    const bool without =
      withoutOption.count(std::string(NameOf(parameter.Of)) + parameter.Name) > 0;
    CHECK((parameter.Option == nullptr) == without || Complain(parameter, "has an option"));
  }
  CHECK(vtkReliefParameters::GetNumberOfParameters() == static_cast<int>(All().size()));
  CHECK(vtkReliefParameters::GetName(-1).empty() && vtkReliefParameters::GetKind(1000).empty());
  TestAngles();
  TestSceneCopies();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

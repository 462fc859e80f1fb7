// SPDX-License-Identifier: BSD-3-Clause
// Scenes as files: exact round trips, every kind of mistake, and files that are damaged.
#include "vtkReliefSceneFile.h"

#include "vtkCallbackCommand.h"
#include "vtkCollectionRange.h"
#include "vtkErrorCode.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenImageIOWriter.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefEnvironmentImage.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkTestUtilities.h"

#include "ReliefTestUtilities.h"

#include <vtksys/Directory.hxx>
#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <sstream>

namespace
{
int Failures = 0;
std::string Folder;

std::mt19937& Random()
{
  static std::mt19937 random = []
  {
    const char* given = std::getenv("RELIEF_SEED");
    const unsigned int seed = given ? std::atoi(given) : std::random_device()();
    std::cout << "RELIEF_SEED=" << seed << std::endl;
    return std::mt19937(seed);
  }();
  return random;
}

double In(double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(Random());
}

// Any finite number, of any size; all bits are used.
double Any()
{
  double value = NAN;
  while (!std::isfinite(value))
  {
    const std::uint64_t bits =
      static_cast<std::uint64_t>(Random()()) << 32 | static_cast<std::uint64_t>(Random()());
    std::memcpy(&value, &bits, sizeof(value));
  }
  return value;
}

void Randomize(vtkReliefScene* scene)
{
  vtkReliefMaterial* m = scene->GetMaterial();
  m->SetBaseColor(In(0, 1), std::abs(Any()), 0.0);
  m->SetDiffuseColor(In(0, 1), In(0, 1), In(0, 1));
  m->SetSpecularColor(In(0, 9), In(0, 9), std::abs(Any()));
  m->SetSpecularCoefficient(In(0, 1));
  m->SetForwardScatterCoefficient(In(0, 1));
  m->SetSpecularRange(In(-1, 0), In(0, 1));
  m->SetSpecularPower(std::abs(Any()));
  m->SetForwardScatterRange(-std::abs(Any()), In(0, 1));
  m->SetForwardScatterPower(In(0, 9));
  m->SetSubsurfaceDepth(std::abs(Any()));
  m->SetAutomaticSubsurfaceDepth(Random()() % 2);
  m->SetOffsetMode(Random()() % 3);
  m->SetAttenuation(Random()() % 2);
  m->SetDensity(std::abs(Any()));
  m->SetUseFloor(Random()() % 2);
  m->SetFloorHeight(Any());
  scene->SetHeightScale(Any());
  scene->SetIntegrator(Random()() % 2);
  scene->SetTolerance(In(0, 1));
  scene->SetNumberOfSteps(1 + Random()() % 1000000);
  scene->SetNumberOfSunSamples(1 + Random()() % 4096);
  scene->SetExposure(In(-20.0, 20.0));
  scene->SetAutomaticExposure(Random()() % 2);
  for (unsigned int i = Random()() % 5; i > 0; --i)
  {
    vtkNew<vtkLight> lamp;
    vtkLight* light = lamp;
    switch (Random()() % 4)
    {
      case 0: // as on maps
        light = scene->AddSun(std::floor(In(0, 360)), std::floor(In(-90, 90)), 0.533);
        break;
      case 1:
        light = scene->AddSun(In(-1000, 1000), In(-90, 90), In(0, 90));
        break;
      case 2: // dragged, or set by a program
        light->SetPosition(In(-1, 1), In(-1, 1), In(-1, 1));
        scene->AddLight(light);
        break;
      default:
        light->PositionalOn();
        light->SetPosition(Any(), Any(), Any());
        scene->AddLight(light);
    }
    light->SetDiffuseColor(In(0, 1), In(0, 9), std::abs(Any()));
    light->SetIntensity(Any());
    light->SetSwitch(Random()() % 2);
  }
  if (Random()() % 2)
  {
    vtkNew<vtkReliefEnvironment> environment;
    switch (Random()() % 3)
    {
      case 0:
        environment->SetImageToWhiteDome();
        break;
      case 1:
        environment->SetImageToClearSky(In(-400, 400), In(0, 90), In(2, 10));
        break;
      default:
        break;
    }
    environment->SetRotationZ(Any());
    environment->SetTilt(Any());
    environment->SetIntensity(std::abs(Any()));
    if (Random()() % 2)
    {
      environment->SetRadius(In(1e-9, 1e9));
    }
    environment->SetSampling(Random()() % 3);
    environment->SetNumberOfSamples(1 + Random()() % 65536);
    scene->SetEnvironment(environment);
  }
}

// The bits of every number that a scene's picture depends on. Of a sun: its direction of length 1.
std::vector<double> Numbers(vtkReliefScene* s)
{
  std::vector<double> n;
  auto add = [&n](const double* v, int size) { n.insert(n.end(), v, v + size); };
  vtkReliefMaterial* m = s->GetMaterial();
  add(m->GetBaseColor(), 3);
  add(m->GetDiffuseColor(), 3);
  add(m->GetSpecularColor(), 3);
  add(m->GetSpecularRange(), 2);
  add(m->GetForwardScatterRange(), 2);
  n.insert(n.end(),
    { m->GetSpecularCoefficient(), m->GetForwardScatterCoefficient(), m->GetSpecularPower(),
      m->GetForwardScatterPower(), m->GetSubsurfaceDepth(),
      static_cast<double>(m->GetAutomaticSubsurfaceDepth()),
      static_cast<double>(m->GetOffsetMode()), static_cast<double>(m->GetAttenuation()),
      m->GetDensity(), static_cast<double>(m->GetUseFloor()), m->GetFloorHeight(),
      s->GetHeightScale(), static_cast<double>(s->GetIntegrator()), s->GetTolerance(),
      static_cast<double>(s->GetNumberOfSteps()), static_cast<double>(s->GetNumberOfSunSamples()),
      s->GetExposure(), static_cast<double>(s->GetAutomaticExposure()) });
  for (vtkLight* light : vtk::Range(s->GetLights()))
  {
    double position[3];
    light->GetTransformedPosition(position);
    if (!light->GetPositional())
    {
      double focal[3];
      light->GetTransformedFocalPoint(focal);
      vtkMath::Subtract(position, focal, position);
      vtkMath::Normalize(position);
      for (double& c : position)
      {
        c += 0.0; // no difference between the zeros
      }
    }
    n.push_back(light->GetPositional());
    add(position, 3);
    add(light->GetDiffuseColor(), 3);
    n.insert(n.end(),
      { light->GetIntensity(), static_cast<double>(light->GetSwitch()),
        vtkReliefScene::GetAngularDiameter(light) });
  }
  if (vtkReliefEnvironment* e = s->GetEnvironment())
  {
    n.insert(n.end(),
      { e->GetRotationZ(), e->GetTilt(), e->GetIntensity(), e->GetRadius(),
        static_cast<double>(e->GetSampling()), static_cast<double>(e->GetNumberOfSamples()),
        static_cast<double>(e->GetImage() ? e->GetImageSource() : 0) });
    if (e->GetImage() && e->GetImageSource() == vtkReliefEnvironment::ClearSky)
    {
      add(e->GetClearSkyParameters(), 3);
    }
  }
  return n;
}

bool SameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void TestRoundTrips()
{
  int exactSuns = 0;
  for (int round = 0; round < 400; ++round)
  {
    vtkNew<vtkReliefSceneFile> file;
    Randomize(file->GetScene());
    const std::string text = file->ToText();
    CHECK(!text.empty() && file->GetErrorCode() == vtkErrorCode::NoError);
    vtkNew<vtkReliefSceneFile> back;
    MessageKeeper messages(back);
    CHECK(back->FromText(text) && messages.Silent());
    CHECK(SameBits(Numbers(file->GetScene()), Numbers(back->GetScene())));
    CHECK(back->ToText() == text);
    exactSuns +=
      text.find("\"azimuth\"") != std::string::npos && text.find("\"toward\"") == std::string::npos;
    if (Failures)
    {
      std::cout << text << back->ToText();
      return;
    }
  }
  CHECK(exactSuns > 20);

  // Suns as on maps are written as on maps.
  vtkNew<vtkReliefSceneFile> file;
  file->GetScene()->AddSun(315.0, 45.0, 0.533);
  file->GetScene()->AddSun(-12.25, 30.7);
  file->GetScene()->AddSun(12.5, -90.0);
  const std::string text = file->ToText();
  CHECK(text.find("\"azimuth\": 315,\n      \"altitude\": 45,\n      \"angularDiameter\": 0.533") !=
    std::string::npos);
  CHECK(text.find("\"azimuth\": 347.75,\n      \"altitude\": 30.7,") != std::string::npos);
  CHECK(text.find("\"altitude\": -90,") != std::string::npos);
  CHECK(text.find("toward") == std::string::npos);

  // The transform of a light is carried out.
  vtkNew<vtkReliefSceneFile> moved;
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(1.0, 2.0, 3.0);
  vtkNew<vtkMatrix4x4> shift;
  shift->SetElement(0, 3, 10.0);
  lamp->SetTransformMatrix(shift);
  moved->GetScene()->AddLight(lamp);
  CHECK(moved->ToText().find("\"position\": [11, 2, 3]") != std::string::npos);
}

void TestHandWritten()
{
  vtkNew<vtkReliefSceneFile> file;
  vtkNew<vtkReliefScene> scene;
  scene->AddSun(1.0, 2.0);
  scene->SetTolerance(0.5);
  file->SetScene(scene);
  // What is missing has its default, also if the scene had another value.
  const vtkMTimeType time = scene->GetMTime();
  CHECK(file->FromText("{ \"reliefScene\": 1 }"));
  CHECK(scene->GetTolerance() == 0.0003 && scene->GetLights()->GetNumberOfItems() == 0);
  CHECK(scene->GetMTime() > time);
  CHECK(file->FromText("{\"reliefScene\": 1, \"material\": {\"subsurfaceDepth\": 7},\n"
                       "\"lights\": [{\"kind\": \"sun\", \"azimuth\": 90, \"altitude\": 0}]}"));
  CHECK(scene->GetMaterial()->GetSubsurfaceDepth() == 7.0);
  CHECK(!scene->GetMaterial()->GetAutomaticSubsurfaceDepth());
  vtkLight* sun = vtkLight::SafeDownCast(scene->GetLights()->GetItemAsObject(0));
  CHECK(sun && sun->GetPosition()[0] == 1.0 && sun->GetSwitch() && sun->GetIntensity() == 1.0);

  // toward refines the angles, and gives way to one that somebody has changed.
  const char* refined = "{\"reliefScene\": 1, \"lights\": [{\"kind\": \"sun\", \"azimuth\": %, "
                        "\"altitude\": 0, \"toward\": [2, 1e-11, 0]}]}";
  std::string text = refined;
  CHECK(file->FromText(text.replace(text.find('%'), 1, "90")));
  sun = vtkLight::SafeDownCast(scene->GetLights()->GetItemAsObject(0));
  CHECK(sun->GetPosition()[0] == 2.0 && sun->GetPosition()[1] == 1e-11);
  text = refined;
  CHECK(file->FromText(text.replace(text.find('%'), 1, "180")));
  sun = vtkLight::SafeDownCast(scene->GetLights()->GetItemAsObject(0));
  CHECK(sun->GetPosition()[0] == 0.0 && sun->GetPosition()[1] == -1.0);

  // Unknown keys are left out, with one warning that names them.
  MessageKeeper messages(file);
  CHECK(file->FromText("{\"reliefScene\": 1,\n\"colour\": 2,\n\"material\": {\n\"shine\": 1}}"));
  CHECK(messages.OneWarning("material.shine (line 4), colour (line 2)"));
}

void TestMistakes()
{
  struct
  {
    const char* text;
    const char* message;
  } mistakes[] = {
    { "", "line 1, column 1" },
    { "{\"reliefScene\": 1", "line 1, column 18" },
    { "{\"reliefScene\": 1,\n\n\"material\": }", "line 3, column 13" },
    { "{\"reliefScene\": 1, \"reliefScene\": 1}", "Duplicate" },
    { "{\"reliefScene\": 1} more", "it is not JSON" },
    { "{\"reliefScene\": 1, \"tolerance\": NaN}", "it is not JSON" },
    { "{\"reliefScene\": 1, \"tolerance\": 1e999}", "line 1" },
    { "[]", "an object with the key \"reliefScene\" is expected" },
    { "{\"lights\": []}", "\"reliefScene\" is missing" },
    { "{\"reliefScene\": \"1\"}", "line 1, reliefScene: \"1\" was given, a whole number" },
    { "{\"reliefScene\": 2, \"new\": 1}", "version 2, this program reads version 1" },
    { "{\"reliefScene\": 0}", "version 0" },
    { "{\"reliefScene\": 1,\n\"tolerance\": -1}", "line 2, tolerance: -1 was given, a finite" },
    { "{\"reliefScene\": 1, \"tolerance\": true}", "tolerance: true was given, a number" },
    { "{\"reliefScene\": 1, \"numberOfSteps\": 2.5}", "numberOfSteps: 2.5 was given, a whole" },
    { "{\"reliefScene\": 1, \"numberOfSteps\": 0}", "numberOfSteps: 0 was given, a number in [1," },
    { "{\"reliefScene\": 1, \"integrator\": \"exactly\"}",
      "integrator: \"exactly\" was given, \"Exact\" or \"FixedStep\"" },
    { "{\"reliefScene\": 1, \"material\": []}", "material: [] was given, an object" },
    { "{\"reliefScene\": 1, \"material\": {\n\"baseColor\": [1, 2]}}",
      "line 2, material.baseColor: [1,2] was given, an array of 3 numbers" },
    { "{\"reliefScene\": 1, \"material\": {\"baseColor\": [1, -2, 0]}}", "(1, -2, 0) was given" },
    { "{\"reliefScene\": 1, \"material\": {\"specularRange\": [1, 0]}}", "specularRange: (1, 0)" },
    { "{\"reliefScene\": 1, \"material\": {\"useFloor\": 1}}", "useFloor: 1 was given, true or" },
    { "{\"reliefScene\": 1, \"lights\": {}}", "lights: {} was given, an array of objects" },
    { "{\"reliefScene\": 1, \"lights\": [1]}", "lights: [1] was given, an array of objects" },
    { "{\"reliefScene\": 1, \"lights\": [{}]}", "lights[0]: the key \"kind\" is missing" },
    { "{\"reliefScene\": 1, \"lights\": [{\"kind\": \"lamp\"}]}", "\"sun\" or \"point\"" },
    { "{\"reliefScene\": 1, \"lights\": [\n{\"kind\": \"sun\", \"azimuth\": 1}]}",
      "line 2, lights[0]: the key \"altitude\" is missing" },
    { "{\"reliefScene\": 1, \"lights\": [{\"kind\": \"sun\", \"azimuth\": 1, \"altitude\": 91}]}",
      "lights[0]: azimuth 1, altitude 91" },
    { "{\"reliefScene\": 1, \"lights\": [{\"kind\": \"point\"}]}", "\"position\" is missing" },
    { "{\"reliefScene\": 1, \"environment\": {}}", "environment: the key \"image\" is missing" },
    { "{\"reliefScene\": 1, \"environment\": {\"image\": \"file\", \"file\": \"\"}}",
      "environment.file: \"\" was given, a text" },
    { "{\"reliefScene\": 1, \"environment\": {\"image\": \"file\", \"file\": \"none.exr\"}}",
      "none.exr" },
    { "{\"reliefScene\": 1, \"environment\": {\"image\": \"clearSky\", \"azimuth\": 1, "
      "\"altitude\": -1}}",
      "altitude -1" },
    { "{\"reliefScene\": 1, \"environment\": {\"image\": \"none\", \"radius\": \"far\"}}",
      "radius: \"far\" was given, a number or \"infinite\"" },
    { "{\"reliefScene\": 1, \"environment\": {\"image\": \"none\", \"radius\": 0}}", "radius: 0" },
  };
  vtkNew<vtkReliefSceneFile> file;
  file->GetScene()->AddSun(12.0, 34.0);
  const std::string before = file->ToText();
  const vtkMTimeType time = file->GetScene()->GetMTime();
  MessageKeeper messages(file);
  for (const auto& mistake : mistakes)
  {
    CHECK(!file->FromText(mistake.text) && messages.OneError(mistake.message));
    CHECK(file->GetErrorCode() == vtkErrorCode::FileFormatError);
  }
  CHECK(!file->FromText(std::string(100000, '[')) && messages.OneError("nested too deeply"));
  // Not one of them has touched the scene.
  CHECK(file->GetScene()->GetMTime() == time && file->ToText() == before);

  file->SetScene(nullptr);
  CHECK(messages.OneError("null") && file->GetScene() != nullptr);

  // Scenes that cannot be told.
  vtkNew<vtkReliefEnvironment> environment;
  environment->SetImage(vtkNew<vtkImageData>());
  file->GetScene()->SetEnvironment(environment);
  CHECK(file->ToText().empty() && messages.OneError("SetFileName"));
  CHECK(file->GetErrorCode() == vtkErrorCode::UnknownError);
  file->GetScene()->SetEnvironment(nullptr);
  vtkLight* sun = file->GetScene()->AddSun(1.0, 2.0);
  sun->SetPosition(NAN, 0.0, 0.0);
  CHECK(file->ToText().empty() && messages.OneError("finite"));
  sun->SetPosition(sun->GetFocalPoint());
  CHECK(file->ToText().empty() && messages.OneError("differ"));
}

std::string Put(const std::string& name, const std::string& text)
{
  const std::string path = Folder + name;
  vtksys::ofstream file(path.c_str(), std::ios::binary);
  file << text;
  return path;
}

void TestFiles()
{
  vtkNew<vtkReliefSceneFile> file;
  MessageKeeper messages(file);
  CHECK(!file->Read() && file->GetErrorCode() == vtkErrorCode::NoFileNameError);
  CHECK(messages.OneError("no file name"));
  CHECK(!file->Write() && file->GetErrorCode() == vtkErrorCode::NoFileNameError);
  CHECK(messages.OneError("no file name"));
  file->SetFileName((Folder + "absent.json").c_str());
  CHECK(!file->Read() && file->GetErrorCode() == vtkErrorCode::FileNotFoundError);
  CHECK(messages.OneError("absent.json"));
  CHECK(file->GetErrorReason() == "the file does not exist");
  file->SetFileName(Folder.c_str());
  CHECK(!file->Read() && file->GetErrorCode() == vtkErrorCode::CannotOpenFileError);
  CHECK(messages.OneError("folder"));
  CHECK(!file->Write() && file->GetErrorCode() == vtkErrorCode::CannotOpenFileError);
  CHECK(messages.OneError("Cannot write"));
  file->SetFileName((Folder + "no/such/folder.json").c_str());
  CHECK(!file->Write() && file->GetErrorCode() == vtkErrorCode::CannotOpenFileError);
  CHECK(messages.OneError("folder.json"));
  file->SetFileName(Put("empty.json", "").c_str());
  CHECK(!file->Read() && file->GetErrorCode() == vtkErrorCode::PrematureEndOfFileError);
  CHECK(messages.OneError("empty"));
  file->SetFileName(Put("large.json", std::string(17 * 1024 * 1024, ' ')).c_str());
  CHECK(!file->Read() && messages.OneError("too large"));

  // An environment's image is found from the scene's folder, wherever both are.
  vtkNew<vtkImageData> sky;
  sky->SetDimensions(8, 4, 1);
  sky->AllocateScalars(VTK_FLOAT, 3);
  std::fill_n(static_cast<float*>(sky->GetScalarPointer()), 96, 0.25f);
  vtksys::SystemTools::MakeDirectory(Folder + "one/images");
  vtkNew<vtkOpenImageIOWriter> writer;
  writer->SetInputData(sky);
  writer->SetFileName((Folder + "one/images/sky.exr").c_str());
  writer->Write();
  vtkNew<vtkReliefEnvironment> environment;
  CHECK(vtkReliefEnvironmentImage::Read(environment, (Folder + "one/images/sky.exr").c_str()));
  CHECK(environment->GetImageSource() == vtkReliefEnvironment::File);
  file->GetScene()->SetEnvironment(environment);
  file->SetFileName((Folder + "one/scene.json").c_str());
  CHECK(file->Write() && messages.Silent() && file->GetErrorReason().empty());
  CHECK(file->ToText().find("\"file\": \"images/sky.exr\"") != std::string::npos);
  // The picture that it names is not written over.
  file->SetFileName((Folder + "one/../one/images/sky.exr").c_str());
  CHECK(!file->Write() && messages.OneError("choose another name"));
  CHECK(vtkReliefEnvironmentImage::TryToRead(environment, (Folder + "one/images/sky.exr").c_str())
          .empty());
  file->SetFileName((Folder + "one/scene.json").c_str());
  vtksys::SystemTools::RemoveADirectory(Folder + "two");
  CHECK(vtksys::SystemTools::CopyADirectory(Folder + "one", Folder + "two"));
  vtkNew<vtkReliefSceneFile> copy;
  copy->SetFileName((Folder + "two/scene.json").c_str());
  CHECK(copy->Read());
  vtkReliefEnvironment* read = copy->GetScene()->GetEnvironment();
  CHECK(read && read->GetImage() && read->GetImage()->GetDimensions()[0] == 8);
  CHECK(read && std::string(read->GetFileName()) == Folder + "two/images/sky.exr");
  // Elsewhere it is named with its whole path.
  copy->SetFileName((Folder + "elsewhere.json").c_str());
  CHECK(copy->ToText().find("\"two/images/sky.exr\"") != std::string::npos);
  copy->SetFileName((Folder + "one/other.json").c_str());
  CHECK(copy->ToText().find("\"" + Folder + "two/images/sky.exr\"") != std::string::npos);

  // Another image is another's: its file is not known until somebody says it.
  environment->SetImage(sky);
  CHECK(
    environment->GetFileName() == nullptr && !file->Write() && messages.OneError("SetFileName"));
  // What could not be written has left the old file.
  CHECK(file->Read() && messages.Silent());
  MessageKeeper environmentMessages(environment);
  CHECK(!vtkReliefEnvironmentImage::Read(environment, (Folder + "absent.exr").c_str()));
  CHECK(environmentMessages.OneError("absent.exr") && environment->GetImage() == sky);
  CHECK(vtkReliefEnvironmentImage::TryToRead(environment, (Folder + "absent.exr").c_str()) ==
    "the file does not exist");
  CHECK(environmentMessages.Silent());

  CHECK(!vtkReliefEnvironmentImage::TryToRead(nullptr, (Folder + "one/images/sky.exr").c_str())
           .empty());

  // Nothing temporary is left.
  vtksys::Directory directory;
  directory.Load(Folder + "one");
  for (unsigned long i = 0; i < directory.GetNumberOfFiles(); ++i)
  {
    CHECK(std::string(directory.GetFile(i)).find(".tmp") == std::string::npos);
  }
}

// Files that are cut off, or of which bytes are changed, removed or doubled: read, or refused with
// one message. Then the scene is as it was.
void TestDamage()
{
  vtkNew<vtkReliefSceneFile> file;
  file->GetScene()->AddSun(315.0, 45.0);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  file->GetScene()->AddLight(lamp);
  vtkNew<vtkReliefEnvironment> dome;
  dome->SetImageToWhiteDome();
  file->GetScene()->SetEnvironment(dome);
  const std::string whole = file->ToText();
  vtkNew<vtkReliefSceneFile> target;
  target->GetScene()->AddSun(1.0, 1.0);
  int errors = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&errors);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  target->AddObserver(vtkCommand::ErrorEvent, count);
  vtkNew<vtkCallbackCommand> ignore;
  ignore->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  target->AddObserver(vtkCommand::WarningEvent, ignore);
  std::vector<std::string> damaged;
  for (std::size_t length = 0; length + 2 < whole.size(); ++length)
  {
    damaged.push_back(whole.substr(0, length));
  }
  const std::size_t truncated = damaged.size();
  const std::string bytes("{}[]\",:-+.eE0189tfn \n\\/\0\x80\xff", 26);
  for (int i = 0; i < 5000; ++i)
  {
    std::string text = whole;
    for (unsigned int changes = 1 + Random()() % 3; changes > 0; --changes)
    {
      const std::size_t at = Random()() % text.size();
      switch (Random()() % 3)
      {
        case 0:
          text[at] = bytes[Random()() % bytes.size()];
          break;
        case 1:
          text.erase(at, 1 + Random()() % 8);
          break;
        default:
          text.insert(at, text.substr(Random()() % text.size(), Random()() % 30));
      }
    }
    damaged.push_back(text);
  }
  int refused = 0;
  for (std::size_t i = 0; i < damaged.size(); ++i)
  {
    const std::vector<double> before = Numbers(target->GetScene());
    errors = 0;
    const bool read = target->FromText(damaged[i]);
    refused += !read;
    CHECK(errors == (read ? 0 : 1));
    CHECK(read || SameBits(before, Numbers(target->GetScene())));
    CHECK(!read || i >= truncated);
    if (Failures)
    {
      std::cout << damaged[i] << std::endl;
      return;
    }
  }
  std::cout << refused << " of " << damaged.size() << " damaged files refused" << std::endl;
  CHECK(refused > static_cast<int>(truncated));
}
}

int TestReliefSceneFile(int argc, char* argv[])
{
  char* temporary =
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary");
  Folder = vtksys::SystemTools::CollapseFullPath(temporary) + "/TestReliefSceneFile/";
  delete[] temporary;
  vtksys::SystemTools::RemoveADirectory(Folder);
  vtksys::SystemTools::MakeDirectory(Folder);
  TestRoundTrips();
  TestHandWritten();
  TestMistakes();
  TestFiles();
  TestDamage();
  std::ostringstream printed;
  vtkNew<vtkReliefSceneFile> file;
  file->Print(printed);
  for (const char* name : { "FileName", "Scene", "ErrorCode" })
  {
    CHECK(printed.str().find(std::string(name) + ":") != std::string::npos);
  }
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

// SPDX-License-Identifier: BSD-3-Clause
// Every parameter of the table is in scene files, both ways, and in the headers of OpenEXR files.
#include "SceneParameters.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkOpenEXRLayerWriter.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefSceneFile.h"
#include "vtkTestUtilities.h"

#include "ParameterTestUtilities.h"
#include "ReliefTestUtilities.h"

#include <vtksys/SystemTools.hxx>

#include <OpenImageIO/imageio.h>

#include <algorithm>

using namespace relief::parameters;

namespace
{
int Failures = 0;

vtkObject* OwnerIn(vtkReliefScene* scene, Owner owner)
{
  switch (owner)
  {
    case Owner::Scene:
      return scene;
    case Owner::Material:
      return scene->GetMaterial();
    case Owner::Environment:
      return scene->GetEnvironment();
    default:
      return scene->GetLights()->GetItemAsObject(0);
  }
}

void Fill(vtkReliefScene* scene)
{
  scene->AddSun(UsualAzimuth, UsualAltitude);
  vtkNew<vtkReliefEnvironment> sky;
  sky->SetImageToClearSky(100.0, 20.0, 4.0);
  scene->SetEnvironment(sky);
}

bool Named(const Parameter& parameter, bool good)
{
  if (!good)
  {
    std::cerr << NameOf(parameter.Of) << "." << parameter.Name << " is left out" << std::endl;
  }
  return good;
}

std::string AttributeOf(const Parameter& parameter)
{
  return std::string("relief:") +
    (parameter.Of == Owner::Light            ? "light1:"
        : parameter.Of == Owner::Environment ? "environment:"
                                             : "") +
    parameter.Key;
}
}

int TestSceneParameterFiles(int argc, char* argv[])
{
  char* temporary =
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary");
  const std::string folder = std::string(temporary) + "/TestSceneParameterFiles/";
  delete[] temporary;
  vtksys::SystemTools::MakeDirectory(folder);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_FLOAT, 4);
  std::fill_n(static_cast<float*>(image->GetScalarPointer()), 16, 0.5f);

  for (const Parameter& parameter : All())
  {
    vtkNew<vtkReliefSceneFile> file;
    Fill(file->GetScene());
    vtkObject* owner = OwnerIn(file->GetScene(), parameter.Of);
    parameter.Set(owner, OtherValue(parameter));
    if (parameter.With)
    {
      const Parameter& with = Find(parameter.Of, parameter.With);
      with.Set(owner, { 1.0 * parameter.WithValue, 0.0, 0.0 });
    }
    const std::string text = file->ToText();
    CHECK(Named(parameter, text.find("\"" + parameter.Key + "\": ") != std::string::npos));
    vtkNew<vtkReliefSceneFile> back;
    CHECK(back->FromText(text));
    vtkObject* read = OwnerIn(back->GetScene(), parameter.Of);
    CHECK(Named(parameter, Same(owner, read)));

    // A light that is off is not in a picture.
    const bool off = parameter.Of == Owner::Light && parameter.Key == "on";
    vtkNew<vtkOpenEXRLayerWriter> writer;
    writer->SetInputData(image);
    if (off)
    {
      parameter.Set(owner, { 1.0, 0.0, 0.0 });
    }
    writer->SetScene(file->GetScene());
    const std::string name = folder + "header.exr";
    writer->SetFileName(name.c_str());
    writer->Write();
    const auto input = OIIO::ImageInput::open(name);
    CHECK(input && Named(parameter, input->spec().find_attribute(AttributeOf(parameter))));
  }

  // Where an environment's light comes from.
  vtkNew<vtkReliefScene> scene;
  Fill(scene);
  vtkNew<vtkOpenEXRLayerWriter> writer;
  writer->SetInputData(image);
  writer->SetScene(scene);
  const std::string name = folder + "sky.exr";
  writer->SetFileName(name.c_str());
  writer->Write();
  auto input = OIIO::ImageInput::open(name);
  CHECK(input->spec().get_string_attribute("relief:environment:image") == "clearSky");
  CHECK(input->spec().get_float_attribute("relief:environment:turbidity") == 4.0f);
  scene->GetEnvironment()->SetFileName("somewhere.exr");
  writer->Modified();
  writer->Write();
  input = OIIO::ImageInput::open(name);
  CHECK(input->spec().get_string_attribute("relief:environment:image") == "file");
  CHECK(input->spec().get_string_attribute("relief:environment:file") == "somewhere.exr");
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

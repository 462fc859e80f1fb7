// SPDX-License-Identifier: BSD-3-Clause

// What the plugin's tests compare with: the filter itself, with scenes that are set by its own
// methods. Writes into a folder heights.vtk, the same as cells.vtk, and for each case its picture
// as floats, with a list of the cases and of what was set:
//
//     reliefParaViewReference FOLDER
//
// A line of cases.txt is the name of the case, a space, and assignments: a parameter's owner, a
// dot, its name, = and its numbers, with commas; each with a space behind. There is a case for
// every parameter of the table, with another value than that of the case "base".

#include "SceneParameters.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkStructuredPoints.h"
#include "vtkStructuredPointsWriter.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace relief::parameters;

constexpr int Columns = 47;
constexpr int Rows = 39;

// Hills with a step and a hole: rough enough for every process's piece to be in another's shadow.
vtkSmartPointer<vtkStructuredPoints> MakeHeights()
{
  auto image = vtkSmartPointer<vtkStructuredPoints>::New();
  image->SetDimensions(Columns, Rows, 1);
  // As many digits as the file keeps.
  image->SetOrigin(4567.25, -123.5, 0.0);
  image->SetSpacing(2.5, 1.25, 1.0);
  vtkNew<vtkFloatArray> heights;
  heights->SetName("Elevation");
  for (int j = 0; j < Rows; ++j)
  {
    for (int i = 0; i < Columns; ++i)
    {
      const double hills = 6.0 * std::sin(0.31 * i) * std::cos(0.23 * j + 0.05 * i);
      const double step = i > 30 && j > 12 && j < 25 ? 9.0 : 0.0;
      const bool hole = (i - 12) * (i - 12) + (j - 20) * (j - 20) < 9;
      heights->InsertNextValue(hole ? -9999.0f : static_cast<float>(hills + step));
    }
  }
  image->GetPointData()->SetScalars(heights);
  return image;
}

// A scene in which nearly every parameter counts.
struct World
{
  vtkNew<vtkReliefScene> Scene;
  vtkNew<vtkReliefEnvironment> Environment;
  vtkSmartPointer<vtkLight> Sun;
  vtkNew<vtkLight> Lamp;
  std::string Told;

  World()
  {
    this->Environment->SetImageToClearSky(230.0, 35.0, 4.0);
    this->Scene->SetEnvironment(this->Environment);
    this->Sun = this->Scene->AddSun(230.0, 35.0);
    this->Lamp->SetLightTypeToSceneLight();
    this->Lamp->PositionalOn();
    this->Lamp->SetPosition(4600.0, -104.0, 25.0);
    this->Scene->AddLight(this->Lamp);
    this->Set("Environment", "NumberOfSamples", { 16, 0, 0 });
    this->Set("Environment", "Intensity", { 0.25, 0, 0 });
    this->Set("Sun", "AngularDiameter", { 4, 0, 0 });
    this->Set("Sun", "Intensity", { 0.5, 0, 0 });
    this->Set("Lamp", "Intensity", { 0.375, 0, 0 });
    this->Set("Material", "SpecularCoefficient", { 0.25, 0, 0 });
    this->Set("Material", "ForwardScatterCoefficient", { 0.5, 0, 0 });
    this->Set("Material", "ForwardScatterRange", { -1, 1, 0 });
    this->Set("Material", "SubsurfaceDepth", { 1.5, 0, 0 });
    this->Set("Material", "AutomaticSubsurfaceDepth", { 0, 0, 0 });
    this->Set("Material", "Attenuation", { 1, 0, 0 });
    this->Set("Material", "Density", { 0.25, 0, 0 });
    this->Set("Material", "UseFloor", { 1, 0, 0 });
    this->Set("Material", "FloorHeight", { -12, 0, 0 });
    this->Set("Material", "BaseColor", { 0.0625, 0.03125, 0 });
  }

  void Set(const std::string& owner, const std::string& name, const Values& values)
  {
    const bool ofLight = owner == "Sun" || owner == "Lamp";
    for (const Parameter& parameter : All())
    {
      if (parameter.Name == name && (ofLight ? "Light" : owner) == NameOf(parameter.Of))
      {
        vtkObject* object = owner == "Sun" ? static_cast<vtkObject*>(this->Sun)
          : owner == "Lamp"                ? this->Lamp.Get()
          : owner == "Scene"               ? static_cast<vtkObject*>(this->Scene.Get())
          : owner == "Material"            ? this->Scene->GetMaterial()
                                           : static_cast<vtkObject*>(this->Environment.Get());
        parameter.Set(object, values);
        this->Told += owner + "." + name + "=";
        for (int i = 0; i < Size(parameter); ++i)
        {
          this->Told += (i > 0 ? "," : "") + std::to_string(values[static_cast<std::size_t>(i)]);
        }
        this->Told += " ";
      }
    }
  }
};

// Another value than the default, and than the base's.
Values OtherValue(const Parameter& parameter)
{
  const std::string name = parameter.Name;
  switch (parameter.Is)
  {
    case Kind::Flag:
      return { name == "UseFloor"              ? 0.0
          : name == "AutomaticSubsurfaceDepth" ? 1.0
                                               : 1.0 - parameter.Default[0],
        0, 0 };
    case Kind::Choice:
      return { parameter.Default[0] == 0.0 && name != "Attenuation" ? 1.0 : 0.0, 0, 0 };
    case Kind::Color:
      return { 0.25, 0.5, 0.875 };
    case Kind::Range:
      return { -0.25, 0.75, 0 };
    case Kind::Count:
      return { name == "NumberOfSteps" ? 40.0 : 24.0, 0, 0 };
    case Kind::Length:
      return { 500.0, 0, 0 };
    default:
      return { std::round(
                 (parameter.SliderFrom + 0.375 * (parameter.SliderTo - parameter.SliderFrom)) *
                 1024.0) /
          1024.0,
        0, 0 };
  }
}

class Cases
{
public:
  explicit Cases(const std::string& folder)
    : Folder(folder)
    , List(folder + "/cases.txt")
    , Heights(MakeHeights())
  {
    this->Write(this->Heights, "heights.vtk");
    // The same as values of cells, whose middles are where the samples are.
    vtkNew<vtkStructuredPoints> cells;
    const double* origin = this->Heights->GetOrigin();
    const double* spacing = this->Heights->GetSpacing();
    cells->SetDimensions(Columns + 1, Rows + 1, 1);
    cells->SetSpacing(spacing[0], spacing[1], spacing[2]);
    cells->SetOrigin(origin[0] - spacing[0] / 2, origin[1] - spacing[1] / 2, origin[2]);
    cells->GetCellData()->SetScalars(this->Heights->GetPointData()->GetScalars());
    this->Write(cells, "cells.vtk");
  }

  void Write(vtkStructuredPoints* image, const char* name)
  {
    vtkNew<vtkStructuredPointsWriter> writer;
    writer->SetInputData(image);
    writer->SetFileTypeToBinary();
    writer->SetFileName((this->Folder + "/" + name).c_str());
    writer->Write();
  }

  void Shade(const std::string& name, vtkReliefScene* scene, const std::string& told)
  {
    vtkNew<vtkImageReliefShading> filter;
    filter->SetInputData(this->Heights);
    filter->SetNoDataValue(-9999.0);
    filter->SetScene(scene);
    filter->Update();
    vtkDataArray* picture = filter->GetOutput()->GetPointData()->GetScalars();
    if (!picture)
    {
      throw std::runtime_error("nothing was shaded in " + name);
    }
    std::ofstream file(this->Folder + "/" + name + ".raw", std::ios::binary);
    file.write(static_cast<const char*>(picture->GetVoidPointer(0)),
      static_cast<std::streamsize>(sizeof(float) * picture->GetNumberOfValues()));
    this->List << name << " " << told << "\n";
  }

  bool IsGood() { return static_cast<bool>(this->List << std::flush); }

private:
  std::string Folder;
  std::ofstream List;
  vtkSmartPointer<vtkStructuredPoints> Heights;
};

void ShadePresets(Cases& cases)
{
  const std::vector<std::pair<const char*, std::function<void(vtkReliefScene*)>>> presets = {
    { "usual", [](vtkReliefScene*) {} },
    { "multidirectional", [](vtkReliefScene* scene) { scene->SetLightsToMultidirectional(); } },
    { "sky-dome", [](vtkReliefScene* scene) { scene->SetLightsToSkyDome(); } },
    { "sun-and-sky", [](vtkReliefScene* scene) { scene->SetLightsToSunAndSky(120.0, 25.0); } },
  };
  for (const auto& [name, set] : presets)
  {
    vtkNew<vtkReliefScene> scene;
    set(scene);
    cases.Shade(name, scene, "");
  }
}
}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: reliefParaViewReference FOLDER\n";
    return EXIT_FAILURE;
  }
  try
  {
    Cases cases(argv[1]);
    ShadePresets(cases);
    World base;
    cases.Shade("base", base.Scene, base.Told);
    for (const Parameter& parameter : All())
    {
      const std::vector<std::string> owners = parameter.Of != Owner::Light
        ? std::vector<std::string>{ NameOf(parameter.Of) }
        : parameter.OfSuns ? std::vector<std::string>{ "Sun" }
                           : std::vector<std::string>{ "Sun", "Lamp" };
      for (const std::string& owner : owners)
      {
        World world;
        world.Set(owner, parameter.Name, OtherValue(parameter));
        cases.Shade(owner + "." + parameter.Name, world.Scene, world.Told);
      }
    }
    return cases.IsGood() ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception& e)
  {
    std::cerr << e.what() << "\n";
    return EXIT_FAILURE;
  }
}

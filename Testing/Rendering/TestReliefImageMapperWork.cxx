// SPDX-License-Identifier: BSD-3-Clause
//
// What the mapper tells of its work is what the filter tells, and it does nothing in vain: no ray
// for what light does not depend on, no conversion of a scene that has not changed.

#include "ReliefKeptWork.h"
#include "ReliefMapperTestUtilities.h"

#include "vtkInformation.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"

#include "ReliefOpenGL.h"

namespace
{

int Failures = 0;

vtkSmartPointer<vtkImageData> Terrain()
{
  return MakeHeights(70, 50, Hills(1));
}

// A light that counts how often its information is asked for. VTK's own rendering does not; what
// converts a sun does, for its angular diameter.
class CountingLight : public vtkLight
{
public:
  static CountingLight* New();
  vtkTypeMacro(CountingLight, vtkLight);
  vtkInformation* GetInformation() override
  {
    ++this->Asked;
    return this->Superclass::GetInformation();
  }
  int Asked = 0;
};
vtkStandardNewMacro(CountingLight);

void TestEffects(bool textured)
{
  vtkNew<vtkImageData> texture;
  texture->SetDimensions(70, 50, 1);
  texture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  texture->GetPointData()->GetScalars()->Fill(128.0);
  for (const SceneOfEffects& test : ScenesOfEffects())
  {
    MapperStage stage(Terrain());
    stage.Scene()->AddSun(315.0, 30.0);
    test.prepare(stage.Scene(), stage.Scene()->GetMaterial());
    vtkNew<vtkImageReliefShading> filter;
    filter->SetInputData(stage.mapper->GetInput());
    filter->SetScene(stage.Scene());
    if (textured)
    {
      filter->SetDiffuseTextureData(texture);
      filter->SetBaseTextureData(texture);
      filter->SetSpecularTextureData(texture);
      stage.mapper->SetDiffuseTextureData(texture);
      stage.mapper->SetBaseTextureData(texture);
      stage.mapper->SetSpecularTextureData(texture);
    }
    filter->Update();
    CHECK(stage.Render());
    const std::string expected = filter->GetStatistics()->GetEffectNames();
    const std::string given = stage.mapper->GetStatistics()->GetEffectNames();
    if (given != expected)
    {
      std::cout << test.name << ": '" << given << "', the filter tells '" << expected << "'"
                << std::endl;
      ++Failures;
    }
    CHECK(CompareColors(filter->GetOutput(), stage.Shading(), 6e-3).shareBeyond <= 1e-3);
  }
}

// With illuminations kept, and with sums only.
void TestRays(unsigned long cacheMemoryLimit)
{
  MapperStage stage(Terrain());
  stage.mapper->SetCacheMemoryLimit(cacheMemoryLimit);
  stage.Scene()->AddSun(315.0, 30.0);
  stage.Scene()->AddSun(100.0, 50.0);
  CHECK(stage.Render());
  vtkReliefStatistics* statistics = stage.mapper->GetStatistics();
  CHECK(statistics->GetLightsTraced() == 2);
  for (const SceneChange& change : ChangesOfAScene())
  {
    change.make(stage.Scene(), stage.Scene()->GetMaterial());
    CHECK(stage.Render());
    const vtkTypeInt64 expected = change.traces ? 2 * 70 * 50 : 0;
    if (statistics->GetRaysTraced() != expected)
    {
      std::cout << change.name << ": " << statistics->GetRaysTraced() << " rays, " << expected
                << " are expected" << std::endl;
      ++Failures;
    }
  }
}

// How many triangles a frame draws: two for each pass, and two for what shows the picture.
GLuint TrianglesOf(MapperStage& stage)
{
  GLuint query = 0;
  GLuint triangles = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_PRIMITIVES_GENERATED, query);
  CHECK(stage.Render());
  glEndQuery(GL_PRIMITIVES_GENERATED);
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &triangles);
  glDeleteQueries(1, &query);
  return triangles;
}

// While a light is dragged each frame draws no more passes than the lights ask for, compiles
// nothing, and traces that light's samples only: those in view, or all of their tiles.
void TestDragging()
{
  constexpr int size = 256;
  MapperStage stage(MakeHeights(size, size, Hills(1)));
  stage.mapper->SetTracingToProcessor();
  stage.window->SetSize(size / 2, size / 2);
  vtkLight* sun = stage.Scene()->AddSun(315.0, 30.0);
  vtkReliefStatistics* statistics = stage.mapper->GetStatistics();
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(stage.mapper->GetInput());
  filter->SetScene(stage.Scene());
  struct Step
  {
    int lights;
    double shine;  // k_s
    GLuint passes; // gather, compose
  };
  for (const Step& step :
    { Step{ 1, 0.0, 2 }, Step{ 1, 0.3, 2 }, Step{ 4, 0.0, 2 }, Step{ 8, 0.3, 3 } })
  {
    while (stage.Scene()->GetLights()->GetNumberOfItems() < step.lights)
    {
      stage.Scene()->AddSun(70.0 * stage.Scene()->GetLights()->GetNumberOfItems(), 40.0);
    }
    stage.Scene()->GetMaterial()->SetSpecularCoefficient(step.shine);
    CHECK(stage.Render());
    const int programs = stage.mapper->GetNumberOfPrograms();
    for (int frame = 0; frame < 3; ++frame)
    {
      sun->SetPosition(-1.0, 1.0 + 0.1 * frame, 1.0 + 0.05 * step.lights);
      CHECK(TrianglesOf(stage) == 2 * (step.passes + 1));
      CHECK(statistics->GetLightsTraced() == 1);
      CHECK(statistics->GetRaysTraced() == size / 2 * size / 2);
      const vtkTypeInt64 cells = statistics->GetCellsVisited();
      filter->Update();
      CHECK(cells > 0 && cells <= filter->GetStatistics()->GetCellsVisited());
    }
    CHECK(stage.mapper->GetNumberOfPrograms() == programs);
    // What has not changed is drawn again, and no more.
    CHECK(TrianglesOf(stage) == 2);
  }
}

void TestConversions()
{
  MapperStage stage(Terrain());
  vtkNew<CountingLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->SetPosition(30.0, 20.0, 90.0);
  stage.Scene()->AddLight(sun);
  // Whether a frame asks the light for anything.
  auto converts = [&]()
  {
    const int before = sun->Asked;
    CHECK(stage.Render());
    return sun->Asked > before;
  };
  CHECK(converts());
  CHECK(!converts() && !converts());
  stage.renderer->GetActiveCamera()->Zoom(1.5);
  CHECK(!converts());
  stage.slice->RotateZ(20.0); // takes the scene's lights with it
  CHECK(!converts());
  stage.Scene()->GetMaterial()->SetDensity(0.5);
  CHECK(converts() && !converts());
  sun->SetIntensity(0.5);
  CHECK(converts() && !converts());
  stage.Scene()->SetHeightScale(0.5);
  CHECK(converts() && !converts());
  stage.mapper->GetInput()->GetPointData()->GetScalars()->Modified();
  CHECK(converts() && !converts());
  stage.mapper->SetNoDataValue(20.0);
  CHECK(converts() && !converts());
  auto texture = MakeHeights<vtkUnsignedCharArray>(70, 50, Hills(2));
  stage.mapper->SetDiffuseTextureData(texture);
  CHECK(converts() && !converts());
  texture->Modified();
  CHECK(converts() && !converts());
  stage.Scene()->SetLightsToSkyDome();
  stage.Scene()->AddLight(sun);
  CHECK(converts() && !converts());
  stage.Scene()->GetEnvironment()->SetRotationZ(5.0);
  CHECK(converts() && !converts());

  // Another scene, made before the last change.
  vtkNew<vtkReliefScene> other;
  other->AddLight(sun);
  stage.Scene()->GetMaterial()->SetDensity(0.7);
  CHECK(converts());
  stage.mapper->SetScene(other);
  CHECK(converts() && !converts());

  // A renderer's light that stands in depends on where the slice is, and on its own transform.
  stage.Scene()->RemoveAllLights();
  stage.renderer->AddLight(sun);
  CHECK(converts() && !converts());
  stage.slice->RotateZ(20.0);
  CHECK(converts() && !converts());
  vtkNew<vtkMatrix4x4> transform;
  sun->SetTransformMatrix(transform);
  CHECK(converts() && !converts());
  transform->SetElement(0, 3, 7.0);
  CHECK(converts() && !converts());
  sun->SetPosition(20.0, 20.0, 90.0);
  CHECK(converts() && !converts());
  stage.renderer->RemoveAllLights();
  CHECK(!converts()); // the default sun
  stage.renderer->AddLight(sun);
  CHECK(converts() && !converts());
}

}

int TestReliefImageMapperWork(int, char*[])
{
  TestEffects(false);
  TestEffects(true);
  TestRays(262144);
  TestRays(0);
  TestDragging();
  TestConversions();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

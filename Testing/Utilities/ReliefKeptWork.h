// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefKeptWork_h
#define ReliefKeptWork_h

#include "vtkLight.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <functional>
#include <vector>

/// A change to a scene, and whether it changes where light falls.
struct SceneChange
{
  const char* name;
  std::function<void(vtkReliefScene*, vtkReliefMaterial*)> make;
  bool traces;
};

/// One after another, they lead through what illuminations depend on and what they do not, under
/// both attenuations and integrators. The scene at first: Reciprocal, no floor, Exact, at least a
/// light.
inline std::vector<SceneChange> ChangesOfAScene()
{
  using Scene = vtkReliefScene;
  using Material = vtkReliefMaterial;
  return {
    { "density under Reciprocal", [](Scene*, Material* m) { m->SetDensity(0.3); }, false },
    { "a floor's height without a floor", [](Scene*, Material* m) { m->SetFloorHeight(-3.0); },
      false },
    { "exposure", [](Scene* s, Material*) { s->SetExposure(-0.5); }, false },
    { "steps under Exact", [](Scene* s, Material*) { s->SetNumberOfSteps(40); }, false },
    { "Exponential", [](Scene*, Material* m) { m->SetAttenuationToExponential(); }, true },
    { "density under Exponential", [](Scene*, Material* m) { m->SetDensity(0.6); }, true },
    { "a floor", [](Scene*, Material* m) { m->UseFloorOn(); }, true },
    { "its height", [](Scene*, Material* m) { m->SetFloorHeight(-9.0); }, true },
    { "tolerance under Exact", [](Scene* s, Material*) { s->SetTolerance(0.01); }, true },
    { "FixedStep", [](Scene* s, Material*) { s->SetIntegratorToFixedStep(); }, true },
    { "tolerance under FixedStep", [](Scene* s, Material*) { s->SetTolerance(0.004); }, false },
    { "attenuation under FixedStep", [](Scene*, Material* m) { m->SetAttenuationToReciprocal(); },
      false },
    { "density under FixedStep", [](Scene*, Material* m) { m->SetDensity(0.1); }, false },
    { "a floor's height under FixedStep", [](Scene*, Material* m) { m->SetFloorHeight(-5.0); },
      false },
    { "no floor under FixedStep", [](Scene*, Material* m) { m->UseFloorOff(); }, false },
    { "steps under FixedStep", [](Scene* s, Material*) { s->SetNumberOfSteps(30); }, true },
    { "depth under FixedStep", [](Scene*, Material* m) { m->SetSubsurfaceDepth(2.5); }, true },
    { "Exact again", [](Scene* s, Material*) { s->SetIntegratorToExact(); }, true },
    { "offset along normals", [](Scene*, Material* m) { m->SetOffsetModeToSurfaceNormal(); },
      true },
    { "offset", [](Scene*, Material* m) { m->SetOffsetModeToVertical(); }, true },
    { "offset to the tangent plane", [](Scene*, Material* m) { m->SetOffsetModeToTangentPlane(); },
      true },
  };
}

/// A scene, and what it is called in messages.
struct SceneOfEffects
{
  const char* name;
  std::function<void(vtkReliefScene*, vtkReliefMaterial*)> prepare;
};

/// Scenes over all effects and what switches them off; a sun from the north-west shines, 30 degrees
/// high.
inline std::vector<SceneOfEffects> ScenesOfEffects()
{
  using Scene = vtkReliefScene;
  using Material = vtkReliefMaterial;
  auto shine = [](double ks)
  { return [ks](Scene*, Material* m) { m->SetSpecularCoefficient(ks); }; };
  auto scatter = [](double kf, double lo)
  {
    return [kf, lo](Scene*, Material* m)
    {
      m->SetForwardScatterCoefficient(kf);
      m->SetForwardScatterRange(lo, 1.0);
    };
  };
  return { { "a sun", [](Scene*, Material*) {} },
    { "upright", [](Scene*, Material* m) { m->SetOffsetModeToVertical(); } },
    { "along normals", [](Scene*, Material* m) { m->SetOffsetModeToSurfaceNormal(); } },
    { "along normals, nothing but highlights",
      [](Scene*, Material* m)
      {
        m->SetOffsetModeToSurfaceNormal();
        m->SetSpecularCoefficient(1.0);
      } },
    { "along normals, black",
      [](Scene*, Material* m)
      {
        m->SetOffsetModeToSurfaceNormal();
        m->SetDiffuseColor(0.0, 0.0, 0.0);
      } },
    { "along normals, fixed steps",
      [](Scene* s, Material* m)
      {
        m->SetOffsetModeToSurfaceNormal();
        s->SetIntegratorToFixedStep();
      } },
    { "along normals, a sun below",
      [](Scene* s, Material* m)
      {
        m->SetOffsetModeToSurfaceNormal();
        s->RemoveAllLights();
        s->AddSun(10.0, -20.0);
      } },
    { "highlights", shine(0.4) }, { "nothing but highlights", shine(1.0) },
    { "black highlights",
      [](Scene*, Material* m)
      {
        m->SetSpecularCoefficient(0.4);
        m->SetSpecularColor(0.0, 0.0, 0.0);
      } },
    { "scattering", scatter(0.5, -1.0) }, { "all scattered", scatter(1.0, -1.0) },
    { "all scattered, none this way", scatter(1.0, 0.0) },
    { "combined with slope", [](Scene* s, Material*) { s->SetResponseToCombined(); } },
    { "by slope and aspect", [](Scene* s, Material*) { s->SetResponseToIgor(); } },
    { "a light that is off",
      [](Scene* s, Material*)
      {
        s->RemoveAllLights();
        s->AddSun(0.0, 45.0)->SwitchOff();
      } } };
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefScene
 * @brief   material, lights and accuracy: everything a relief is shaded with but its heights
 *
 * One scene drives every host of the model, so that all give one picture. Lights are vtkLights:
 *  - a light that is not Positional is a sun: it shines from the direction of its position, seen
 * from its focal point;
 *  - a Positional one stands at its position, in world coordinates, in the unit of the spacing.
 *
 * A light's diffuse colour (linear RGB), intensity, switch and transform matrix count. Its cone,
 * attenuation, ambient and specular colours are not part of the model. Lights add up: two are
 * brighter than one. A scene without lights is lit as cartographers do, by one white sun at azimuth
 * 315, altitude 45.
 *
 * A setter that is given a value outside its range reports an error and keeps the old value.
 *
 * @sa vtkReliefMaterial vtkImageReliefShading
 */
#ifndef vtkReliefScene_h
#define vtkReliefScene_h

#include "vtkNew.h" // For vtkNew
#include "vtkObject.h"
#include "vtkReliefShadingModule.h" // For export macro
#include "vtkSmartPointer.h"        // For vtkSmartPointer

class vtkLight;
class vtkLightCollection;
class vtkReliefMaterial;

class VTKRELIEFSHADING_EXPORT vtkReliefScene : public vtkObject
{
public:
  static vtkReliefScene* New();
  vtkTypeMacro(vtkReliefScene, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material. Never null: setting null is refused. Default: a new vtkReliefMaterial.
   */
  void SetMaterial(vtkReliefMaterial* material);
  vtkReliefMaterial* GetMaterial();
  ///@}

  ///@{
  /**
   * The lights. A light that is added twice counts once.
   */
  void AddLight(vtkLight* light);
  void RemoveLight(vtkLight* light);
  void RemoveAllLights();
  vtkLightCollection* GetLights();
  ///@}

  /**
   * Adds a white sun and returns it, owned by the scene. The azimuth is measured clockwise from
   * north
   * (+y), the altitude up from the horizon, both in degrees and exact at multiples of 90. Any
   * finite azimuth is taken, and an altitude in [-90, 90]; outside that an error is reported and
   * null returned.
   */
  vtkLight* AddSun(double azimuth, double altitude);

  ///@{
  /**
   * What heights are multiplied by. Unit of the spacing per unit of the heights, finite; negative
   * values turn the relief inside out. Default: 1.
   */
  void SetHeightScale(double value);
  vtkGetMacro(HeightScale, double);
  ///@}

  enum Integrators
  {
    Exact = 0,
    FixedStep = 1
  };

  ///@{
  /**
   * How the thickness is measured: in closed form, cell by cell, or by counting a fixed number of
   * points along the ray as the thesis does (Algorithm 1, section 4.3.1), which knows neither
   * Attenuation, Tolerance nor floor and is kept for comparison. Default: Exact.
   */
  void SetIntegrator(int integrator);
  vtkGetMacro(Integrator, int);
  void SetIntegratorToExact() { this->SetIntegrator(Exact); }
  void SetIntegratorToFixedStep() { this->SetIntegrator(FixedStep); }
  ///@}

  ///@{
  /**
   * How far the illumination d of the Exact integrator may be from the exact sum, at every sample.
   * The error shows multiplied by the light's intensity: lower the tolerance for very bright
   * lights. No unit, at least 0; 0 asks for all that single precision gives. Default: 0.002, less
   * than half a step of 8-bit output.
   */
  void SetTolerance(double value);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Steps along a ray of the FixedStep integrator. In [1, 1000000]. Default: 256.
   */
  void SetNumberOfSteps(int value);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  /**
   * Changes with the material and the lights.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkReliefScene();
  ~vtkReliefScene() override;

  vtkSmartPointer<vtkReliefMaterial> Material;
  vtkNew<vtkLightCollection> Lights;
  double HeightScale = 1.0;
  int Integrator = Exact;
  double Tolerance = 0.002;
  int NumberOfSteps = 256;

private:
  vtkReliefScene(const vtkReliefScene&) = delete;
  void operator=(const vtkReliefScene&) = delete;
};

#endif

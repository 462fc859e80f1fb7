// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVReliefScene
 * @brief   a scene that ParaView's properties set, in any order
 *
 * ParaView sends the properties that have changed in the alphabetical order of their names. Setters
 * of vtkReliefScene and vtkReliefMaterial mean something by their order: a depth that is set turns
 * the automatic one off. Here settings are noted only; Update() then makes the scene of all of them
 * at once, in the order of the table of parameters. Hosts call it before they look at the scene.
 *
 * Parameters of the table are set by name, so that a new one needs nothing here. What is not in the
 * table are lights: which there are, where they stand, and the environment's image.
 *
 * @sa vtkReliefScene vtkPVReliefShading vtkPVReliefRepresentation
 */
#ifndef vtkPVReliefScene_h
#define vtkPVReliefScene_h

#include "vtkParaViewReliefShadingModule.h" // For export macro
#include "vtkReliefScene.h"

#include <memory> // For std::unique_ptr

class VTKPARAVIEWRELIEFSHADING_EXPORT vtkPVReliefScene : public vtkReliefScene
{
public:
  static vtkPVReliefScene* New();
  vtkTypeMacro(vtkPVReliefScene, vtkReliefScene);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A parameter of the table, by its owner and name with a dot between: "Scene.HeightScale",
   * "Material.Density", "Environment.Tilt"; those of a light are of the "Sun" or the "Lamp":
   * "Sun.Intensity". As many numbers as the parameter has. A value that the table does not take is
   * refused with an error, and the old one stays. A length, which may be infinite, is so at 0.
   * Default: the table's, but the sun's intensity is that of
   * vtkReliefScene::SetLightsToDefault.
   */
  void SetParameter(const char* name, double value);
  void SetParameter(const char* name, double first, double second);
  void SetParameter(const char* name, double first, double second, double third);
  ///@}

  enum LightingModes
  {
    SUN = 0,
    MULTIDIRECTIONAL = 1,
    SKY_DOME = 2,
    SUN_AND_SKY = 3,
    SUN_AND_ENVIRONMENT = 4
  };

  ///@{
  /**
   * Where light comes from. SUN: one sun. MULTIDIRECTIONAL, SKY_DOME and SUN_AND_SKY: as
   * vtkReliefScene's methods of these names; of the settings of sun and environment, only the
   * direction counts, for the last of them. SUN_AND_ENVIRONMENT: one sun, and an environment whose
   * image EnvironmentSource tells. Default: SUN. Range: 0 to 4, clamped.
   */
  void SetLighting(int mode);
  ///@}

  ///@{
  /**
   * Where the sun stands: clockwise from north, +y, and above the horizon. Degrees; any finite
   * azimuth, an altitude in [-90, 90], from 0 with SUN_AND_SKY; other values are told by an error
   * when the scene is made. Default: 315 and 45.
   */
  void SetSunAzimuth(double degrees);
  void SetSunAltitude(double degrees);
  ///@}

  ///@{
  /**
   * Whether the sun stands where it does at a time and a place, as vtkReliefScene::AddSunAt takes
   * them, in place of azimuth and altitude. The convergence, degrees clockwise from true north to
   * +y, is taken off. Default: off; no time; longitude, latitude, convergence and elevation 0; with
   * refraction.
   */
  void SetSunByTime(bool byTime);
  void SetSunTime(const char* time);
  void SetSunPlace(double longitude, double latitude);
  void SetSunConvergence(double degrees);
  void SetSunElevation(double meters);
  void SetSunRefraction(bool refraction);
  ///@}

  enum EnvironmentSources
  {
    WHITE_DOME = 0,
    CLEAR_SKY = 1,
    IMAGE_FILE = 2
  };

  ///@{
  /**
   * The environment's image: white above the horizon; the clear sky of the sun's direction, as hazy
   * as Turbidity says, in [2, 10]; or a latitude-longitude image of the file EnvironmentFile, which
   * every process reads. Default: WHITE_DOME; 3; no file.
   */
  void SetEnvironmentSource(int source);
  void SetTurbidity(double turbidity);
  void SetEnvironmentFile(VTK_FILEPATH const char* fileName);
  ///@}

  ///@{
  /**
   * Whether a lamp shines too, at a place in world coordinates, in the unit of the spacing; heights
   * count from the image's own plane. Default: off; (0, 0, 1).
   */
  void SetUseLamp(bool use);
  void SetLampPosition(double x, double y, double z);
  ///@}

  /**
   * Whether the height scale is chosen from the heights, as vtkReliefScene::FitHeightScale does, in
   * place of the parameter. Default: off.
   */
  void SetFitHeightScale(bool fit);

  /**
   * Makes the scene of the settings, if one has changed, for these heights, a mask, which may be
   * null, and the value that means no data, NaN for none. Errors are told once.
   */
  void Update(vtkImageData* heights, vtkImageData* mask, double noData);

protected:
  vtkPVReliefScene();
  ~vtkPVReliefScene() override;

private:
  vtkPVReliefScene(const vtkPVReliefScene&) = delete;
  void operator=(const vtkPVReliefScene&) = delete;

  bool PlaceSun();
  void MakeLights();
  void AddOwnSun();
  void AddLamp();
  void AddEnvironment();
  template <class Value>
  void Note(Value& held, const Value& value);

  struct Settings;
  std::unique_ptr<Settings> Internal;
};

#endif

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
 * brighter than one. An environment is light from all around, and adds to the lights. A scene with
 * neither lights nor environment is lit as cartographers do, by one white sun at azimuth 315,
 * altitude 45 (SetLightsToDefault).
 *
 * A setter that is given a value outside its range reports an error and keeps the old value.
 *
 * @sa vtkReliefMaterial vtkReliefEnvironment vtkImageReliefShading
 */
#ifndef vtkReliefScene_h
#define vtkReliefScene_h

#include "vtkNew.h" // For vtkNew
#include "vtkObject.h"
#include "vtkReliefShadingModule.h" // For export macro
#include "vtkSmartPointer.h"        // For vtkSmartPointer

class vtkImageData;
class vtkInformationDoubleKey;
class vtkLight;
class vtkLightCollection;
class vtkReliefEnvironment;
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
   * north (+y), the altitude up from the horizon, both in degrees and exact at multiples of 90. Any
   * finite azimuth is taken, an altitude in [-90, 90] and an angular diameter as SetAngularDiameter
   * takes it; outside that an error is reported and null returned.
   */
  vtkLight* AddSun(double azimuth, double altitude, double angularDiameter = 0.0);

  /**
   * Adds the sun of a time and a place, white, and returns it as AddSun does. The time is a date
   * and time of ISO 8601 with its zone, "2026-06-21T06:30+02:00" or "2026-06-21T04:30Z", of the
   * years 1600 to 2399; without a zone it is refused, since it means another moment everywhere.
   * Degrees of longitude are to the east, in [-180, 360], of latitude to the north, in [-90, 90].
   *
   * Azimuths are told from true north, while +y is the map's. The convergence, degrees clockwise
   * from true north to +y, is taken off; vtkReliefRasterReader::GetPlace has all three. Air bends
   * sunlight by the standard atmosphere at an elevation, metres above sea level in [-1000, 11000];
   * without refraction there is no air. At night the sun is below the horizon, and gives no light.
   * What is not taken reports an error, and null is returned.
   */
  vtkLight* AddSunAt(const char* time, double longitude, double latitude, double convergence = 0.0,
    double elevation = 0.0, bool refraction = true);

  /**
   * Where the sun of a time and a place stands: its azimuth from true north, in [0, 360), and its
   * altitude, in degrees. Time, place and air as AddSunAt takes them. Within 0.01 degrees of
   * NREL's solar position algorithm. Returns false after an error, which leaves the angles alone.
   */
  bool FindSun(const char* time, double longitude, double latitude, double elevation,
    bool refraction, double angles[2]);

  ///@{
  /**
   * How large a sun looks: its light then comes from a disc, and shadows get penumbras as wide as
   * the distance to what throws them makes them. Degrees, in [0, 90]; the real sun's is 0.533. 0 is
   * a point. Default: 0. Means nothing for a positional light. What of the disc is below the
   * horizon gives no more light than a sun there. A null light and other values are refused.
   */
  void SetAngularDiameter(vtkLight* light, double degrees);
  static double GetAngularDiameter(vtkLight* light);
  static vtkInformationDoubleKey* ANGULAR_DIAMETER();
  ///@}

  ///@{
  /**
   * How many lights stand for a sun that has an angular diameter; each is traced. A shadow's edge
   * has about as many steps. In [1, 4096]. Default: 16.
   */
  void SetNumberOfSunSamples(int value);
  vtkGetMacro(NumberOfSunSamples, int);
  ///@}

  ///@{
  /**
   * Light from all around. Default: null, none.
   */
  void SetEnvironment(vtkReliefEnvironment* environment);
  vtkReliefEnvironment* GetEnvironment();
  ///@}

  /**
   * One white sun as cartographers have it, at azimuth 315 and altitude 45, of intensity 0.95: what
   * faces it squarely is not pure white yet. A scene without lights and environment is lit by it.
   * Replaces all lights and the environment.
   */
  void SetLightsToDefault();

  /**
   * Four white suns of intensity 1/4 at altitude 30, from south-west, west, north-west and north
   * (azimuths 225, 270, 315 and 360), after R. Mark, "Multidirectional, oblique-weighted,
   * shaded-relief image of the Island of Hawaii", USGS Open-File Report 92-422 (1992). Mark weighs
   * each sun by the squared sine of the angle between it and a slope's aspect; a light is as strong
   * on all slopes, and 1/4 is the mean of his weights over all aspects. Replaces all lights and the
   * environment.
   */
  void SetLightsToMultidirectional();

  /**
   * A uniform white sky, as sky-view maps have it: hollows darken, ridges stand out, no side is
   * preferred. An environment of 128 samples, of which 64 are above the horizon, and of intensity
   * 0.62: level ground gets that much, and what stands out up to 1. Replaces all lights and the
   * environment.
   */
  void SetLightsToSkyDome();

  /**
   * The real sun (0.533 degrees, intensity 0.55, reddened by the air) and a clear sky that gives
   * level ground 0.2, for turbidity 3: together less than 1 but for the brightest hundredth of a
   * steep terrain. The azimuth is finite, the altitude in [0, 90] degrees;
   * otherwise an error is reported and the lights are kept. Replaces all lights and the
   * environment.
   */
  void SetLightsToSunAndSky(double azimuth, double altitude);

  ///@{
  /**
   * One white sun of intensity 1, and the Response Combined or Igor: level ground is white, and the
   * steeper a slope and the farther from the light, the darker. As gdaldem's options -combined and
   * -igor have them, but that shadows count in the first. The azimuth is finite, the altitude in
   * [-90, 90] degrees; otherwise an error is reported and nothing is changed. Replaces all lights
   * and the environment; the other presets leave Response as it is.
   */
  void SetLightsToCombined(double azimuth, double altitude);
  void SetLightsToIgor(double azimuth);
  ///@}

  ///@{
  /**
   * What heights are multiplied by. Unit of the spacing per unit of the heights, finite; negative
   * values turn the relief inside out. Default: 1.
   */
  void SetHeightScale(double value);
  vtkGetMacro(HeightScale, double);
  ///@}

  ///@{
  /**
   * Chooses HeightScale for heights that have no unit, as the values of a picture have none, and
   * returns it. It goes by the field's slopes: about the steepest quarter of them becomes 35
   * degrees and more, unless the relief would then be higher than a fifth of the image's longer
   * side; level parts do not count. So it depends neither on the number type nor on what is added
   * to all heights, and heights that are multiplied get a scale that is divided. It has six
   * significant digits, so that it can be told and given to SetHeightScale again, and is always
   * positive.
   *
   * The image's spacing, the mask, which may be null, and the value that means no data are taken as
   * vtkImageReliefShading takes them. A field without relief or data, or of a single row or column,
   * gives 1. Where the image cannot be shaded an error is reported and the scale is kept.
   */
  double FitHeightScale(vtkImageData* heights, vtkImageData* mask = nullptr);
  double FitHeightScale(vtkImageData* heights, vtkImageData* mask, double noData);
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
   * lights. For the samples of an environment it is shared out: their summed colour errs by no more
   * than the tolerance times the intensity and the mean colour of the environment. No unit, at
   * least 0; 0 asks for all that single precision gives. Default: 0.0003, less than a step of
   * 8-bit output at intensity 1 and exposure 0, in the darkest shadows too.
   */
  void SetTolerance(double value);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * How bright the picture is shown: colours are multiplied by 2 to the power of it where they
   * become 8-bit numbers, in 8-bit output and on the screen; float output and layers are left
   * alone. In stops, in [-20, 20]. Used while AutomaticExposure is off; setting it turns that off.
   * Default: 0.
   */
  void SetExposure(double value);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * Whether the exposure is found from the picture: 99.5 % of its samples are then darker than pure
   * white, and no more so than that asks for. It is found from at most 2^18 samples, spread over
   * the whole image, so it depends neither on the part of it that is asked for nor on the number of
   * threads; vtkReliefStatistics tells it. Images that are to be put side by side want one Exposure
   * for all. Default: off.
   */
  vtkSetMacro(AutomaticExposure, bool);
  vtkGetMacro(AutomaticExposure, bool);
  vtkBooleanMacro(AutomaticExposure, bool);
  ///@}

  ///@{
  /**
   * Steps along a ray of the FixedStep integrator. In [1, 1000000]. Default: 256.
   */
  void SetNumberOfSteps(int value);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  enum Responses
  {
    Illumination = 0,
    Combined = 1,
    Igor = 2
  };

  ///@{
  /**
   * How a surface answers a light, in the diffuse and the scatter term. Illumination: by the share
   * d of its light that reaches it. Combined: the encoded grey is 1 - s a (2 / pi)^2, s the slope
   * and a the angle whose cosine is the lesser of d and n * l, both in radians, after GDAL's
   * combined shading, which knows no shadow. Igor: it is 1 - s b 2 / pi^2, b the angle on the map
   * between where the ground falls to and the light, after I. Maerevoet's shading; no ray is
   * traced. The layers do not depend on it. Default: Illumination.
   */
  void SetResponse(int response);
  vtkGetMacro(Response, int);
  void SetResponseToIllumination() { this->SetResponse(Illumination); }
  void SetResponseToCombined() { this->SetResponse(Combined); }
  void SetResponseToIgor() { this->SetResponse(Igor); }
  ///@}

  ///@{
  /**
   * Takes everything of another scene. DeepCopy makes a new material, new lights (with their
   * angular diameter and transform matrix) and a new environment, whose image is copied too.
   * ShallowCopy shares material, lights and environment with the other scene. CopySharingImage is a
   * DeepCopy but for the image, which both environments then have: enough to go back to, and
   * nothing that was made from the image is made anew.
   */
  void DeepCopy(vtkReliefScene* other);
  void ShallowCopy(vtkReliefScene* other);
  void CopySharingImage(vtkReliefScene* other);
  ///@}

  /**
   * Changes with the material, the lights and the environment.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkReliefScene();
  ~vtkReliefScene() override;

  vtkSmartPointer<vtkReliefMaterial> Material;
  vtkNew<vtkLightCollection> Lights;
  vtkSmartPointer<vtkReliefEnvironment> Environment;
  // Their defaults are in the table of parameters.
  double HeightScale{};
  int Integrator{};
  double Tolerance{};
  int NumberOfSteps{};
  int Response{};
  int NumberOfSunSamples{};
  double Exposure{};
  bool AutomaticExposure{};

private:
  void CopyAllBut(vtkReliefScene* other, vtkReliefEnvironment* environment);

  vtkReliefScene(const vtkReliefScene&) = delete;
  void operator=(const vtkReliefScene&) = delete;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefEnvironment
 * @brief   light from all around a relief, from a latitude-longitude image
 *
 * The image wraps the inside of a sphere about the relief. Its top row (the last row of the
 * vtkImageData, as vtkOpenImageIOReader gives it) begins at the zenith, +z, its bottom row ends at
 * the nadir. Its first column begins at +x (east), and the columns run counter-clockwise seen from
 * above: a quarter of the way stands +y (north). A texel has one colour all over.
 *
 * The relief is lit by NumberOfSamples lights that stand for patches of the sphere. Each has the
 * mean colour of its patch, so the light's sum is the image's own at every number. A plane under a
 * uniform white sky is white. Sampling says how the patches are laid out.
 *
 * <b>Colours.</b> 1 component is grey, 2 are grey and alpha, 3 red, green and blue, 4 these and
 * alpha; alpha is ignored. Of unsigned char and unsigned short the values are sRGB-encoded over
 * their full range, and decoded; float and double are linear. Other types are refused. A texel with
 * a channel that is NaN, infinite or above 1e30 becomes black, and a negative channel becomes 0;
 * one warning counts such texels whenever the image has changed.
 *
 * <b>Cost.</b> Every light that can show is traced: a directional light below the horizon shows
 * only where the relief has a floor, and a black one never. Turning with RotationZ keeps the
 * patches of Uniform and SolidAngle in place and changes colours only. The lights are kept until
 * something that they depend on changes. The scene's tolerance is shared out to the lights, so that
 * the colour errs by no more than it times Intensity times the image's mean colour.
 *
 * A setter that is given a value outside its range reports an error and keeps the old value.
 *
 * @sa vtkReliefScene vtkOpenImageIOReader
 */
#ifndef vtkReliefEnvironment_h
#define vtkReliefEnvironment_h

#include "vtkObject.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkImageData;

class VTKRELIEFSHADING_EXPORT vtkReliefEnvironment : public vtkObject
{
public:
  static vtkReliefEnvironment* New();
  vtkTypeMacro(vtkReliefEnvironment, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The image, one slice. Update the reader that it comes from first. What is wrong with an image
   * is reported when a relief is shaded with it. Default: null, which gives no light.
   */
  void SetImage(vtkImageData* image);
  vtkImageData* GetImage();
  ///@}

  /**
   * Sets a new image of two texels: white above the horizon, black below. Level ground becomes
   * white; slopes and hollows see less of the sky.
   */
  void SetImageToWhiteDome();

  /**
   * Sets a new image of a sky without clouds, black below the horizon, after A. J. Preetham, P.
   * Shirley and B. Smits, "A practical analytic model for daylight", SIGGRAPH 1999. The sun itself
   * is not in it; add it with vtkReliefScene::AddSun. The sky gives level white ground, by itself,
   * the luminance 1. The azimuth of the sun is finite, in degrees clockwise from north, its
   * altitude in [0, 90] degrees. The turbidity tells how hazy the air is, in [2, 10]; 2 is very
   * clear. Other values are refused, and the old image is kept.
   */
  void SetImageToClearSky(double azimuth, double altitude, double turbidity = 3.0);

  enum ImageSources
  {
    UserImage = 0,
    WhiteDome = 1,
    ClearSky = 2,
    File = 3
  };

  ///@{
  /**
   * Where the image comes from, for files that name it instead of holding it (vtkReliefSceneFile).
   * SetImage makes it UserImage, whose origin is not known, until SetFileName tells which file it
   * was read from. FileName is null unless the source is File, and ClearSkyParameters, azimuth,
   * altitude and turbidity, mean nothing unless it is ClearSky.
   */
  vtkGetMacro(ImageSource, int);
  void SetFileName(VTK_FILEPATH const char* fileName);
  const char* GetFileName();
  vtkGetVector3Macro(ClearSkyParameters, double);
  ///@}

  ///@{
  /**
   * Turns the image about its own axis, counter-clockwise seen from above. Degrees, any finite
   * number. Default: 0.
   */
  void SetRotationZ(double value);
  vtkGetMacro(RotationZ, double);
  ///@}

  ///@{
  /**
   * Then turns it about +x (east), counter-clockwise seen from there: its zenith leans toward -y
   * (south). Degrees, any finite number. Default: 0.
   */
  void SetTilt(double value);
  vtkGetMacro(Tilt, double);
  ///@}

  ///@{
  /**
   * What colours are multiplied by. No unit, finite, at least 0. Default: 1.
   */
  void SetIntensity(double value);
  vtkGetMacro(Intensity, double);
  ///@}

  ///@{
  /**
   * How far away the light is. Infinite: every sample is a directional light. Finite: positional
   * lights on a sphere about the middle of the relief, half way between its lowest and highest
   * sample; then light comes from below the horizon too, wherever it finds a way. Unit of the
   * spacing, above 0. Default: infinite.
   */
  void SetRadius(double value);
  vtkGetMacro(Radius, double);
  void SetRadiusToInfinity();
  ///@}

  enum Samplings
  {
    Uniform = 0,
    SolidAngle = 1,
    Importance = 2
  };

  ///@{
  /**
   * How the sphere is divided.
   *  - Uniform: in equal steps of azimuth and polar angle, each of weight 1 / NumberOfSamples, as
   *    the thesis does (section 4.3.2.2). Patches at the poles count too much: the picture is not
   *    the one that physics gives, and level ground under a white sphere has 1 / pi. Kept for
   *    comparison.
   *  - SolidAngle: in patches of equal solid angle. For smooth light.
   *  - Importance: in small patches where there is much and uneven light, and in large ones
   *    elsewhere. For images with a sun or lamps. Nothing is spent on black parts, so there may be
   *    fewer lights than NumberOfSamples.
   *
   * Default: SolidAngle.
   */
  void SetSampling(int sampling);
  vtkGetMacro(Sampling, int);
  void SetSamplingToUniform() { this->SetSampling(Uniform); }
  void SetSamplingToSolidAngle() { this->SetSampling(SolidAngle); }
  void SetSamplingToImportance() { this->SetSampling(Importance); }
  ///@}

  ///@{
  /**
   * The number of lights over the whole sphere: half of them are above the horizon, with Importance
   * most. In [1, 65536]; best a multiple of 8, which treats all four sides alike. Default: 64.
   */
  void SetNumberOfSamples(int value);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * Takes everything of another environment. DeepCopy makes a new image, ShallowCopy shares it:
   * lights that were made from it need not be made again.
   */
  void DeepCopy(vtkReliefEnvironment* other);
  void ShallowCopy(vtkReliefEnvironment* other);
  ///@}

  /**
   * Changes with the image.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkReliefEnvironment();
  ~vtkReliefEnvironment() override;

  int ImageSource = UserImage;
  std::string FileName;
  double ClearSkyParameters[3] = { 0.0, 0.0, 0.0 };
  // Their defaults are in the table of parameters.
  double RotationZ{};
  double Tilt{};
  double Intensity{};
  double Radius{};
  int Sampling{};
  int NumberOfSamples{};

private:
  void CopyAllBut(vtkReliefEnvironment* other, vtkImageData* image);

  vtkReliefEnvironment(const vtkReliefEnvironment&) = delete;
  void operator=(const vtkReliefEnvironment&) = delete;

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif

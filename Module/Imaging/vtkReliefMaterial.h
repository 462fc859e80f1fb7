// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefMaterial
 * @brief   what a relief is made of: colours, highlights, translucency
 *
 * The material of the integrated shading model (F. N. Pramananda Perumal, MSc thesis, Texas A&M
 * University, 2017; section signs below are the thesis's). For one light of colour c_L and
 * intensity I a sample's colour is
 *
 *     c = (1 - k_s) (c_B + ((1 - k_f) + k_f f) d I c_D c_L) + k_s s I c_S c_L
 *
 * where d says how much of the light gets through the material, s is the specularity and f the
 * forward scattering. Colours are linear RGB. A setter that is given a value outside its range
 * reports an error and keeps the old value.
 *
 * @sa vtkReliefScene vtkImageReliefShading
 */
#ifndef vtkReliefMaterial_h
#define vtkReliefMaterial_h

#include "vtkObject.h"
#include "vtkReliefShadingModule.h" // For export macro

class VTKRELIEFSHADING_EXPORT vtkReliefMaterial : public vtkObject
{
public:
  static vtkReliefMaterial* New();
  vtkTypeMacro(vtkReliefMaterial, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * c_B, the colour that a sample has without any light. Linear RGB, components of at least 0.
   * Default: black.
   */
  void SetBaseColor(double r, double g, double b);
  void SetBaseColor(const double rgb[3]) { this->SetBaseColor(rgb[0], rgb[1], rgb[2]); }
  vtkGetVector3Macro(BaseColor, double);
  ///@}

  ///@{
  /**
   * c_D, the colour of the light that has passed through the material. Linear RGB, components of at
   * least 0. Default: white.
   */
  void SetDiffuseColor(double r, double g, double b);
  void SetDiffuseColor(const double rgb[3]) { this->SetDiffuseColor(rgb[0], rgb[1], rgb[2]); }
  vtkGetVector3Macro(DiffuseColor, double);
  ///@}

  ///@{
  /**
   * c_S, the colour of highlights. Linear RGB, components of at least 0. Default: white.
   */
  void SetSpecularColor(double r, double g, double b);
  void SetSpecularColor(const double rgb[3]) { this->SetSpecularColor(rgb[0], rgb[1], rgb[2]); }
  vtkGetVector3Macro(SpecularColor, double);
  ///@}

  ///@{
  /**
   * k_s, the share of highlights in the colour (section 3.4): 0 for none, 1 for a mirror, which
   * shows neither the base nor the diffuse colour. No unit, in [0, 1]. Default: 0.
   */
  void SetSpecularCoefficient(double value);
  vtkGetMacro(SpecularCoefficient, double);
  ///@}

  ///@{
  /**
   * k_f, the share of the diffuse light that is scattered forward and so is seen when the light is
   * behind the relief (section 3.3.1.1). No unit, in [0, 1]. Default: 0.
   */
  void SetForwardScatterCoefficient(double value);
  vtkGetMacro(ForwardScatterCoefficient, double);
  ///@}

  ///@{
  /**
   * Where the highlight begins (lo) and is full (hi), as the cosine of the angle between the light
   * and the mirrored view (section 4.3.6). Finite, lo <= hi; where they are equal the highlight is
   * a step at hi. Default: (0, 1).
   */
  void SetSpecularRange(double lo, double hi);
  void SetSpecularRange(const double range[2]) { this->SetSpecularRange(range[0], range[1]); }
  vtkGetVector2Macro(SpecularRange, double);
  ///@}

  ///@{
  /**
   * The exponent of the highlight's falloff: above 1 it gathers at the hi end, below 1 it widens; 0
   * makes it full everywhere. No unit, at least 0. Default: 1.
   */
  void SetSpecularPower(double value);
  vtkGetMacro(SpecularPower, double);
  ///@}

  ///@{
  /**
   * Where forward scattering begins (lo) and is full (hi), as the cosine of the angle between the
   * view and the light's way: 1 for a light straight behind, 0 for one at the horizon, negative for
   * one in front. Finite, lo <= hi; where they are equal it is a step at hi. Default: (0, 1).
   */
  void SetForwardScatterRange(double lo, double hi);
  void SetForwardScatterRange(const double range[2])
  {
    this->SetForwardScatterRange(range[0], range[1]);
  }
  vtkGetVector2Macro(ForwardScatterRange, double);
  ///@}

  ///@{
  /**
   * The exponent of forward scattering's falloff. No unit, at least 0. Default: 1.
   */
  void SetForwardScatterPower(double value);
  vtkGetMacro(ForwardScatterPower, double);
  ///@}

  ///@{
  /**
   * t, how far below the surface light is gathered (section 3.2.1): small values give crisp,
   * stone-like shading, large ones a soft, wax-like look. In the unit of heights and spacing, at
   * least 0; 0 means the limit of t -> 0, an opaque material. Used while AutomaticSubsurfaceDepth
   * is off; setting it turns that off. Default: 1.
   */
  void SetSubsurfaceDepth(double value);
  vtkGetMacro(SubsurfaceDepth, double);
  ///@}

  ///@{
  /**
   * Whether t is the mean of the spacing of the samples along x and y. Default: on.
   */
  vtkSetMacro(AutomaticSubsurfaceDepth, bool);
  vtkGetMacro(AutomaticSubsurfaceDepth, bool);
  vtkBooleanMacro(AutomaticSubsurfaceDepth, bool);
  ///@}

  /**
   * t for samples of this spacing along x and y: SubsurfaceDepth, or the mean of the spacing.
   */
  double GetDepthFor(const double spacing[2]);

  enum OffsetModes
  {
    Vertical = 0,
    SurfaceNormal = 1,
    TangentPlane = 2
  };

  ///@{
  /**
   * The way down to the shading point: straight down by t (section 4.3.1); by t against the
   * surface normal n (section 3.2.1.1); or straight down until it lies t below the tangent plane,
   * by min(t / n_z, 2 t). With the last two a plane's illumination is exactly the cosine of the
   * light's angle (with TangentPlane up to slopes of 60 degrees). TangentPlane takes as long as
   * Vertical, with which slopes that face a high light reach full brightness and then look flat;
   * SurfaceNormal takes longer. Default: TangentPlane.
   */
  void SetOffsetMode(int mode);
  vtkGetMacro(OffsetMode, int);
  void SetOffsetModeToVertical() { this->SetOffsetMode(Vertical); }
  void SetOffsetModeToSurfaceNormal() { this->SetOffsetMode(SurfaceNormal); }
  void SetOffsetModeToTangentPlane() { this->SetOffsetMode(TangentPlane); }
  ///@}

  enum Attenuations
  {
    Reciprocal = 0,
    Exponential = 1
  };

  ///@{
  /**
   * How the thickness r that the light has passed through dims it: d = min(1, t / r), or
   * d = exp(-Density * max(r - t, 0)) (section 3.3.1.2). Default: Reciprocal.
   */
  void SetAttenuation(int attenuation);
  vtkGetMacro(Attenuation, int);
  void SetAttenuationToReciprocal() { this->SetAttenuation(Reciprocal); }
  void SetAttenuationToExponential() { this->SetAttenuation(Exponential); }
  ///@}

  ///@{
  /**
   * The density of the exponential attenuation. Per unit of length, at least 0; 0 lets all light
   * through. Default: 1.
   */
  void SetDensity(double value);
  vtkGetMacro(Density, double);
  ///@}

  ///@{
  /**
   * Whether the material ends at FloorHeight below the surface, so that light comes through from
   * behind. Default: off, the material has no bottom.
   */
  vtkSetMacro(UseFloor, bool);
  vtkGetMacro(UseFloor, bool);
  vtkBooleanMacro(UseFloor, bool);
  ///@}

  ///@{
  /**
   * The height of the material's bottom, in the unit of the scaled heights. Any finite number; a
   * floor above the surface leaves no material there. Default: 0.
   */
  void SetFloorHeight(double value);
  vtkGetMacro(FloorHeight, double);
  ///@}

  ///@{
  /**
   * Takes all parameters of another material. Both do the same: a material holds no data.
   */
  void DeepCopy(vtkReliefMaterial* other);
  void ShallowCopy(vtkReliefMaterial* other);
  ///@}

protected:
  vtkReliefMaterial();
  ~vtkReliefMaterial() override;

  // Their defaults are in the table of parameters.
  double BaseColor[3]{};
  double DiffuseColor[3]{};
  double SpecularColor[3]{};
  double SpecularCoefficient{};
  double ForwardScatterCoefficient{};
  double SpecularRange[2]{};
  double SpecularPower{};
  double ForwardScatterRange[2]{};
  double ForwardScatterPower{};
  double SubsurfaceDepth{};
  bool AutomaticSubsurfaceDepth{};
  int OffsetMode{};
  int Attenuation{};
  double Density{};
  bool UseFloor{};
  double FloorHeight{};

private:
  vtkReliefMaterial(const vtkReliefMaterial&) = delete;
  void operator=(const vtkReliefMaterial&) = delete;
};

#endif

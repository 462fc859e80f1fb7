// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefStatistics
 * @brief   what the last run of a host of the shading model did
 *
 * A scene is shaded with the effects that it calls for and no others; these counts prove it.
 *
 * @sa vtkImageReliefShading
 */
#ifndef vtkReliefStatistics_h
#define vtkReliefStatistics_h

#include "vtkObject.h"
#include "vtkReliefShadingModule.h" // For export macro

class VTKRELIEFSHADING_EXPORT vtkReliefStatistics : public vtkObject
{
public:
  static vtkReliefStatistics* New();
  vtkTypeMacro(vtkReliefStatistics, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Effects
  {
    Illumination = 1,
    Normals = 2,
    Specular = 4,
    ForwardScatter = 8,
    BaseTexture = 16,
    DiffuseTexture = 32, ///< or a lookup table
    SpecularTexture = 64
  };

  ///@{
  /**
   * Lights toward which at least one ray was traced.
   */
  vtkSetMacro(LightsTraced, vtkTypeInt64);
  vtkGetMacro(LightsTraced, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Rays traced, over all lights.
   */
  vtkSetMacro(RaysTraced, vtkTypeInt64);
  vtkGetMacro(RaysTraced, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Cells, and blocks of cells taken at once, that the rays visited; for FixedStep the points
   * tested.
   */
  vtkSetMacro(CellsVisited, vtkTypeInt64);
  vtkGetMacro(CellsVisited, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Lights whose illumination was kept from an earlier run.
   */
  vtkSetMacro(LightsReused, vtkTypeInt64);
  vtkGetMacro(LightsReused, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * The effects that were evaluated, a sum of values of Effects.
   */
  vtkSetMacro(EffectsEvaluated, int);
  vtkGetMacro(EffectsEvaluated, int);
  ///@}

  ///@{
  /**
   * The exposure of the picture, in stops: the scene's, or what AutomaticExposure has found. 0 for
   * float output.
   */
  vtkSetMacro(Exposure, double);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * Of how many regions, squares of 64 x 64 samples, rays may have met of which the least and the
   * greatest height stood in for the heights, since there was no memory for them; and what that
   * took of the scene's tolerance, at the sample and light where it was most. Infinite where what
   * has no tolerance depended on them: a layer, or fixed steps. See
   * vtkImageReliefShading::SetBeyondMemory().
   */
  vtkSetMacro(RegionsLeftOut, vtkTypeInt64);
  vtkGetMacro(RegionsLeftOut, vtkTypeInt64);
  vtkSetMacro(ToleranceTaken, double);
  vtkGetMacro(ToleranceTaken, double);
  ///@}

  /**
   * The names of the effects that were evaluated, separated by single spaces.
   */
  std::string GetEffectNames();

protected:
  vtkReliefStatistics() = default;
  ~vtkReliefStatistics() override = default;

  vtkTypeInt64 LightsTraced = 0;
  vtkTypeInt64 RaysTraced = 0;
  vtkTypeInt64 CellsVisited = 0;
  vtkTypeInt64 LightsReused = 0;
  int EffectsEvaluated = 0;
  double Exposure = 0.0;
  vtkTypeInt64 RegionsLeftOut = 0;
  double ToleranceTaken = 0.0;

private:
  vtkReliefStatistics(const vtkReliefStatistics&) = delete;
  void operator=(const vtkReliefStatistics&) = delete;
};

#endif

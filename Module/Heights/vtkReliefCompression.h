// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefCompression
 * @brief   squeezes depth into a relief that is a fraction as high and still looks round
 *
 * Sculptors do not press a head flat to make a medal of it: they close the gaps between its parts,
 * level its large forms and keep its details. So does this filter. What it makes is a height field,
 * highest where the depth is nearest, to be shaded, milled or printed.
 *
 * Input 0 is an image of one slice and one component of any type: heights, or depth that grows
 * toward the viewer. Input 1, optional, is a mask of the same extent: 0 is no data, as for
 * vtkImageReliefShading. What has no data is background, a plate at height 0 that carries the
 * relief.
 *
 * The output is float, in the unit of the input: NaN where there is background, unless
 * FillBackground is on. Its largest height is HeightBudget times the range of the input. Its least
 * is 0, or the step that lifts silhouettes off the background; of a level input all heights are 0.
 * The result does not change when a constant is added to the input, and scales with it: only the
 * shape of the depth counts, not its unit. It does not depend on the number of threads.
 *
 * Takes about 190 bytes a sample while it runs, and time in proportion to the samples: some 70
 * passes of multigrid for GradientDomain. An input that cannot be read, or whose range is beyond
 * single precision, gives one error and an empty output.
 *
 * GradientDomain follows T. Weyrich, J. Deng, C. Barnes, S. Rusinkiewicz, A. Finkelstein, "Digital
 * bas-relief from 3D scenes", ACM Transactions on Graphics 26/3, 2007: gaps taken out of the
 * slopes, their logarithmic attenuation, heights by least squares. Where that would be too high,
 * the least squares are screened, so that the largest forms give way; level parts are held level.
 * TwoScale takes from Z. Ji, X. Sun, S. Li, Y. Wang, "Real-time bas-relief generation from
 * depth-and-normal maps on GPU", Computer Graphics Forum 33/5, 2014, that a base and details are
 * treated apart; its details are those of the depth, as there are no normals.
 *
 * Tells its progress and can be aborted, which leaves the output empty.
 *
 * @sa vtkImageReliefShading vtkReliefStepSmoothing
 */
#ifndef vtkReliefCompression_h
#define vtkReliefCompression_h

#include "vtkFiltersReliefShadingModule.h" // For export macro
#include "vtkImageAlgorithm.h"

#include <functional> // For loops over threads

class VTKFILTERSRELIEFSHADING_EXPORT vtkReliefCompression : public vtkImageAlgorithm
{
public:
  static vtkReliefCompression* New();
  vtkTypeMacro(vtkReliefCompression, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Methods
  {
    GradientDomain = 0,
    TwoScale = 1,
    Linear = 2
  };

  ///@{
  /**
   * How depth becomes a relief.
   *  - GradientDomain: gaps between surfaces are closed to a small step, steep slopes become
   * gentler, and the heights are those whose slopes come nearest to what is left. Large forms give
   * way to details as far as the budget and Detail ask for.
   *  - TwoScale: depth is split into smooth forms, which are squeezed, and details, which are kept.
   * Gaps stay, and take their share of the budget.
   *  - Linear: depth times a factor, less its least. With a HeightBudget of 1 it is the input, set
   * to begin at 0.
   * Default: GradientDomain.
   */
  void SetMethod(int method);
  vtkGetMacro(Method, int);
  void SetMethodToGradientDomain() { this->SetMethod(GradientDomain); }
  void SetMethodToTwoScale() { this->SetMethod(TwoScale); }
  void SetMethodToLinear() { this->SetMethod(Linear); }
  ///@}

  ///@{
  /**
   * The height of the relief as a share of the range of the input's depth: 1 is full round, 0.02 a
   * medal. No unit, in (0, 1]; other values are refused. Default: 0.1.
   */
  void SetHeightBudget(double value);
  vtkGetMacro(HeightBudget, double);
  ///@}

  ///@{
  /**
   * How much of the slopes of fine details is kept: with 0 details are squeezed like large forms,
   * with 1 they keep their slopes, and large forms are leveled until the budget is met. Not used by
   * Linear. No unit, in [0, 1]; other values are refused. Default: 0.6.
   */
  void SetDetail(double value);
  vtkGetMacro(Detail, double);
  ///@}

  ///@{
  /**
   * The step that is left where depth jumps and at the border of the background: 1 is a tenth of
   * the budget, 0 none. For GradientDomain. No unit, in [0, 1]; other values are refused. Default:
   * 0.5.
   */
  void SetSilhouettes(double value);
  vtkGetMacro(Silhouettes, double);
  ///@}

  ///@{
  /**
   * Neighboring samples farther apart than this share of the input's range lie on different
   * surfaces, unless the flank that they are on is as steep to either side: the depth between them
   * is a gap. Not used by Linear. No unit, in (0, 1]; other values are refused; 1 means that there
   * are no gaps. Default: 0.03.
   */
  void SetJumpThreshold(double value);
  vtkGetMacro(JumpThreshold, double);
  ///@}

  ///@{
  /**
   * On: the background is the plate, at height 0. Off: it is NaN. Default: off.
   */
  vtkSetMacro(FillBackground, bool);
  vtkGetMacro(FillBackground, bool);
  vtkBooleanMacro(FillBackground, bool);
  ///@}

  ///@{
  /**
   * A value of the input that stands for no data, compared in the type of the input. NaN: none but
   * what is not finite. Default: NaN.
   */
  void SetNoDataValue(double value);
  vtkGetMacro(NoDataValue, double);
  ///@}

  ///@{
  /**
   * The mask, input 1. Null for none.
   */
  void SetMaskData(vtkImageData* mask);
  void SetMaskConnection(vtkAlgorithmOutput* mask);
  ///@}

protected:
  vtkReliefCompression();
  ~vtkReliefCompression() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  std::function<void(int, const std::function<void(int, int)>&)> Watched();

  int Method = GradientDomain;
  double HeightBudget = 0.1;
  double Detail = 0.6;
  double Silhouettes = 0.5;
  double JumpThreshold = 0.03;
  bool FillBackground = false;
  double NoDataValue;

private:
  vtkReliefCompression(const vtkReliefCompression&) = delete;
  void operator=(const vtkReliefCompression&) = delete;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefStepSmoothing
 * @brief   smooths the terraces of heights that were stored in few steps
 *
 * Heights in 8 bits have 256 steps, and gentle ground becomes terraces, whose edges light shows.
 * The true heights lie within half a step of what is stored; of the surfaces that do, this filter
 * gives nearly the one with the gentlest slopes. No height leaves its half step. Neighbours more
 * than one step and a half apart are a true flank: neither side is drawn to the other, nor is
 * anything across samples without data.
 *
 * Input 0 is an image of one slice and one component of any type, input 1, optional, a mask of the
 * same extent: 0 is no data, as for vtkImageReliefShading. The output is float, or double for
 * integers of 32 bits and more and for double; NaN where there is no data. Its scalars keep their
 * name, and field data are passed on. It does not depend on the number of threads. Needs 22 bytes a
 * sample while it runs. Heights that cannot be shaded give one error and an empty output.
 *
 * @sa vtkImageReliefShading
 */
#ifndef vtkReliefStepSmoothing_h
#define vtkReliefStepSmoothing_h

#include "vtkImageAlgorithm.h"
#include "vtkReliefShadingModule.h" // For export macro

class VTKRELIEFSHADING_EXPORT vtkReliefStepSmoothing : public vtkImageAlgorithm
{
public:
  static vtkReliefStepSmoothing* New();
  vtkTypeMacro(vtkReliefStepSmoothing, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What the heights were rounded to multiples of, in their own values. Finite, at least 0; 0 is
   * the least difference between two heights of the input, of which at most 2^20 on a fixed grid
   * are looked at. Other values are refused. Default: 0.
   */
  void SetStep(double value);
  vtkGetMacro(Step, double);
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
   * The mask, input 1.
   */
  void SetMaskData(vtkImageData* mask);
  void SetMaskConnection(vtkAlgorithmOutput* mask);
  ///@}

  /**
   * The step of the last update: Step, or the one that was found; 0 if all heights were the same.
   */
  vtkGetMacro(UsedStep, double);

protected:
  vtkReliefStepSmoothing();
  ~vtkReliefStepSmoothing() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double Step = 0.0;
  double NoDataValue;
  double UsedStep = 0.0;

private:
  vtkReliefStepSmoothing(const vtkReliefStepSmoothing&) = delete;
  void operator=(const vtkReliefStepSmoothing&) = delete;
};

#endif

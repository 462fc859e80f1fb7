// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefAccuracyReport
 * @brief   what accuracy costs on a field and a scene of your own
 *
 * Measures the error of the illumination d and the time of shading over tolerances (0, 0.0001,
 * 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1) and over the thesis's fixed steps (8, 16 ... 1024, as far
 * as that takes a second or two each), with the lights, material and heights of a
 * vtkImageReliefShading. A setting of the scene that is none of these is measured as well.
 *
 * Errors are those of the layer Illumination, the mean over the lights, against the reference: the
 * exact light of the scene as it is, in double precision, ray by ray. They are taken at up to some
 * 32768 samples that are spread over the whole field and drawn by a Seed; fewer where that would
 * take long. Fixed steps put suns on a sphere about the field and know no attenuation: their error
 * is what the published algorithm makes of the scene, however many they are.
 *
 * Times are processor time of one thread for shading to 8 bits, least of several runs in which the
 * settings take turns, without reading, writing and what is prepared once. They are comparable with
 * one another only, and differ a little from update to update.
 *
 * The output is a table with a row for each setting:
 * - Integrator: "Exact" or "FixedStep"; Tolerance (NaN for steps); Steps (0 for tolerances);
 * - Present: 1 for the scene's own setting, else 0;
 * - Nanoseconds: a sample with data; Seconds: the whole picture;
 * - ErrorOf999: that 99.9 % of the samples keep; LargestError; RMSError: root of the mean square;
 * - Samples: how many were compared.
 *
 * Without a shading, with heights that cannot be shaded and where no sample has data there is one
 * error, and the table is empty; so it is after an abort.
 *
 * @sa vtkImageReliefShading vtkReliefVerification
 */
#ifndef vtkReliefAccuracyReport_h
#define vtkReliefAccuracyReport_h

#include "vtkReliefShadingModule.h" // For export macro
#include "vtkSmartPointer.h"        // For vtkSmartPointer
#include "vtkTableAlgorithm.h"

class vtkImageReliefShading;

class VTKRELIEFSHADING_EXPORT vtkReliefAccuracyReport : public vtkTableAlgorithm
{
public:
  static vtkReliefAccuracyReport* New();
  vtkTypeMacro(vtkReliefAccuracyReport, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The shading to measure: its inputs and its scene, which stay as they are. It need not have been
   * updated. Default: null.
   */
  void SetShading(vtkImageReliefShading* shading);
  vtkImageReliefShading* GetShading();
  ///@}

  ///@{
  /**
   * Which samples are compared: the same seed draws the same, on every machine. Default: 1.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  ///@{
  /**
   * The row of the setting to take, after an update: the quickest tolerance of which 99.9 % of the
   * samples keep VisibleError, and of those that are as quick, within a tenth, the smallest. -1 if
   * there is none.
   */
  vtkGetMacro(RecommendedRow, vtkIdType);
  ///@}

  ///@{
  /**
   * The error of d that is a step of an 8-bit picture in its darkest tones: 0.0003, or less where
   * the lights times the exposure show level ground brighter than 1.
   */
  vtkGetMacro(VisibleError, double);
  ///@}

  ///@{
  /**
   * Samples of the field that have data, and samples that were compared, at most.
   */
  vtkGetMacro(NumberOfSamples, vtkTypeInt64);
  vtkGetMacro(NumberOfComparedSamples, vtkTypeInt64);
  ///@}

  /**
   * Changes with the shading and its scene.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkReliefAccuracyReport();
  ~vtkReliefAccuracyReport() override;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  unsigned int Seed = 1;
  vtkIdType RecommendedRow = -1;
  double VisibleError = 0.0;
  vtkTypeInt64 NumberOfSamples = 0;
  vtkTypeInt64 NumberOfComparedSamples = 0;

private:
  std::string Measure(vtkTable* table);

  vtkReliefAccuracyReport(const vtkReliefAccuracyReport&) = delete;
  void operator=(const vtkReliefAccuracyReport&) = delete;

  vtkSmartPointer<vtkImageReliefShading> Shading;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefVerification
 * @brief   proves of a shaded image that its illumination is as exact as is promised
 *
 * Retraces random samples of a vtkImageReliefShading's layer Illumination by the reference: every
 * light's ray in double precision, through every cell, without a tolerance. The integrator Exact
 * promises of each sample that d errs by at most the scene's tolerance, shared out to the lights as
 * they count in the mean, and by rounding, which is 2e-6.
 *
 * Where a ray grazes the surface, passes a corner of a hole or, at depth 0, meets the edge of a
 * shadow, rounding of the heights moves d by more than that: there it must lie between the values
 * that heights have which differ by at most 64 units in the last place of single precision of the
 * relief (Documentation/Numerics.md). Samples that only this explains are
 * counted as grazing, and their error is what lies beyond.
 *
 * The output is a table with a row for each retraced sample: Column and Row, in the image's extent;
 * Illumination, as it was shaded; Reference; Error; Grazing, 1 or 0.
 *
 * The shading is updated. Of heights that are read as they are needed only those parts are shaded
 * that have samples to be retraced (or SetPieces() gives them), and heights are read about these.
 * The choice of samples and all that comes out are the same.
 *
 * Without a shading or its layer Illumination (GenerateIlluminationOn),
 * with fixed steps, which promise nothing, and with heights that cannot be shaded there is one
 * error, the table is empty and Kept is off; so it is after an abort.
 *
 * @sa vtkImageReliefShading vtkReliefAccuracyReport
 */
#ifndef vtkReliefVerification_h
#define vtkReliefVerification_h

#include "vtkReliefShadingModule.h" // For export macro
#include "vtkSmartPointer.h"        // For vtkSmartPointer
#include "vtkTableAlgorithm.h"

#include <array>      // For std::array
#include <cstddef>    // For std::size_t
#include <functional> // For std::function
#include <string>     // For std::string
#include <vector>     // For std::vector

namespace relief
{
class IlluminationCheck;
}

class vtkImageReliefShading;
class vtkImageData;

class VTKRELIEFSHADING_EXPORT vtkReliefVerification : public vtkTableAlgorithm
{
public:
  static vtkReliefVerification* New();
  vtkTypeMacro(vtkReliefVerification, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The shading whose output is verified. Default: null.
   */
  void SetShading(vtkImageReliefShading* shading);
  vtkImageReliefShading* GetShading();
  ///@}

  ///@{
  /**
   * How many samples are retraced, of those that have data; all if there are no more. At least 1;
   * other values are refused. Default: 1000.
   */
  void SetNumberOfSamples(vtkTypeInt64 count);
  vtkGetMacro(NumberOfSamples, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Which samples: the same seed draws the same, on every machine. Default: 1.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

#ifndef __VTK_WRAP__
  ///@{
  /**
   * Where pieces come from that have been shaded already, of heights that are read as they are
   * needed: their extents, which are all of the image and do not overlap, and a function that gives
   * one with its layer Illumination. What that throws comes out. Default: none, for pieces to be
   * shaded.
   */
  using PieceSource = std::function<vtkSmartPointer<vtkImageData>(const int extent[6])>;
  void SetPieces(const std::vector<std::array<int, 6>>& pieces, const PieceSource& source);
  ///@}
#endif

  ///@{
  /**
   * Whether all samples of the last update kept what is promised.
   */
  vtkGetMacro(Kept, bool);
  ///@}

  ///@{
  /**
   * The largest error, and at which column and row of the image's extent; 0 and -1 if no sample was
   * retraced.
   */
  vtkGetMacro(LargestError, double);
  vtkGetMacro(WorstColumn, int);
  vtkGetMacro(WorstRow, int);
  ///@}

  ///@{
  /**
   * What is promised is the sum of both: the error that the tolerance lets the mean over the lights
   * have, and that of rounding.
   */
  vtkGetMacro(PromisedError, double);
  vtkGetMacro(RoundingError, double);
  ///@}

  ///@{
  /**
   * Samples that were retraced, and how many of them graze.
   */
  vtkGetMacro(NumberOfRetracedSamples, vtkTypeInt64);
  vtkGetMacro(NumberOfGrazingSamples, vtkTypeInt64);
  ///@}

  /**
   * Changes with the shading and its scene.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkReliefVerification();
  ~vtkReliefVerification() override;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  vtkTypeInt64 NumberOfSamples = 1000;
  unsigned int Seed = 1;
  bool Kept = false;
  double LargestError = 0.0;
  int WorstColumn = -1;
  int WorstRow = -1;
  double PromisedError = 0.0;
  double RoundingError = 0.0;
  vtkTypeInt64 NumberOfRetracedSamples = 0;
  vtkTypeInt64 NumberOfGrazingSamples = 0;

private:
  void Forget();
  std::string Verify(vtkTable* table);
  std::string VerifyWhole(vtkTable* table);
  std::string VerifyPieces(vtkTable* table);
  bool Retrace(
    relief::IlluminationCheck& check, const std::vector<std::size_t>& samples, std::size_t done);
  void Tell(const relief::IlluminationCheck& check, const int extent[6], vtkTable* table);

  vtkReliefVerification(const vtkReliefVerification&) = delete;
  void operator=(const vtkReliefVerification&) = delete;

  vtkSmartPointer<vtkImageReliefShading> Shading;
  std::vector<std::array<int, 6>> Pieces;
  std::function<vtkSmartPointer<vtkImageData>(const int extent[6])> Source;
};

#endif

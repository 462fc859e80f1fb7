// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNormalMapToHeightField
 * @brief   heights of a surface whose normals an image holds
 *
 * Input 0 is an image of one slice and three components, a normal map in the frame of the image: x
 * to the right (with the index), y up (with the index, row 0 is the lowest), z to the viewer; a
 * fourth component is 0 where there is no data. Normals need not be of unit length. Input 1,
 * optional, is a mask of the same extent and one component: 0 is no data. Input 2, optional, are
 * weights of the same extent and one component, at least 0: how far each normal is to be trusted,
 * as the inverse of its variance. Only their ratios count; those below 1e-9 of the largest count as
 * that; 0, negative ones and NaN are as no data.
 *
 * The output is one component "Height", in the unit of the image's spacing, growing to the viewer:
 * double for images of double or of integers of 32 bits and more, else float. It is NaN where there
 * is no data, and where a normal is of no use: zero, not finite, or so turned away that the cosine
 * of the angle between it and the ray to the viewer is at most 0.001. Normals tell nothing of the
 * level: that of each part whose samples are connected, side by side, is set by Datum.
 *
 * LeastSquares takes O(n log n) for whole rectangles, by cosine transforms, and conjugate gradients
 * for other domains and for weights; DiscontinuityPreserving takes some dozen such solutions.
 * Needs some 80 bytes a sample while it runs, up to 300 with a mask, weights or
 * DiscontinuityPreserving. The output does not depend on the number of threads. Images of more than
 * 2^28 samples are refused. Observers hear of progress and may abort, which leaves an empty output.
 * What cannot be integrated gives one error and an empty output.
 *
 * References: [1] B. K. P. Horn and M. J. Brooks, "The variational approach to shape from shading",
 * CVGIP 33, 1986. [2] T. Simchony, R. Chellappa and M. Shao, "Direct analytical methods for solving
 * Poisson equations in computer vision problems", PAMI 12, 1990. [3] X. Cao, H. Santo, B. Shi,
 * F. Okura and Y. Matsushita, "Bilateral normal integration", ECCV 2022.
 *
 * @sa vtkImageReliefShading
 */
#ifndef vtkNormalMapToHeightField_h
#define vtkNormalMapToHeightField_h

#include "vtkFiltersReliefShadingModule.h" // For export macro
#include "vtkImageAlgorithm.h"

#include <string> // For what is wrong with inputs
#include <vector> // For heights

namespace relief
{
struct NormalCamera;
struct NormalRequest;
}

class VTKFILTERSRELIEFSHADING_EXPORT vtkNormalMapToHeightField : public vtkImageAlgorithm
{
public:
  static vtkNormalMapToHeightField* New();
  vtkTypeMacro(vtkNormalMapToHeightField, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum EncodingType
  {
    AutomaticEncoding = 0,
    Unsigned = 1,
    Signed = 2
  };
  enum GreenType
  {
    AutomaticGreen = 0,
    Up = 1,
    Down = 2
  };
  enum MethodType
  {
    LeastSquares = 0,
    DiscontinuityPreserving = 1,
    PathSums = 2
  };
  enum ProjectionType
  {
    Orthographic = 0,
    Perspective = 1
  };
  enum DatumType
  {
    Mean = 0,
    Minimum = 1
  };

  ///@{
  /**
   * How components are stored. Unsigned: n = (c - z) / (m / 2), where m is the largest code of the
   * type, or 1 for float and double, and z the code of zero, see ZeroCode. Signed: n = c / m. The
   * automatic choice is Unsigned for unsigned integers, Signed for signed ones; for float and
   * double Signed if any component is below -0.05, else the one whose normals are nearer to unit
   * length. Other values are refused. Default: AutomaticEncoding.
   */
  void SetEncoding(int value);
  vtkGetMacro(Encoding, int);
  void SetEncodingToAutomatic() { this->SetEncoding(AutomaticEncoding); }
  void SetEncodingToUnsigned() { this->SetEncoding(Unsigned); }
  void SetEncodingToSigned() { this->SetEncoding(Signed); }
  ///@}

  ///@{
  /**
   * The code z that stands for zero where the encoding is Unsigned. -1 is half of the largest code:
   * n = 2 c / m - 1, 127.5 for 8 bits, so that a level surface stored as 128 leans by 0.4 %; some
   * maps are made for 127 or 128. From 0 to m, or -1; other values are refused, above m when the
   * filter runs. Default: -1.
   */
  void SetZeroCode(double value);
  vtkGetMacro(ZeroCode, double);
  ///@}

  ///@{
  /**
   * Where the second component, green, points to: up (as in OpenGL) or down (as in DirectX). The
   * automatic choice is the one whose slopes have less curl, as those of a surface have none; where
   * that cannot be told, as for planes and for waves along an axis, it is up, and IsGreenKnown()
   * is false. Other values are refused. Default: AutomaticGreen.
   */
  void SetGreen(int value);
  vtkGetMacro(Green, int);
  void SetGreenToAutomatic() { this->SetGreen(AutomaticGreen); }
  void SetGreenToUp() { this->SetGreen(Up); }
  void SetGreenToDown() { this->SetGreen(Down); }
  ///@}

  ///@{
  /**
   * How normals become heights. LeastSquares [1, 2]: the rise between neighbours is to be the mean
   * of what their normals ask for; exact for planes and quadratic surfaces; cliffs are smeared.
   * DiscontinuityPreserving [3]: surfaces may jump where one side fits on better. It finds cliffs
   * whose ends it can start from; long ones between gentle slopes, or those of parts that touch in
   * few places, may stay as smeared as by LeastSquares. PathSums: heights add up along the first
   * column, then along each row; for comparison only, errors grow along the way. Other values are
   * refused. Default: LeastSquares.
   */
  void SetMethod(int value);
  vtkGetMacro(Method, int);
  void SetMethodToLeastSquares() { this->SetMethod(LeastSquares); }
  void SetMethodToDiscontinuityPreserving() { this->SetMethod(DiscontinuityPreserving); }
  void SetMethodToPathSums() { this->SetMethod(PathSums); }
  ///@}

  ///@{
  /**
   * How the surface was seen. Orthographic: along z. Perspective: by a pinhole camera; a sample at
   * depth d lies at d (a, b, -1), a = (i - PrincipalPointX) / FocalLengthX, b likewise in y, where
   * i and j count samples from the lowest, leftmost one of the image. The height is then Distance -
   * d. Other values are refused. Default: Orthographic.
   */
  void SetProjection(int value);
  vtkGetMacro(Projection, int);
  void SetProjectionToOrthographic() { this->SetProjection(Orthographic); }
  void SetProjectionToPerspective() { this->SetProjection(Perspective); }
  ///@}

  ///@{
  /**
   * The focal length of a perspective view, in samples along x and along y. Finite, at least 0; 0
   * in y is that in x; 0 in x is no camera, an error when the filter runs. Other values are
   * refused. Default: 0.
   */
  void SetFocalLengthX(double value);
  vtkGetMacro(FocalLengthX, double);
  void SetFocalLengthY(double value);
  vtkGetMacro(FocalLengthY, double);
  ///@}

  ///@{
  /**
   * Where the axis of a perspective view meets the image, in samples from the middle of the lowest,
   * leftmost one; it may lie outside. Finite, or NaN, which is the middle of the image. (Cameras'
   * matrices often count from the uppermost row: take their y from the number of rows less 1.)
   * Default: NaN.
   */
  void SetPrincipalPointX(double value);
  vtkGetMacro(PrincipalPointX, double);
  void SetPrincipalPointY(double value);
  vtkGetMacro(PrincipalPointY, double);
  ///@}

  ///@{
  /**
   * The distance of the surface in a perspective view: the geometric mean of the depths of each
   * part that is connected. Normals do not tell the size. From 1e-30 to 1e30, in the unit that
   * heights are to have; other values are refused. Default: 1.
   */
  void SetDistance(double value);
  vtkGetMacro(Distance, double);
  ///@}

  ///@{
  /**
   * What is 0 in each part of an orthographic view that is connected: the mean height, or the
   * least. Other values are refused. Default: Mean.
   */
  void SetDatum(int value);
  vtkGetMacro(Datum, int);
  void SetDatumToMean() { this->SetDatum(Mean); }
  void SetDatumToMinimum() { this->SetDatum(Minimum); }
  ///@}

  ///@{
  /**
   * How sharply DiscontinuityPreserving decides between two sides, k of [3]: towards 0 it becomes
   * least squares, large values let surfaces jump at every disturbance. Above 0, at most 1000, no
   * unit; other values are refused. Default: 2.
   */
  void SetSmoothness(double value);
  vtkGetMacro(Smoothness, double);
  ///@}

  ///@{
  /**
   * How often DiscontinuityPreserving weighs sides anew at most, and the relative change of its
   * energy at which it ends before. At least 1; from 0 to 1; other values are refused. Defaults:
   * 150 and 1e-4.
   */
  void SetMaximumIterations(int value);
  vtkGetMacro(MaximumIterations, int);
  void SetEnergyTolerance(double value);
  vtkGetMacro(EnergyTolerance, double);
  ///@}

  ///@{
  /**
   * The error of conjugate gradients in LeastSquares, relative to the heights, both by the squares
   * of their slopes. From 1e-12 to 0.1; other values are refused. Default: 1e-6.
   */
  void SetTolerance(double value);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The mask, input 1.
   */
  void SetMaskData(vtkImageData* mask);
  void SetMaskConnection(vtkAlgorithmOutput* mask);
  ///@}

  ///@{
  /**
   * The weights, input 2.
   */
  void SetWeightsData(vtkImageData* weights);
  void SetWeightsConnection(vtkAlgorithmOutput* weights);
  ///@}

  ///@{
  /**
   * Of the last update: the encoding, Unsigned or Signed, and the sense of green, Up or Down, that
   * were used, and whether the latter was set or could be told from the map.
   */
  vtkGetMacro(UsedEncoding, int);
  vtkGetMacro(UsedGreen, int);
  bool IsGreenKnown() { return this->GreenKnown; }
  ///@}

  ///@{
  /**
   * Of the last update: how many parts are connected, the iterations of the method (of conjugate
   * gradients, or of weights; 0 for direct methods), and whether they ended by their tolerance.
   * Conjugate gradients end at 500; weights that differ by many decades from sample to sample may
   * take more.
   */
  vtkGetMacro(NumberOfParts, int);
  vtkGetMacro(NumberOfIterations, int);
  vtkGetMacro(Converged, bool);
  ///@}

protected:
  vtkNormalMapToHeightField();
  ~vtkNormalMapToHeightField() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int Encoding = AutomaticEncoding;
  double ZeroCode = -1.0;
  int Green = AutomaticGreen;
  int Method = LeastSquares;
  int Projection = Orthographic;
  double FocalLengthX = 0.0;
  double FocalLengthY = 0.0;
  double PrincipalPointX;
  double PrincipalPointY;
  double Distance = 1.0;
  int Datum = Mean;
  double Smoothness = 2.0;
  int MaximumIterations = 150;
  double EnergyTolerance = 1e-4;
  double Tolerance = 1e-6;
  int UsedEncoding = Signed;
  int UsedGreen = Up;
  bool GreenKnown = false;
  int NumberOfParts = 0;
  int NumberOfIterations = 0;
  bool Converged = true;

private:
  vtkNormalMapToHeightField(const vtkNormalMapToHeightField&) = delete;
  void operator=(const vtkNormalMapToHeightField&) = delete;

  struct Inputs;
  std::string Check(const Inputs& inputs) const;
  relief::NormalCamera MakeCamera(const int* dimensions) const;
  relief::NormalRequest MakeRequest(const Inputs& inputs);
  bool Integrate(const Inputs& inputs, vtkDataArray* result, std::string& wrong);
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDepthToHeightField
 * @brief   the height field of a scene, as it is seen from one direction
 *
 * Looks at meshes along parallel lines and keeps, at each sample of a grid, the highest point: the
 * height field that integrated shading was made for (F. N. Pramananda Perumal, thesis of 2017,
 * sections 3.1.2 and 3.1.3, draws it as a depth image). No picture is drawn: at the
 * center of each sample the plane of the triangle there is evaluated in double, and which triangles
 * are there is decided exactly. A sample on an edge belongs to all triangles of that edge, so that
 * closed surfaces have no cracks. Triangles may face either way, and overlap. A renderer may take
 * the place of the meshes: then the heights are those of its depth buffer, see SetRenderer().
 *
 * Input 0, optional and repeatable, are vtkPolyData, or composites of them as readers of OBJ and
 * glTF make them. Polygons and strips are cut into triangles. What is left out is told in one
 * warning and counted: vertices and lines; triangles whose corners are not finite, do not exist or
 * lie beyond 1e100; triangles without area; other data in composites.
 *
 * The output is one slice in the view's frame: its x axis points right, y up, and heights count
 * toward the eye, all in the scene's units. With the default direction these are the scene's own x,
 * y and z. Samples lie at the centers of the cells of the Frame. Point data are the scalars
 * "Height", float or double, NaN where nothing is seen, and where asked for "Mask", "Normals" and
 * "Color". An error gives an empty output. So does no hit at all, with an error.
 *
 * Takes 8 bytes a sample and 4 more for normals or colors, 24 bytes a point and 12 a triangle while
 * it runs. Does not depend on the number of threads. Tells its progress and can be aborted, which
 * leaves the output empty.
 *
 * @sa vtkImageReliefShading
 */
#ifndef vtkDepthToHeightField_h
#define vtkDepthToHeightField_h

#include "vtkFiltersReliefShadingModule.h" // For export macro
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // For the renderer

#include <memory> // For what is kept between the passes of the pipeline

class vtkRenderer;

class VTKFILTERSRELIEFSHADING_EXPORT vtkDepthToHeightField : public vtkImageAlgorithm
{
public:
  static vtkDepthToHeightField* New();
  vtkTypeMacro(vtkDepthToHeightField, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What heights are measured in, see SetNormalize().
  enum NormalizeModes
  {
    SceneUnits = 0,
    FromLowest = 1,
    UnitRange = 2
  };

  ///@{
  /**
   * A vector from the scene toward the eye, of any length but 0; other vectors are refused.
   * Default: 0, 0, 1, which looks down along z.
   */
  void SetViewDirection(double x, double y, double z);
  void SetViewDirection(const double direction[3])
  {
    this->SetViewDirection(direction[0], direction[1], direction[2]);
  }
  vtkGetVector3Macro(ViewDirection, double);
  ///@}

  ///@{
  /**
   * A vector that points up in the output, of any length but 0; other vectors are refused. What of
   * it lies along the view does not count. Where all of it does, y is up; where the view is along
   * y, -z is as seen from above, and z as seen from below. Default: 0, 1, 0.
   */
  void SetViewUp(double x, double y, double z);
  void SetViewUp(const double up[3]) { this->SetViewUp(up[0], up[1], up[2]); }
  vtkGetVector3Macro(ViewUp, double);
  ///@}

  ///@{
  /**
   * Samples along the longer side of the frame, where Dimensions are not given; 1 to 65536, other
   * values are refused. Default: 1024.
   */
  void SetResolution(int samples);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Samples along x and y, 1 to 65536 each; 0, 0 for what Resolution and the frame make of it.
   * Other values are refused. More than 2^30 samples are an error. Default: 0, 0.
   */
  void SetDimensions(int columns, int rows);
  vtkGetVector2Macro(Dimensions, int);
  ///@}

  ///@{
  /**
   * What is looked at, in the view's frame: from xmin to xmax and from ymin to ymax, in the scene's
   * units. All 0: the bounds of the triangles with a Margin, made wider or higher for samples to be
   * squares. Else samples are what Frame and Dimensions make of them. Frames that are not finite or
   * have no area are refused. Default: all 0.
   */
  void SetFrame(double xmin, double xmax, double ymin, double ymax);
  vtkGetVector4Macro(Frame, double);
  ///@}

  ///@{
  /**
   * What is left free around the bounds, as a part of their longer side, where there is no Frame; 0
   * to 10, other values are refused. Default: 0.02.
   */
  void SetMargin(double part);
  vtkGetMacro(Margin, double);
  ///@}

  ///@{
  /**
   * What heights are measured in. SceneUnits: the coordinate toward the eye in the view's frame, in
   * the scene's units, so that heights fit the x and y of the output, and several outputs one
   * another. FromLowest: the same, from the lowest sample. UnitRange: from 0 at the lowest sample
   * to 1 at the highest; 0 if there is no other. Other values are refused. Default: SceneUnits.
   */
  void SetNormalize(int mode);
  vtkGetMacro(Normalize, int);
  void SetNormalizeToSceneUnits() { this->SetNormalize(SceneUnits); }
  void SetNormalizeToFromLowest() { this->SetNormalize(FromLowest); }
  void SetNormalizeToUnitRange() { this->SetNormalize(UnitRange); }
  ///@}

  ///@{
  /**
   * The type of heights, VTK_FLOAT or VTK_DOUBLE; others are refused. Heights far from 0 are told
   * in a warning where float has not the digits for them. Default: VTK_FLOAT.
   */
  void SetOutputScalarType(int type);
  vtkGetMacro(OutputScalarType, int);
  void SetOutputScalarTypeToFloat();
  void SetOutputScalarTypeToDouble();
  ///@}

  ///@{
  /**
   * Adds "Mask", unsigned char: 1 where something is seen, else 0. Default: off.
   */
  vtkSetMacro(GenerateMask, bool);
  vtkGetMacro(GenerateMask, bool);
  vtkBooleanMacro(GenerateMask, bool);
  ///@}

  ///@{
  /**
   * Adds "Normals", three floats in the view's frame, of length 1: those of the mesh's points where
   * it has any, turned to the side that is seen, else that of the triangle's plane; 0 where nothing
   * is seen. Of meshes only. Default: off.
   */
  vtkSetMacro(GenerateNormals, bool);
  vtkGetMacro(GenerateNormals, bool);
  vtkBooleanMacro(GenerateNormals, bool);
  ///@}

  ///@{
  /**
   * Adds "Color", unsigned char, 3 or 4 components, from active scalars of points, else of cells,
   * that are such colors; white on meshes without, 0 where nothing is seen. Left out if no mesh has
   * any. Of meshes only. Default: off.
   */
  vtkSetMacro(GenerateColors, bool);
  vtkGetMacro(GenerateColors, bool);
  vtkBooleanMacro(GenerateColors, bool);
  ///@}

  ///@{
  /**
   * A renderer whose depth buffer is read instead of the input, as precise as that buffer is. Its
   * window is drawn first. It should be the only one in its part of the window. The view's frame is
   * the camera's; ViewDirection, ViewUp, Frame and the like do not count, and the samples are its
   * pixels. Heights are coordinates toward the eye in that frame, linear for perspective cameras
   * too, where samples lie along the lines of sight and their distances are those of the focal
   * plane. What lies at the far plane is no data. Call Modified() when the scene has changed; what
   * the camera does is noticed. Default: null.
   */
  void SetRenderer(vtkRenderer* renderer);
  vtkRenderer* GetRenderer();
  ///@}

  ///@{
  /**
   * Of the last update: the triangles that were looked at; those without area; those left out for
   * corners that are not finite, do not exist or are too far; vertices and lines; data in
   * composites that are no vtkPolyData.
   */
  vtkGetMacro(NumberOfTriangles, vtkIdType);
  vtkGetMacro(NumberOfDegenerateTriangles, vtkIdType);
  vtkGetMacro(NumberOfNonFiniteTriangles, vtkIdType);
  vtkGetMacro(NumberOfOtherCells, vtkIdType);
  vtkGetMacro(NumberOfOtherDataSets, vtkIdType);
  ///@}

  ///@{
  /**
   * Of the last update: the lowest and the highest sample toward the eye, in the scene's units
   * whatever Normalize is. NaN before.
   */
  vtkGetMacro(LowestHeight, double);
  vtkGetMacro(HighestHeight, double);
  ///@}

  /**
   * The view's frame of the last update, in the scene: what points right, up and toward the eye in
   * turn, each of length 1.
   */
  vtkGetVectorMacro(ViewAxes, double, 9);

  vtkMTimeType GetMTime() override;

protected:
  vtkDepthToHeightField();
  ~vtkDepthToHeightField() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double ViewDirection[3] = { 0.0, 0.0, 1.0 };
  double ViewUp[3] = { 0.0, 1.0, 0.0 };
  int Resolution = 1024;
  int Dimensions[2] = { 0, 0 };
  double Frame[4] = { 0.0, 0.0, 0.0, 0.0 };
  double Margin = 0.02;
  int Normalize = SceneUnits;
  int OutputScalarType = VTK_FLOAT;
  bool GenerateMask = false;
  bool GenerateNormals = false;
  bool GenerateColors = false;
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkIdType NumberOfTriangles = 0;
  vtkIdType NumberOfDegenerateTriangles = 0;
  vtkIdType NumberOfNonFiniteTriangles = 0;
  vtkIdType NumberOfOtherCells = 0;
  vtkIdType NumberOfOtherDataSets = 0;
  double LowestHeight;
  double HighestHeight;
  double ViewAxes[9] = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };

private:
  vtkDepthToHeightField(const vtkDepthToHeightField&) = delete;
  void operator=(const vtkDepthToHeightField&) = delete;

  class Implementation;
  std::unique_ptr<Implementation> Work;
};

#endif

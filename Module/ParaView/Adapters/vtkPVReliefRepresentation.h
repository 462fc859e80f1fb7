// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVReliefRepresentation
 * @brief   shows an image of heights in ParaView's render view by vtkReliefImageMapper
 *
 * The heights are gathered in every process and delivered to those that draw, which then shade what
 * is seen. Arrays of cells are taken as samples at the middle of the cells. Of an image of several
 * slices one is shown. Picking by coordinates works as for any prop; cells and points of it cannot
 * be selected.
 *
 * @sa vtkReliefImageMapper vtkPVReliefScene
 */
#ifndef vtkPVReliefRepresentation_h
#define vtkPVReliefRepresentation_h

#include "vtkNew.h" // For vtkNew
#include "vtkPVDataRepresentation.h"
#include "vtkParaViewReliefShadingModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkImageSlice;
class vtkReliefScene;
class vtkScalarsToColors;

class VTKPARAVIEWRELIEFSHADING_EXPORT vtkPVReliefRepresentation : public vtkPVDataRepresentation
{
public:
  static vtkPVReliefRepresentation* New();
  vtkTypeMacro(vtkPVReliefRepresentation, vtkPVDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using vtkPVDataRepresentation::SetInputArrayToProcess;
  /**
   * The array of heights, of points or cells. Without a name: the scalars of the points, or of the
   * cells, or the only array.
   */
  void SetInputArrayToProcess(
    int index, int port, int connection, int association, const char* name) override;

  /**
   * The scene, as vtkReliefImageMapper takes it.
   */
  void SetScene(vtkReliefScene* scene);

  /**
   * Of the scene, if it is a vtkPVReliefScene: here, since its default is found from the input.
   */
  void SetLampPosition(double x, double y, double z);

  /**
   * Which slice of an image of several is shown, by its index. Default: 0. Range: the image's,
   * clamped.
   */
  void SetSlice(int slice);

  ///@{
  /**
   * Whether the representation's colour map gives the diffuse colour by height, and that map.
   * Default: off.
   */
  void SetTint(bool tint);
  void SetLookupTable(vtkScalarsToColors* table);
  ///@}

  ///@{
  /**
   * As the mapper's, in any order. Defaults: off; 0; off; 0, automatic.
   */
  void SetUseHeightWithoutData(bool use);
  void SetHeightWithoutData(double value);
  void SetProgressive(bool progressive);
  void SetTracing(int device);
  ///@}

  ///@{
  /**
   * Of the prop. Interpolate: whether colours are interpolated where a sample covers several
   * pixels. Default: on.
   */
  void SetInterpolate(bool interpolate);
  void SetOpacity(double opacity);
  void SetPickable(int pickable);
  void SetPosition(double x, double y, double z);
  void SetScale(double x, double y, double z);
  void SetOrientation(double x, double y, double z);
  void SetOrigin(double x, double y, double z);
  ///@}

  void SetVisibility(bool visible) override;
  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* in, vtkInformation* out) override;

protected:
  vtkPVReliefRepresentation();
  ~vtkPVReliefRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkPVReliefRepresentation(const vtkPVReliefRepresentation&) = delete;
  void operator=(const vtkPVReliefRepresentation&) = delete;

  void Deliver(vtkInformation* in);
  void Take(vtkInformation* in);

  vtkNew<vtkImageSlice> Actor;
  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif

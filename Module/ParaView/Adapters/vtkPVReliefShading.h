// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVReliefShading
 * @brief   vtkImageReliefShading as ParaView needs it: pieces, cells, properties in any order
 *
 * Inputs are those of vtkImageReliefShading. Where ParaView runs on several processes, each has a
 * piece of the image only, and light comes from anywhere: so each gathers the whole of all inputs
 * and shades its own piece, and the picture is that of one process. Every process then holds the
 * heights, and 8 bytes a sample more.
 *
 * Arrays of cells, as ParaView's reader of rasters gives them, are taken as samples at the middle
 * of the cells: the output then has a sample less along each axis.
 *
 * @sa vtkImageReliefShading vtkPVReliefScene
 */
#ifndef vtkPVReliefShading_h
#define vtkPVReliefShading_h

#include "vtkImageReliefShading.h"
#include "vtkParaViewReliefShadingModule.h" // For export macro

#include <memory> // For std::unique_ptr

class VTKPARAVIEWRELIEFSHADING_EXPORT vtkPVReliefShading : public vtkImageReliefShading
{
public:
  static vtkPVReliefShading* New();
  vtkTypeMacro(vtkPVReliefShading, vtkImageReliefShading);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using vtkImageReliefShading::SetInputArrayToProcess;
  /**
   * The array of an input, of points or cells. Without a name: the scalars of the points, or of the
   * cells, or the only array. Textures and the mask are found in the same way.
   */
  void SetInputArrayToProcess(
    int index, int port, int connection, int association, const char* name) override;

  ///@{
  /**
   * As vtkImageReliefShading's, but the value does not turn the switch on: both may come in any
   * order.
   */
  void SetHeightWithoutData(double value);
  void SetUseHeightWithoutData(bool use);
  ///@}

  /**
   * Of the scene, if it is a vtkPVReliefScene: here, since ParaView's point widget wants it beside
   * the input.
   */
  void SetLampPosition(double x, double y, double z);

protected:
  vtkPVReliefShading();
  ~vtkPVReliefShading() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPVReliefShading(const vtkPVReliefShading&) = delete;
  void operator=(const vtkPVReliefShading&) = delete;

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOpenGLReliefImageMapper
 * @brief   OpenGL implementation of vtkReliefImageMapper
 *
 * Heights and their bounds lie in textures; a program traces one light at a time into a texture
 * with a texel for each shaded sample, others sum the lights and make colours of the sums, and
 * these are drawn as a textured rectangle. Each program is put together from the model's own text
 * and holds what the scene calls for only.
 *
 * A mapper may be shown by several renderers and windows: what is on the graphics processor is kept
 * for each window, what is seen for each renderer.
 */
#ifndef vtkOpenGLReliefImageMapper_h
#define vtkOpenGLReliefImageMapper_h

#include "vtkReliefImageMapper.h"
#include "vtkRenderingReliefShadingModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkImageData;

class VTKRENDERINGRELIEFSHADING_EXPORT vtkOpenGLReliefImageMapper : public vtkReliefImageMapper
{
public:
  static vtkOpenGLReliefImageMapper* New();
  vtkTypeMacro(vtkOpenGLReliefImageMapper, vtkReliefImageMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Called by the vtkImageSlice.
   */
  void Render(vtkRenderer* renderer, vtkImageSlice* slice) override;

  void ReleaseGraphicsResources(vtkWindow* window) override;

  int GetNumberOfPrograms() override;

  ///@{
  /**
   * The largest side of a texture, in texels, where it should be less than what OpenGL has. Heights
   * that do not fit lie in several. At least 64; 0 for what OpenGL has. Default: 0.
   */
  void SetTextureSizeLimit(int size);
  vtkGetMacro(TextureSizeLimit, int);
  ///@}

  /**
   * Copies the linear colours that the last frame in a renderer showed into an image of floats,
   * RGBA, one for each sample that was shaded. Its spacing is the distance between them in samples
   * and its origin the place of the first, in samples from the field's first. False, and an empty
   * image, where nothing has been shown.
   */
  bool GetShading(vtkRenderer* renderer, vtkImageData* image);

protected:
  vtkOpenGLReliefImageMapper();
  ~vtkOpenGLReliefImageMapper() override;

  int TextureSizeLimit = 0;

private:
  vtkOpenGLReliefImageMapper(const vtkOpenGLReliefImageMapper&) = delete;
  void operator=(const vtkOpenGLReliefImageMapper&) = delete;

  void Shade(vtkRenderer* renderer, vtkImageSlice* slice);

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefImageMapper
 * @brief   shows a height field in a vtkImageSlice, shaded on the graphics processor
 *
 * The picture is that of vtkImageReliefShading, from the same vtkReliefScene and the same model,
 * but only what can be seen is shaded, once for each pixel or sample, whichever are fewer, and only
 * what has changed is shaded again: move a light, and that light's shadows are found anew; change a
 * colour, and none are. Inputs are the filter's: 0 heights and, optional, 1 mask, 2 diffuse, 3 base
 * and 4 specular texture.
 *
 * Where several samples fall in a pixel, the middle one is shown. Where one covers several pixels,
 * the vtkImageProperty's InterpolationType decides: nearest, or else bilinear. Opacity, Border,
 * cropping, clipping planes, picking and the slice's matrix work as with vtkImageSliceMapper;
 * window, level, lookup table, ambient and diffuse of the vtkImageProperty, and Background, do not
 * apply. Samples without data are transparent. Beside a vtkShadowMapPass the picture stays as it
 * is, and its rectangle throws a shadow.
 *
 * The scene's lights are in the coordinates of the image, as for the filter: they move with the
 * slice. A scene without lights is lit by the renderer's lights, in world coordinates, but for
 * headlights, which leave no shadow where the eye would see it; without any, by a sun at azimuth
 * 315, altitude 45.
 *
 * While the render window's DesiredUpdateRate is at least 1, as interactors set it while a button
 * is held, detail is given up to keep that rate. At lower rates each frame is complete, unless it
 * is Progressive.
 *
 * There is an implementation for OpenGL 3.2, vtkOpenGLReliefImageMapper, which New() finds through
 * the object factory: C++ programs name VTK::ReliefShading in vtk_module_autoinit().
 *
 * @sa vtkImageReliefShading vtkReliefScene vtkImageSlice
 */
#ifndef vtkReliefImageMapper_h
#define vtkReliefImageMapper_h

#include "vtkImageMapper3D.h"
#include "vtkNew.h"                          // For vtkNew
#include "vtkRenderingReliefShadingModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkReliefScene;
class vtkReliefStatistics;
class vtkScalarsToColors;

namespace relief
{
namespace hosts
{
class HostInputs;
}
}

class VTKRENDERINGRELIEFSHADING_EXPORT vtkReliefImageMapper : public vtkImageMapper3D
{
public:
  static vtkReliefImageMapper* New();
  vtkTypeMacro(vtkReliefImageMapper, vtkImageMapper3D);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Invoked by the mapper when its picture has become complete, after a frame in which it was not.
   */
  enum Events
  {
    ConvergedEvent = 47101 // vtkCommand::UserEvent and a number of our own
  };

  ///@{
  /**
   * The scene: material, lights, height scale, accuracy. Never null: setting null is refused.
   * Default: a new vtkReliefScene.
   */
  void SetScene(vtkReliefScene* scene);
  vtkReliefScene* GetScene();
  ///@}

  ///@{
  /**
   * The mask, input 1: where it is 0 there is no data. Null for none.
   */
  void SetMaskConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(1, port); }
  void SetMaskData(vtkDataObject* mask) { this->SetInputDataObject(1, mask); }
  ///@}

  ///@{
  /**
   * Textures for the diffuse, base and specular colour, inputs 2, 3 and 4, as vtkImageReliefShading
   * takes them. Each lies over the material's constant colour, the diffuse one over the
   * LookupTable's colours too. Of each that shows, the colours in view are kept on the graphics
   * processor, 12 bytes a texel of the picture. Null for none.
   */
  void SetDiffuseTextureConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(2, port); }
  void SetDiffuseTextureData(vtkDataObject* texture) { this->SetInputDataObject(2, texture); }
  void SetBaseTextureConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(3, port); }
  void SetBaseTextureData(vtkDataObject* texture) { this->SetInputDataObject(3, texture); }
  void SetSpecularTextureConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(4, port); }
  void SetSpecularTextureData(vtkDataObject* texture) { this->SetInputDataObject(4, texture); }
  ///@}

  ///@{
  /**
   * On: textures cover the whole field, edge to edge. Off: each lies where its image does in the
   * world. Default: off.
   */
  vtkSetMacro(StretchTextures, bool);
  vtkGetMacro(StretchTextures, bool);
  vtkBooleanMacro(StretchTextures, bool);
  ///@}

  ///@{
  /**
   * A table that gives the diffuse colour by height, as vtkImageReliefShading takes it: 4 bytes a
   * sample. Null, the default, for none.
   */
  void SetLookupTable(vtkScalarsToColors* table);
  vtkScalarsToColors* GetLookupTable();
  ///@}

  ///@{
  /**
   * The height that marks samples without data, in the input's own values, and whether there is
   * one. Setting the value turns UseNoDataValue on. NaN is no data in any case. Default: off.
   */
  void SetNoDataValue(double value);
  vtkGetMacro(NoDataValue, double);
  vtkSetMacro(UseNoDataValue, bool);
  vtkGetMacro(UseNoDataValue, bool);
  vtkBooleanMacro(UseNoDataValue, bool);
  ///@}

  ///@{
  /**
   * Whether only a part of the image is shown, and which: first and last sample along each axis, in
   * the image's extent. Light comes from the whole image all the same. Default: off, all zeros.
   */
  vtkSetMacro(Cropping, bool);
  vtkGetMacro(Cropping, bool);
  vtkBooleanMacro(Cropping, bool);
  vtkSetVector6Macro(CroppingRegion, int);
  vtkGetVector6Macro(CroppingRegion, int);
  ///@}

  ///@{
  /**
   * Whether linear colours are sRGB-encoded for the screen. Off for renderers that encode their
   * picture themselves. Default: on.
   */
  vtkSetMacro(SRGBEncoding, bool);
  vtkGetMacro(SRGBEncoding, bool);
  vtkBooleanMacro(SRGBEncoding, bool);
  ///@}

  ///@{
  /**
   * How much memory of the graphics processor is spent, for each renderer, on keeping the
   * illumination of lights, 4 bytes for each texel of the picture and light: when a light moves,
   * only that one is traced again, and colours, intensities, coefficients and falloffs may change
   * without any ray. Lights that do not fit in are traced whenever the picture needs them. In
   * kibibytes; 0 keeps none. Default: 262144, which is 256 lights in 512 x 512 pixels.
   */
  vtkSetMacro(CacheMemoryLimit, unsigned long);
  vtkGetMacro(CacheMemoryLimit, unsigned long);
  ///@}

  ///@{
  /**
   * Whether a still picture that takes long is shown before it is complete, coarse or with its
   * strongest lights only, and refined from frame to frame. The mapper asks the render window's
   * interactor for these frames, by timers; where there is no interactor that is initialized, every
   * still frame is complete. Turn it off to write pictures of an interactive window. Default: on.
   */
  vtkSetMacro(Progressive, bool);
  vtkGetMacro(Progressive, bool);
  vtkBooleanMacro(Progressive, bool);
  ///@}

  ///@{
  /**
   * About how long such a frame may take, in seconds, above 0. Default: 0.2.
   */
  void SetProgressiveFrameTime(double seconds);
  vtkGetMacro(ProgressiveFrameTime, double);
  ///@}

  enum TracingDevices
  {
    TraceAutomatically = 0,
    TraceOnGraphicsProcessor = 1,
    TraceOnProcessor = 2
  };

  ///@{
  /**
   * Where rays are traced: by the graphics processor, or by the processor's threads with what
   * vtkImageReliefShading traces by, so that d is the filter's own. Both keep the scene's
   * Tolerance. TraceAutomatically takes the processor where OpenGL is drawn by software, as Mesa's
   * llvmpipe does, which runs the same work several times as long, and the graphics processor
   * elsewhere. For tracing on the processor the heights and their bounds take 8 bytes a sample.
   * Default: TraceAutomatically.
   */
  void SetTracing(int device);
  vtkGetMacro(Tracing, int);
  void SetTracingToAutomatic() { this->SetTracing(TraceAutomatically); }
  void SetTracingToGraphicsProcessor() { this->SetTracing(TraceOnGraphicsProcessor); }
  void SetTracingToProcessor() { this->SetTracing(TraceOnProcessor); }
  ///@}

  /**
   * Whether the last frame showed all that the scene asks for, at full detail. Before the first
   * frame it did not.
   */
  bool GetConverged() { return this->Converged; }

  /**
   * How much of the work for that has been done, from 0 to 1.
   */
  double GetRefinement() { return this->Refinement; }

  /**
   * What the last frame did. Cells are counted where rays are traced on the processor.
   */
  vtkReliefStatistics* GetStatistics();

  /**
   * How many shading programs have been made for the window of the last frame: one for each
   * combination of effects that was needed. A change of colours or positions makes none.
   */
  virtual int GetNumberOfPrograms() { return 0; }

  double* GetBounds() override;
  void GetBounds(double bounds[6]) override { this->vtkAbstractMapper3D::GetBounds(bounds); }
  void GetIndexBounds(double extent[6]) override;

  /**
   * Changes with the scene.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkReliefImageMapper();
  ~vtkReliefImageMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /**
   * Notes how far the picture is, and says so when it has become complete.
   */
  void SetProgressOfPicture(bool converged, double refinement);

  std::unique_ptr<relief::hosts::HostInputs> Inputs; // scene and table among them
  vtkNew<vtkReliefStatistics> Statistics;
  bool StretchTextures = false;
  double NoDataValue = 0.0;
  bool UseNoDataValue = false;
  bool Cropping = false;
  int CroppingRegion[6] = { 0, 0, 0, 0, 0, 0 };
  bool SRGBEncoding = true;
  unsigned long CacheMemoryLimit = 262144;
  bool Progressive = true;
  double ProgressiveFrameTime = 0.2;
  int Tracing = TraceAutomatically;
  bool Converged = false;
  double Refinement = 0.0;
  int DisplayExtent[6] = { 0, -1, 0, -1, 0, -1 };

private:
  vtkReliefImageMapper(const vtkReliefImageMapper&) = delete;
  void operator=(const vtkReliefImageMapper&) = delete;

  void UpdateSlice();
};

#endif

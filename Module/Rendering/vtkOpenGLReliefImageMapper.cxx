// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLReliefImageMapper.h"

#include "HostInputs.h"
#include "PictureExposure.h"
#include "PreparedScene.h"
#include "ReliefFrames.h"
#include "ReliefGridTrace.h"
#include "ReliefRectangle.h"
#include "ReliefRefresher.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"

#include "vtkCamera.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkTextureObject.h"

#include "ReliefOpenGL.h"

#include <algorithm>
#include <limits>
#include <map>
#include <new>
#include <utility>

vtkStandardNewMacro(vtkOpenGLReliefImageMapper);

namespace
{

// Below this rate, in frames a second, nobody waits for the next frame to see something move.
constexpr double MovingRate = 1.0;
// The part of a frame's time that is spent on shading; the rest is for what else a frame takes.
constexpr double ShadingShare = 0.7;

// Whether a pass is drawn that measures how far a light sees, for the shadows of all props. The
// camera stands where the light does, and depths are wanted in place of colours.
bool MeasuresShadows(vtkImageSlice* slice)
{
  vtkInformation* keys = slice->GetPropertyKeys();
  vtkInformationObjectBaseVectorKey* passes = vtkOpenGLRenderPass::RenderPasses();
  const int count = keys && keys->Has(passes) ? keys->Length(passes) : 0;
  for (int i = 0; i < count; ++i)
  {
    if (vtkShadowMapBakerPass::SafeDownCast(keys->Get(passes, i)))
    {
      return true;
    }
  }
  return false;
}

}

class vtkOpenGLReliefImageMapper::Internals
{
public:
  // What a renderer shows: its own lights may shine on it.
  struct View
  {
    relief::hosts::PreparedScene Scene;
    ReliefFrames Frames;
    double Exposure = 0.0;                               // in stops
    std::pair<std::uint64_t, std::uint64_t> ExposedFrom; // versions of field and scene
  };

  // What is on the graphics processor for a window.
  struct WindowState
  {
    explicit WindowState(vtkOpenGLRenderWindow* window)
      : Passes(window)
      , Created(window->GetContextCreationTime())
    {
      const GLubyte* renderer = glGetString(GL_RENDERER);
      this->IsSoftware =
        renderer && relief::IsSoftwareRenderer(reinterpret_cast<const char*>(renderer));
    }
    bool IsSoftware; // OpenGL is drawn by the processor
    ReliefPasses Passes;
    ReliefRectangle Rectangle;
    std::map<vtkRenderer*, View> Views;
    vtkMTimeType Created;
  };

  explicit Internals(vtkOpenGLReliefImageMapper* self)
    : Self(self)
  {
  }

  WindowState& GetState(vtkOpenGLRenderWindow* window);
  bool TracesOnProcessor(const WindowState& state) const;
  std::string Prepare(vtkRenderer* renderer, relief::hosts::PreparedScene& scene);
  void Expose(View& view, bool moving);
  void Tell(const ReliefFrames* frames, double exposure);
  void Draw(
    vtkRenderer* renderer, vtkImageSlice* slice, WindowState& state, const View& view, bool shows);
  void DrawDepth(vtkRenderer* renderer, vtkImageSlice* slice, WindowState& state);
  ReliefFrames::Request MakeRequest(
    vtkRenderer* renderer, vtkImageSlice* slice, const WindowState& state);
  ReliefRectangle::Place MakePlace(vtkImageSlice* slice);
  void GetArea(double area[4]) const;
  void Report(const std::string& problem);

  vtkOpenGLReliefImageMapper* Self;
  std::map<vtkOpenGLRenderWindow*, std::unique_ptr<WindowState>> Windows;
  vtkOpenGLRenderWindow* LastWindow = nullptr;
  ReliefRefresher Refresher;
  std::string LastProblem;
};

//------------------------------------------------------------------------------
vtkOpenGLReliefImageMapper::vtkOpenGLReliefImageMapper()
  : Internal(new Internals(this))
{
}

//------------------------------------------------------------------------------
vtkOpenGLReliefImageMapper::~vtkOpenGLReliefImageMapper() = default;

//------------------------------------------------------------------------------
void vtkOpenGLReliefImageMapper::SetTextureSizeLimit(int size)
{
  if (size != 0 && size < 64)
  {
    vtkErrorMacro("SetTextureSizeLimit: " << size << " was given, 0 or a number of at least 64 is "
                                          << "expected; " << this->TextureSizeLimit << " is kept.");
    return;
  }
  if (this->TextureSizeLimit != size)
  {
    this->TextureSizeLimit = size;
    this->Internal->Windows.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkOpenGLReliefImageMapper::Internals::WindowState& vtkOpenGLReliefImageMapper::Internals::GetState(
  vtkOpenGLRenderWindow* window)
{
  std::unique_ptr<WindowState>& state = this->Windows[window];
  if (!state || state->Created < window->GetContextCreationTime())
  {
    state = std::make_unique<WindowState>(window);
  }
  this->LastWindow = window;
  return *state;
}

//------------------------------------------------------------------------------
bool vtkOpenGLReliefImageMapper::Internals::TracesOnProcessor(const WindowState& state) const
{
  const int tracing = this->Self->Tracing;
  return tracing == TraceOnProcessor || (tracing == TraceAutomatically && state.IsSoftware);
}

//------------------------------------------------------------------------------
// Heights, textures and scene, as far as they have changed. Returns an empty text, or what is
// wrong.
std::string vtkOpenGLReliefImageMapper::Internals::Prepare(
  vtkRenderer* renderer, relief::hosts::PreparedScene& scene)
{
  vtkOpenGLReliefImageMapper* self = this->Self;
  vtkInformationVector** inputs = self->GetExecutive()->GetInputInformation();
  // All windows share the heights.
  const bool sweeps = std::any_of(this->Windows.begin(), this->Windows.end(),
    [this](const auto& window) { return this->TracesOnProcessor(*window.second); });
  const std::string wrong = self->Inputs->Update(
    inputs, [&](int port) { return self->GetInputArrayToProcess(port, inputs); },
    { self->UseNoDataValue, self->NoDataValue, self->StretchTextures }, sweeps);
  return wrong.empty()
    ? scene.Update(*self->Inputs, renderer->GetLights(), self->GetDataToWorldMatrix())
    : wrong;
}

//------------------------------------------------------------------------------
// What is shown of the field, in samples: x0, x1, y0, y1.
void vtkOpenGLReliefImageMapper::Internals::GetArea(double area[4]) const
{
  const int* extent = this->Self->GetInput()->GetExtent();
  const double border = this->Self->Border ? 0.5 : 0.0;
  for (int axis = 0; axis < 2; ++axis)
  {
    const int* shown = this->Self->DisplayExtent + 2 * axis;
    area[2 * axis] = shown[0] - extent[2 * axis] + 0.5 - border;
    area[2 * axis + 1] = shown[1] - extent[2 * axis] + 0.5 + border;
  }
}

//------------------------------------------------------------------------------
ReliefFrames::Request vtkOpenGLReliefImageMapper::Internals::MakeRequest(
  vtkRenderer* renderer, vtkImageSlice* slice, const WindowState& state)
{
  ReliefFrames::Request request;
  vtkImageData* image = this->Self->GetInput();
  const int* extent = image->GetExtent();
  int corner[2];
  renderer->GetTiledSizeAndOrigin(
    &request.viewportSize[0], &request.viewportSize[1], &corner[0], &corner[1]);

  // Samples to indices, to data, to the world, to clip coordinates.
  vtkNew<vtkMatrix4x4> toClip;
  for (int axis = 0; axis < 2; ++axis)
  {
    toClip->SetElement(axis, 3, extent[2 * axis] - 0.5);
  }
  toClip->SetElement(2, 3, extent[4]);
  vtkMatrix4x4::Multiply4x4(image->GetIndexToPhysicalMatrix(), toClip, toClip);
  vtkMatrix4x4::Multiply4x4(this->Self->GetDataToWorldMatrix(), toClip, toClip);
  vtkMatrix4x4::Multiply4x4(renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
                              renderer->GetTiledAspectRatio(), -1.0, 1.0),
    toClip, toClip);
  double area[4];
  this->GetArea(area);
  request.part = relief::FindVisiblePart(toClip->GetData(), area, request.viewportSize);

  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  const int limit = this->Self->TextureSizeLimit;
  const int largest = vtkTextureObject::GetMaximumTextureSize(window);
  request.maximumTextureSize = limit > 0 ? std::min(limit, largest) : largest;
  request.textures = this->Self->Inputs->GetTextures().GetVersion();
  request.onProcessor = this->TracesOnProcessor(state);
  request.memory = 1024.0 * static_cast<double>(this->Self->CacheMemoryLimit);

  const double rate = window->GetDesiredUpdateRate();
  request.moving = rate >= MovingRate;
  if (request.moving)
  {
    request.seconds =
      ShadingShare * std::clamp(slice->GetAllocatedRenderTime(), 0.1 / rate, 1.0 / rate);
  }
  else
  {
    request.seconds = this->Self->Progressive && this->Refresher.CanAsk(window)
      ? this->Self->ProgressiveFrameTime
      : std::numeric_limits<double>::infinity();
  }
  return request;
}

//------------------------------------------------------------------------------
ReliefRectangle::Place vtkOpenGLReliefImageMapper::Internals::MakePlace(vtkImageSlice* slice)
{
  ReliefRectangle::Place place;
  vtkImageData* image = this->Self->GetInput();
  const int* extent = image->GetExtent();
  double area[4];
  this->GetArea(area);
  for (int k = 0; k < 4; ++k)
  {
    place.samples[k][0] = area[k == 1 || k == 2 ? 1 : 0];
    place.samples[k][1] = area[k >= 2 ? 3 : 2];
    const double index[3] = { extent[0] + place.samples[k][0] - 0.5,
      extent[2] + place.samples[k][1] - 0.5, static_cast<double>(extent[4]) };
    image->TransformContinuousIndexToPhysicalPoint(index, place.corners[k]);
  }
  place.toWorld = this->Self->GetDataToWorldMatrix();
  place.clippingPlanes = this->Self->GetClippingPlanes();
  place.propertyKeys = slice->GetPropertyKeys();
  return place;
}

//------------------------------------------------------------------------------
// Says what is wrong, once.
void vtkOpenGLReliefImageMapper::Internals::Report(const std::string& problem)
{
  if (!problem.empty() && problem != this->LastProblem)
  {
    vtkErrorWithObjectMacro(this->Self, << problem << ".");
  }
  this->LastProblem = problem;
}

//------------------------------------------------------------------------------
void vtkOpenGLReliefImageMapper::Render(vtkRenderer* renderer, vtkImageSlice* slice)
{
  vtkOpenGLClearErrorMacro();
  try
  {
    this->Shade(renderer, slice);
  }
  catch (const std::bad_alloc&)
  {
    this->Internal->Report("there is not enough memory to shade the image");
  }
}

//------------------------------------------------------------------------------
// Finds the exposure, unless it is at hand already. While things move, an automatic one stays.
void vtkOpenGLReliefImageMapper::Internals::Expose(View& view, bool moving)
{
  const relief::HeightField& field = this->Self->Inputs->GetField();
  vtkReliefScene* scene = this->Self->Inputs->GetScene();
  const std::pair<std::uint64_t, std::uint64_t> from(field.GetVersion(), view.Scene.GetVersion());
  const bool any = view.ExposedFrom.second != 0;
  if (from != view.ExposedFrom && !(any && moving && scene->GetAutomaticExposure()))
  {
    view.Exposure = relief::hosts::FindExposure(scene, field, view.Scene.Get()).stops;
    view.ExposedFrom = from;
  }
}

//------------------------------------------------------------------------------
// What the frame has done, or nothing.
void vtkOpenGLReliefImageMapper::Internals::Tell(const ReliefFrames* frames, double exposure)
{
  const ReliefFrames::Work work = frames ? frames->GetWork() : ReliefFrames::Work();
  vtkReliefStatistics* statistics = this->Self->Statistics;
  statistics->SetLightsTraced(work.lightsTraced);
  statistics->SetLightsReused(work.lightsReused);
  statistics->SetRaysTraced(work.rays);
  statistics->SetCellsVisited(work.cells);
  statistics->SetEffectsEvaluated(frames ? frames->GetEffects() : 0);
  statistics->SetExposure(exposure);
}

//------------------------------------------------------------------------------
// Draws what there is of the picture, in VTK's state for the slice.
void vtkOpenGLReliefImageMapper::Internals::Draw(
  vtkRenderer* renderer, vtkImageSlice* slice, WindowState& state, const View& view, bool shows)
{
  vtkOpenGLReliefImageMapper* self = this->Self;
  vtkOpenGLState* gl = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow())->GetState();
  vtkOpenGLState::ScopedglDepthMask depthMask(gl);
  vtkOpenGLState::ScopedglColorMask colorMask(gl);
  gl->vtkglDepthMask(self->DepthEnable ? GL_TRUE : GL_FALSE);
  if (!self->ColorEnable && !self->MatteEnable)
  {
    gl->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  }
  const ReliefRectangle::Place place = this->MakePlace(slice);
  const bool backing = slice->GetProperty()->GetBacking() != 0;
  if (backing && (self->MatteEnable || (self->DepthEnable && !self->ColorEnable)))
  {
    state.Rectangle.DrawBacking(renderer, place, slice->GetProperty());
  }
  const ReliefLayer& colors = view.Frames.GetColors();
  if (shows && colors.texture && (self->ColorEnable || (!backing && self->DepthEnable)))
  {
    state.Rectangle.Draw(renderer, place, colors, slice->GetProperty(), self->SRGBEncoding,
      relief::f64::reliefExposureFactor(view.Exposure));
  }
}

//------------------------------------------------------------------------------
// Draws the rectangle alone, in any colour.
void vtkOpenGLReliefImageMapper::Internals::DrawDepth(
  vtkRenderer* renderer, vtkImageSlice* slice, WindowState& state)
{
  if (this->Self->GetInput() && this->Self->DepthEnable)
  {
    state.Rectangle.DrawBacking(renderer, this->MakePlace(slice), slice->GetProperty());
  }
}

//------------------------------------------------------------------------------
void vtkOpenGLReliefImageMapper::Shade(vtkRenderer* renderer, vtkImageSlice* slice)
{
  // What is shown.
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  Internals& internal = *this->Internal;
  Internals::WindowState& state = internal.GetState(window);
  if (MeasuresShadows(slice))
  {
    // Shaded for this camera, what is kept for the other would be lost.
    internal.DrawDepth(renderer, slice, state);
    return;
  }
  Internals::View& view = state.Views[renderer];
  ReliefFrames& frames = view.Frames;
  const std::string wrong = internal.Prepare(renderer, view.Scene);
  if (!wrong.empty())
  {
    internal.Report(wrong);
    return;
  }

  // The picture, as far as there is time. A pass that finds out what is where needs no new one.
  const bool selecting = renderer->GetSelector() != nullptr && frames.GetColors().texture;
  const ReliefFrames::Request request = internal.MakeRequest(renderer, slice, state);
  const relief::HeightField& field = this->Inputs->GetField();
  const bool shows = request.part.any && field.HasData();
  if (!selecting)
  {
    internal.Tell(nullptr, 0.0);
  }
  if (!selecting && shows)
  {
    const std::string problem =
      state.Passes.GetField().Load(window, field, request.maximumTextureSize);
    if (!problem.empty())
    {
      internal.Report(problem);
      return;
    }
    if (!frames.Update(window, state.Passes, field, view.Scene, request))
    {
      internal.Report(state.Passes.GetProblem());
      return;
    }
    internal.Expose(view, request.moving);
    internal.Tell(&frames, view.Exposure);
  }
  internal.Report(std::string());
  internal.Draw(renderer, slice, state, view, shows);

  // How far it is.
  if (!selecting)
  {
    const bool converged = !shows || frames.IsConverged();
    if (!converged && !request.moving)
    {
      internal.Refresher.Ask(window);
    }
    this->SetProgressOfPicture(converged, shows ? frames.GetProgress() : 1.0);
  }
  // The slice adds this to its estimate, which VTK wants to be above 0.
  this->TimeToDraw = 0.0001;
  vtkOpenGLCheckErrorMacro("failed after Render");
}

//------------------------------------------------------------------------------
void vtkOpenGLReliefImageMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  auto found = this->Internal->Windows.find(vtkOpenGLRenderWindow::SafeDownCast(window));
  if (found != this->Internal->Windows.end())
  {
    found->second->Rectangle.ReleaseGraphicsResources(window);
    this->Internal->Windows.erase(found);
    this->SetProgressOfPicture(false, 0.0);
  }
}

//------------------------------------------------------------------------------
int vtkOpenGLReliefImageMapper::GetNumberOfPrograms()
{
  auto found = this->Internal->Windows.find(this->Internal->LastWindow);
  return found == this->Internal->Windows.end() ? 0 : found->second->Passes.GetNumberOfPrograms();
}

//------------------------------------------------------------------------------
bool vtkOpenGLReliefImageMapper::GetShading(vtkRenderer* renderer, vtkImageData* image)
{
  image->Initialize();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  auto found = this->Internal->Windows.find(window);
  if (found == this->Internal->Windows.end())
  {
    return false;
  }
  const ReliefLayer& colors = found->second->Views[renderer].Frames.GetColors();
  if (!colors.texture)
  {
    return false;
  }
  window->MakeCurrent();
  vtkSmartPointer<vtkPixelBufferObject> buffer;
  buffer.TakeReference(colors.texture->Download());
  const relief::ReliefGrid& grid = colors.grid;
  image->SetDimensions(grid.size[0], grid.size[1], 1);
  image->SetSpacing(grid.stride[0], grid.stride[1], 1.0);
  image->SetOrigin((grid.first[0] + 0.5) * grid.stride[0] - 0.5,
    (grid.first[1] + 0.5) * grid.stride[1] - 0.5, 0.0);
  image->AllocateScalars(VTK_FLOAT, 4);
  unsigned int size[2] = { static_cast<unsigned int>(grid.size[0]),
    static_cast<unsigned int>(grid.size[1]) };
  vtkIdType increments[2] = { 0, 0 };
  return buffer->Download2D(VTK_FLOAT, image->GetScalarPointer(), size, 4, increments);
}

//------------------------------------------------------------------------------
void vtkOpenGLReliefImageMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TextureSizeLimit: " << this->TextureSizeLimit << "\n";
}

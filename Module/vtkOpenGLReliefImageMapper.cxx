// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLReliefImageMapper.h"

#include "ReliefRectangle.h"
#include "ReliefRefresher.h"
#include "ReliefView.h"
#include "vtkReliefConversion.h"
#include "vtkReliefHeights.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkReliefTextures.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCollectionRange.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkInformation.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTextureObject.h"

#include "vtk_glew.h"

#include <algorithm>
#include <limits>
#include <map>
#include <new>

vtkStandardNewMacro(vtkOpenGLReliefImageMapper);

namespace
{

// Below this rate, in frames a second, nobody waits for the next frame to see something move.
constexpr double MovingRate = 1.0;
// The part of a frame's time that is spent on shading; the rest is for what else a frame takes.
constexpr double ShadingShare = 0.7;

// A light of the world, in the coordinates of data that a matrix takes to the world.
vtkSmartPointer<vtkLight> ToData(vtkLight* light, vtkMatrix4x4* toWorld)
{
  vtkNew<vtkMatrix4x4> toData;
  vtkMatrix4x4::Invert(toWorld, toData);
  auto transform = [&](const double world[3], double data[3])
  {
    const double point[4] = { world[0], world[1], world[2], 1.0 };
    double result[4];
    toData->MultiplyPoint(point, result);
    std::transform(result, result + 3, data, [&](double c) { return c / result[3]; });
  };
  double position[3];
  double focal[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focal);
  transform(position, position);
  transform(focal, focal);
  auto result = vtkSmartPointer<vtkLight>::New();
  result->SetLightTypeToSceneLight();
  result->SetPositional(light->GetPositional());
  result->SetPosition(position);
  result->SetFocalPoint(focal);
  result->SetDiffuseColor(light->GetDiffuseColor());
  result->SetIntensity(light->GetIntensity());
  result->SetSwitch(light->GetSwitch());
  result->SetInformation(light->GetInformation());
  return result;
}

}

class vtkOpenGLReliefImageMapper::Internals
{
public:
  // What is on the graphics processor for a window.
  struct WindowState
  {
    explicit WindowState(vtkOpenGLRenderWindow* window)
      : Passes(window)
      , Created(window->GetContextCreationTime())
    {
    }
    ReliefPasses Passes;
    ReliefRectangle Rectangle;
    std::map<vtkRenderer*, ReliefView> Views;
    vtkMTimeType Created;
  };

  explicit Internals(vtkOpenGLReliefImageMapper* self)
    : Self(self)
  {
    // An observer takes the place of printing.
    vtkNew<vtkCallbackCommand> nothing;
    nothing->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
    this->Silent->AddObserver(vtkCommand::WarningEvent, nothing);
  }

  WindowState& GetState(vtkOpenGLRenderWindow* window);
  std::string Prepare(vtkRenderer* renderer, relief::Scene& scene);
  std::string AddTextures(relief::Scene& scene);
  ReliefView::Request MakeRequest(vtkRenderer* renderer, vtkImageSlice* slice);
  ReliefRectangle::Place MakePlace(vtkImageSlice* slice);
  void GetArea(double area[4]) const;
  void Report(const std::string& problem);

  vtkOpenGLReliefImageMapper* Self;
  vtkReliefHeights Heights;
  vtkReliefTextures Textures;
  vtkMTimeType TextureTime = 0; // of the inputs and of what says how they are read
  vtkMTimeType ToldTime = 0;    // when there was something new to warn of
  vtkNew<vtkObject> Silent;
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
// Prepares heights and scene. Returns an empty text, or what is wrong.
std::string vtkOpenGLReliefImageMapper::Internals::Prepare(
  vtkRenderer* renderer, relief::Scene& result)
{
  vtkReliefScene* scene = this->Self->Scene;
  vtkReliefHeights::Source source;
  source.image = this->Self->GetInput();
  source.scalars = this->Self->GetInputArrayToProcess(0, source.image);
  source.mask = vtkImageData::SafeDownCast(this->Self->GetInputDataObject(1, 0));
  source.maskScalars = source.mask ? this->Self->GetInputArrayToProcess(1, source.mask) : nullptr;
  source.scale = scene->GetHeightScale();
  source.useNoData = this->Self->UseNoDataValue;
  source.noData = this->Self->NoDataValue;
  std::string wrong = this->Heights.Update(source);
  if (!wrong.empty())
  {
    return wrong;
  }

  const double datum = this->Heights.GetField().GetDatum();
  result = vtkReliefConvertMaterial(scene, this->Heights.GetFrame(), datum);
  // The renderer's lights stand in for those of a scene that has none, but for headlights: light
  // along the line of sight leaves no shadow in view.
  vtkNew<vtkLightCollection> others;
  for (vtkLight* light : vtk::Range(renderer->GetLights()))
  {
    if (!light->LightTypeIsHeadlight())
    {
      others->AddItem(ToData(light, this->Self->GetDataToWorldMatrix()));
    }
  }
  wrong = vtkReliefConvertLights(scene, others->GetNumberOfItems() > 0 ? others.Get() : nullptr,
    this->Heights.GetFrame(), this->Heights.GetField(), result.lights);
  return wrong.empty() ? this->AddTextures(result) : wrong;
}

//------------------------------------------------------------------------------
// Adds the textures and the table to a scene. Returns an empty text, or what is wrong.
std::string vtkOpenGLReliefImageMapper::Internals::AddTextures(relief::Scene& result)
{
  vtkReliefTextureInput inputs[5];
  this->TextureTime = this->Self->vtkImageMapper3D::GetMTime();
  for (int port = 0; port < 5; ++port)
  {
    vtkReliefTextureInput& input = inputs[port];
    input.image = vtkImageData::SafeDownCast(
      port == 0 ? this->Self->GetInput() : this->Self->GetInputDataObject(port, 0));
    if (port == 1 || !input.image)
    {
      continue;
    }
    input.scalars = this->Self->GetInputArrayToProcess(port, input.image);
    vtkInformation* info = this->Self->GetInputInformation(port, 0);
    std::copy_n(info && info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())
        ? info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())
        : input.image->GetExtent(),
      6, input.whole);
    this->TextureTime = std::max({ this->TextureTime, input.image->GetMTime(),
      input.scalars ? input.scalars->GetMTime() : 0 });
  }
  vtkScalarsToColors* table = this->Self->LookupTable;
  this->TextureTime = table ? std::max(this->TextureTime, table->GetMTime()) : this->TextureTime;
  // What there is to warn of is said once, not in every frame.
  const bool told = this->TextureTime == this->ToldTime;
  this->ToldTime = this->TextureTime;
  const std::string wrong = this->Textures.Add(inputs[0], { inputs[2], inputs[3], inputs[4] },
    table, this->Self->StretchTextures,
    told ? this->Silent.Get() : static_cast<vtkObject*>(this->Self), result);
  if (!table)
  {
    this->Textures.Release();
  }
  return wrong;
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
ReliefView::Request vtkOpenGLReliefImageMapper::Internals::MakeRequest(
  vtkRenderer* renderer, vtkImageSlice* slice)
{
  ReliefView::Request request;
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
  request.textures = this->TextureTime;
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
void vtkOpenGLReliefImageMapper::Shade(vtkRenderer* renderer, vtkImageSlice* slice)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  Internals& internal = *this->Internal;
  relief::Scene scene;
  const std::string wrong = internal.Prepare(renderer, scene);
  if (!wrong.empty())
  {
    internal.Report(wrong);
    return;
  }
  Internals::WindowState& state = internal.GetState(window);
  ReliefView& view = state.Views[renderer];

  // A pass that finds out what is where needs no new picture.
  const bool selecting = renderer->GetSelector() != nullptr && view.GetColors().texture;
  const ReliefView::Request request = internal.MakeRequest(renderer, slice);
  const relief::HeightField& field = internal.Heights.GetField();
  const bool shows = request.part.any && field.HasData();
  if (!selecting)
  {
    this->Statistics->SetLightsTraced(0);
    this->Statistics->SetLightsReused(0);
    this->Statistics->SetRaysTraced(0);
    this->Statistics->SetEffectsEvaluated(0);
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
    if (!view.Update(window, state.Passes, field, scene, request))
    {
      internal.Report(state.Passes.GetProblem());
      return;
    }
    const ReliefView::Work& work = view.GetWork();
    const relief::EffectPlan& plan = view.GetPlan();
    this->Statistics->SetLightsTraced(work.lightsTraced);
    this->Statistics->SetLightsReused(work.lightsReused);
    this->Statistics->SetRaysTraced(work.rays);
    const bool illuminates = plan.diffuse || plan.scatter;
    this->Statistics->SetEffectsEvaluated(
      (scene.specularCoefficient < 1.0 && !scene.baseTextures.empty()
          ? vtkReliefStatistics::BaseTexture
          : 0) |
      (illuminates && !scene.diffuseTextures.empty() ? vtkReliefStatistics::DiffuseTexture : 0) |
      (plan.specular && !scene.specularTextures.empty() ? vtkReliefStatistics::SpecularTexture
                                                        : 0) |
      (plan.diffuse || plan.scatter ? vtkReliefStatistics::Illumination : 0) |
      (plan.specular ? vtkReliefStatistics::Normals | vtkReliefStatistics::Specular : 0) |
      (plan.scatter ? vtkReliefStatistics::ForwardScatter : 0));
  }
  internal.Report(std::string());

  vtkOpenGLState* glState = window->GetState();
  vtkOpenGLState::ScopedglDepthMask depthMask(glState);
  vtkOpenGLState::ScopedglColorMask colorMask(glState);
  glState->vtkglDepthMask(this->DepthEnable ? GL_TRUE : GL_FALSE);
  if (!this->ColorEnable && !this->MatteEnable)
  {
    glState->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  }
  const ReliefRectangle::Place place = internal.MakePlace(slice);
  const bool backing = slice->GetProperty()->GetBacking() != 0;
  if (backing && (this->MatteEnable || (this->DepthEnable && !this->ColorEnable)))
  {
    state.Rectangle.DrawBacking(renderer, place, slice->GetProperty());
  }
  if (shows && view.GetColors().texture && (this->ColorEnable || (!backing && this->DepthEnable)))
  {
    state.Rectangle.Draw(
      renderer, place, view.GetColors(), slice->GetProperty(), this->SRGBEncoding);
  }

  if (!selecting)
  {
    const bool converged = !shows || view.IsConverged();
    if (!converged && !request.moving)
    {
      internal.Refresher.Ask(window);
    }
    this->SetProgressOfPicture(converged, shows ? view.GetProgress() : 1.0);
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
  const ReliefLayer& colors = found->second->Views[renderer].GetColors();
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

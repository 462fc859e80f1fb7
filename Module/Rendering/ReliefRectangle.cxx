// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefRectangle.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkImageProperty.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLTexture.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"
#include "vtkTextureObject.h"
#include "vtkUniforms.h"

#include "ReliefDisplayFS.h"

#include <set>
#include <string>

//------------------------------------------------------------------------------
ReliefRectangle::ReliefRectangle()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(4);
  this->Polygon->SetPoints(points);
  vtkNew<vtkCellArray> triangles;
  const vtkIdType indices[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
  for (const auto& triangle : indices)
  {
    triangles->InsertNextCell(3, triangle);
  }
  this->Polygon->SetPolys(triangles);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  coordinates->SetNumberOfTuples(4);
  this->Polygon->GetPointData()->SetTCoords(coordinates);

  for (vtkActor* actor : { this->Picture.Get(), this->Backing.Get() })
  {
    vtkNew<vtkOpenGLPolyDataMapper> mapper;
    mapper->SetInputData(this->Polygon);
    actor->SetMapper(mapper);
    // Colours come out as they are. All the same VTK's program must know of lights: only then does
    // it have what passes for shadows build upon.
    actor->GetProperty()->SetAmbient(1.0);
    actor->GetProperty()->SetDiffuse(0.0);
    actor->GetProperty()->SetSpecular(0.0);
  }
  this->Picture->SetTexture(this->Texture);
}

//------------------------------------------------------------------------------
ReliefRectangle::~ReliefRectangle() = default;

//------------------------------------------------------------------------------
void ReliefRectangle::SetEncoding(bool encoded)
{
  if (this->Encoding == (encoded ? 1 : 0))
  {
    return;
  }
  this->Encoding = encoded ? 1 : 0;
  vtkShaderProperty* shader = this->Picture->GetShaderProperty();
  shader->ClearAllFragmentShaderReplacements();
  shader->AddFragmentShaderReplacement("//VTK::TCoord::Impl", true,
    relief::SelectLines(
      ReliefDisplayFS, encoded ? std::set<std::string>{ "Encoded" } : std::set<std::string>()),
    false);
  if (encoded)
  {
    shader->AddFragmentShaderReplacement(
      "//VTK::TCoord::Dec", true, relief::EncodingFunctions() + "//VTK::TCoord::Dec\n", false);
  }
}

//------------------------------------------------------------------------------
void ReliefRectangle::Draw(vtkRenderer* renderer, const Place& place, const ReliefLayer& colors,
  vtkImageProperty* property, bool encoded, double exposure)
{
  this->SetEncoding(encoded);
  this->Picture->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf(
    "exposure", static_cast<float>(exposure));
  vtkDataArray* coordinates = this->Polygon->GetPointData()->GetTCoords();
  for (vtkIdType k = 0; k < 4; ++k)
  {
    this->Polygon->GetPoints()->SetPoint(k, place.corners[k]);
    for (int axis = 0; axis < 2; ++axis)
    {
      const double texel =
        place.samples[k][axis] / colors.grid.stride[axis] - colors.grid.first[axis];
      coordinates->SetComponent(k, axis, texel / colors.grid.size[axis]);
    }
  }
  this->Polygon->GetPoints()->Modified();
  coordinates->Modified();
  this->Polygon->Modified();

  const bool nearest = property->GetInterpolationType() == VTK_NEAREST_INTERPOLATION;
  const int filter = nearest ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  colors.texture->SetMinificationFilter(filter);
  colors.texture->SetMagnificationFilter(filter);
  this->Texture->SetTextureObject(colors.texture);
  this->Picture->SetUserMatrix(place.toWorld);
  this->Picture->SetPropertyKeys(place.propertyKeys);
  this->Picture->GetProperty()->SetOpacity(property->GetOpacity());
  this->Picture->GetMapper()->SetClippingPlanes(place.clippingPlanes);
  this->Texture->Render(renderer);
  this->Picture->GetMapper()->Render(renderer, this->Picture);
  this->Texture->PostRender(renderer);
}

//------------------------------------------------------------------------------
void ReliefRectangle::DrawBacking(
  vtkRenderer* renderer, const Place& place, vtkImageProperty* property)
{
  for (vtkIdType k = 0; k < 4; ++k)
  {
    this->Polygon->GetPoints()->SetPoint(k, place.corners[k]);
  }
  this->Polygon->GetPoints()->Modified();
  this->Polygon->Modified();
  this->Backing->SetUserMatrix(place.toWorld);
  this->Backing->SetPropertyKeys(place.propertyKeys);
  this->Backing->GetProperty()->SetColor(property->GetBackingColor());
  this->Backing->GetMapper()->SetClippingPlanes(place.clippingPlanes);
  this->Backing->GetMapper()->Render(renderer, this->Backing);
}

//------------------------------------------------------------------------------
void ReliefRectangle::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Texture->SetTextureObject(nullptr);
  this->Picture->ReleaseGraphicsResources(window);
  this->Backing->ReleaseGraphicsResources(window);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "RunKeys.h"

#include "HeightHash.h"
#include "PiecePlan.h"
#include "SceneParameters.h"

#include "vtkCollectionRange.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkScalarsToColors.h"

#include <cstdint>
#include <locale>
#include <sstream>

namespace relief::streaming
{
namespace
{
std::ostringstream NewText()
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  return text;
}

//------------------------------------------------------------------------------
void AddParameters(parameters::Owner owner, vtkObject* object, const char* name, std::ostream& text)
{
  text << name << ":";
  for (const parameters::Parameter& parameter : parameters::All())
  {
    if (parameter.Of == owner)
    {
      text << " " << parameter.Name;
      for (const double value : parameter.Get(object))
      {
        text << " " << value;
      }
    }
  }
  text << "\n";
}

//------------------------------------------------------------------------------
void AddLights(vtkReliefScene* scene, std::ostream& text)
{
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    double position[3];
    double focus[3];
    light->GetTransformedPosition(position);
    light->GetTransformedFocalPoint(focus);
    text << "light: " << (light->GetPositional() ? "lamp" : "sun");
    for (int axis = 0; axis < 3; ++axis)
    {
      text << " " << position[axis] << " " << focus[axis];
    }
    text << " " << light->GetSwitch() << " ";
    AddParameters(parameters::Owner::Light, light, "with", text);
  }
}

//------------------------------------------------------------------------------
void AddPlace(vtkImageData* image, std::ostream& text)
{
  for (const int number : { 0, 1, 2, 3, 4, 5 })
  {
    text << " " << image->GetExtent()[number];
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    text << " " << image->GetOrigin()[axis] << " " << image->GetSpacing()[axis];
  }
  for (int k = 0; k < 9; ++k)
  {
    text << " " << image->GetDirectionMatrix()->GetData()[k];
  }
}

//------------------------------------------------------------------------------
/// By its numbers, whatever file it is from.
void AddImage(const char* name, vtkImageData* image, std::ostream& text)
{
  vtkDataArray* values = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!values)
  {
    text << name << ": none\n";
    return;
  }
  const std::uint64_t components = static_cast<std::uint64_t>(values->GetNumberOfComponents());
  std::uint64_t hash = MixHash(static_cast<std::uint64_t>(values->GetDataType()), components);
  const auto* bytes = static_cast<const unsigned char*>(values->GetVoidPointer(0));
  const vtkIdType count =
    values->GetNumberOfTuples() * values->GetNumberOfComponents() * values->GetDataTypeSize();
  for (vtkIdType k = 0; k < count; ++k)
  {
    hash = MixHash(hash, bytes[k]);
  }
  text << name << ": " << HashText(hash);
  AddPlace(image, text);
  text << "\n";
}

//------------------------------------------------------------------------------
/// By the colours that it gives to many values of its range, and beside it.
void AddTable(vtkScalarsToColors* table, std::ostream& text)
{
  if (!table)
  {
    text << "table: none\n";
    return;
  }
  const double* range = table->GetRange();
  constexpr int steps = 1 << 16;
  std::uint64_t hash = 0;
  for (int k = -1; k <= steps + 1; ++k)
  {
    const double value = range[0] + (range[1] - range[0]) * k / steps;
    const unsigned char* color = table->MapValue(value);
    for (int c = 0; c < 4; ++c)
    {
      hash = MixHash(hash, color[c]);
    }
  }
  text << "table: " << range[0] << " " << range[1] << " " << HashText(hash) << "\n";
}
}

//------------------------------------------------------------------------------
std::string KeyOfScene(vtkReliefScene* scene)
{
  using parameters::Owner;
  std::ostringstream text = NewText();
  AddParameters(Owner::Scene, scene, "scene", text);
  AddParameters(Owner::Material, scene->GetMaterial(), "material", text);
  AddLights(scene, text);
  if (scene->GetEnvironment())
  {
    AddParameters(Owner::Environment, scene->GetEnvironment(), "environment", text);
  }
  return text.str();
}

//------------------------------------------------------------------------------
std::string KeyOfShading(vtkImageReliefShading* shading)
{
  const std::string heights = shading->GetHeightHash(); // which updates what is at the ports
  auto* image = vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0));
  if (heights.empty() || !image)
  {
    return std::string();
  }
  std::ostringstream text = NewText();
  text << "version: ReliefShading " RELIEFSHADING_VERSION ", model "
       << vtkImageReliefShading::GetModelVersion() << "\n"
       << "heights: " << heights << "\n"
       << "place:";
  AddPlace(image, text);
  text << "\n" << KeyOfScene(shading->GetScene());
  vtkReliefEnvironment* environment = shading->GetScene()->GetEnvironment();
  AddImage("environment's image", environment ? environment->GetImage() : nullptr, text);
  constexpr const char* names[] = { "diffuse texture", "base texture", "specular texture" };
  for (int k = 0; k < 3; ++k)
  {
    const int port = 2 + k;
    AddImage(names[k],
      shading->GetNumberOfInputConnections(port) > 0
        ? vtkImageData::SafeDownCast(shading->GetInputDataObject(port, 0))
        : nullptr,
      text);
  }
  text << "textures: " << (shading->GetStretchTextures() ? "stretched" : "placed") << "\n";
  AddTable(shading->GetLookupTable(), text);
  if (shading->GetUseHeightRange())
  {
    text << "range: " << shading->GetHeightRange()[0] << " " << shading->GetHeightRange()[1]
         << "\n";
  }
  if (shading->GetBeyondMemory() == vtkImageReliefShading::BeyondMemoryBounds)
  {
    text << "heights by bounds: beyond " << shading->GetHeightMemoryLimit() << " KiB\n";
  }
  text << "numbers: " << (shading->GetOutputScalarType() == VTK_FLOAT ? "float" : "uint8")
       << "\narrays:";
  for (const std::string& array : ArraysOf(shading))
  {
    text << " " << array;
  }
  text << "\n";
  return text.str();
}
}

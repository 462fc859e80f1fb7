// SPDX-License-Identifier: BSD-3-Clause
#include "PlacedTextures.h"

#include "ImageFrame.h"
#include "TiledHeights.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkReliefThreads.h"
#include "vtkScalarsToColors.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <new>
#include <sstream>

namespace relief::hosts
{
namespace
{
struct Kind
{
  const char* what;
  int effect;
  std::vector<ColorTexture> Scene::*textures;
};
constexpr Kind Kinds[] = { { "diffuse texture", DiffuseTextureEffect, &Scene::diffuseTextures },
  { "base texture", BaseTextureEffect, &Scene::baseTextures },
  { "specular texture", SpecularTextureEffect, &Scene::specularTextures } };

// Where an image lies, in words.
std::string Bounds(vtkImageData* image)
{
  const double* bounds = image->GetBounds();
  std::ostringstream text;
  text << std::setprecision(10) << "(" << bounds[0] << ", " << bounds[1] << ", " << bounds[2]
       << ", " << bounds[3] << ")";
  return text.str();
}

// Makes a texture of an image and leaves its place open. Returns an empty text, or what is wrong.
std::string Convert(
  vtkImageData* image, vtkDataArray* scalars, const char* what, ColorTexture& result)
{
  const std::string wrong = ConvertColors(image, scalars, what, result);
  if (!wrong.empty())
  {
    return wrong;
  }
  const std::string wrongFrame = ImageFrame().Assign(image);
  return wrongFrame.empty() ? wrongFrame : std::string("the ") + what + " image: " + wrongFrame;
}

// Places a texture where its image lies in the world. Where their planes differ, each sample is
// projected along the texture's normal.
void PlaceInWorld(vtkImageData* heights, vtkImageData* image, ColorTexture& result)
{
  double toTexture[9];
  vtkMatrix3x3::Invert(image->GetDirectionMatrix()->GetData(), toTexture);
  const int* extent = image->GetExtent();
  auto texels = [&](const double world[3])
  {
    double local[3];
    vtkMatrix3x3::MultiplyPoint(toTexture, world, local);
    return glm::dvec2(local[0] / image->GetSpacing()[0], local[1] / image->GetSpacing()[1]);
  };

  const double* direction = heights->GetDirectionMatrix()->GetData();
  const double* spacing = heights->GetSpacing();
  const double columnStep[3] = { direction[0] * spacing[0], direction[3] * spacing[0],
    direction[6] * spacing[0] };
  const double rowStep[3] = { direction[1] * spacing[1], direction[4] * spacing[1],
    direction[7] * spacing[1] };
  // The origins' difference first: on a map it is far smaller than they are.
  const int* first = heights->GetExtent();
  double offset[3];
  // A slice that is the first one needs no spacing across.
  const double across = first[4] == 0 ? 0.0 : spacing[2] * first[4];
  for (int axis = 0; axis < 3; ++axis)
  {
    offset[axis] =
      heights->GetOrigin()[axis] - image->GetOrigin()[axis] + direction[3 * axis + 2] * across;
  }
  result.alongI = texels(columnStep);
  result.alongJ = texels(rowStep);
  result.origin = texels(offset) + static_cast<double>(first[0]) * result.alongI +
    static_cast<double>(first[2]) * result.alongJ - glm::dvec2(extent[0], extent[2]);
}

// Places a texture so that it covers the whole of the heights from edge to edge.
void Stretch(const TextureInput& heights, const TextureInput& texture, ColorTexture& result)
{
  auto size = [](const int* whole)
  { return glm::ivec2(whole[1] - whole[0] + 1, whole[3] - whole[2] + 1); };
  auto first = [](const TextureInput& input)
  {
    const int* extent = input.GetFrame()->GetExtent();
    return glm::ivec2(extent[0] - input.whole[0], extent[2] - input.whole[2]);
  };
  result.Stretch(size(heights.whole), first(heights), size(texture.whole), first(texture));
}
}

//------------------------------------------------------------------------------
PlacedTextures::InputVersion::InputVersion(const TextureInput& input)
  : image(input.image)
  , imageTime(input.image ? input.image->GetMTime() : 0)
  , scalars(input.scalars)
  , scalarsTime(input.scalars ? input.scalars->GetMTime() : 0)
{
  this->frame = input.frame;
  std::copy_n(input.whole, 6, this->whole.begin());
  std::copy_n(input.shown, 6, this->shown.begin());
}

//------------------------------------------------------------------------------
bool PlacedTextures::InputVersion::operator==(const InputVersion& other) const
{
  auto parts = [](const InputVersion& v)
  { return std::tie(v.image, v.imageTime, v.scalars, v.scalarsTime, v.whole, v.frame, v.shown); };
  return parts(*this) == parts(other);
}

//------------------------------------------------------------------------------
bool PlacedTextures::Origin::operator==(const Origin& other) const
{
  auto parts = [](const Origin& o)
  { return std::tie(o.heights, o.textures, o.table, o.tableTime, o.stretch); };
  return parts(*this) == parts(other);
}

//------------------------------------------------------------------------------
std::string PlacedTextures::Place(const TextureInput& heights,
  const std::array<TextureInput, 3>& textures, vtkScalarsToColors* table, bool stretch,
  vtkObject* reporter)
{
  if (table)
  {
    table->Build(); // after which its time stays
  }
  const Origin origin{ InputVersion(heights),
    { InputVersion(textures[0]), InputVersion(textures[1]), InputVersion(textures[2]) }, table,
    table ? table->GetMTime() : 0, stretch };
  if (this->PlacedFrom == origin)
  {
    return std::string();
  }
  this->PlacedFrom = Origin();
  ++this->Version;
  this->Heights = heights;
  this->Table = table;
  for (std::size_t k = 0; k < textures.size(); ++k)
  {
    const TextureInput& input = textures[k];
    const Kind& kind = Kinds[k];
    this->Placed[k].clear();
    if (!input.image)
    {
      continue;
    }
    ColorTexture texture;
    const std::string wrong = Convert(input.image, input.scalars, kind.what, texture);
    if (!wrong.empty())
    {
      return wrong;
    }
    if (stretch)
    {
      Stretch(heights, input, texture);
    }
    else
    {
      PlaceInWorld(heights.GetFrame(), input.image, texture);
    }
    const int* size = heights.GetFrame()->GetDimensions();
    if (texture.Overlaps(-0.5, size[0] - 0.5, -0.5, size[1] - 0.5))
    {
      this->Placed[k].push_back(texture);
    }
    else if (std::equal(heights.whole, heights.whole + 6, heights.GetFrame()->GetExtent()) &&
      std::equal(input.whole, input.whole + 6, input.image->GetExtent()))
    {
      vtkWarningWithObjectMacro(reporter,
        "The " << kind.what << " lies nowhere on the heights: its bounds in x and y are "
               << Bounds(input.image) << ", theirs " << Bounds(heights.GetFrame())
               << ". The constant colour shows.");
    }
  }
  this->PlacedFrom = origin;
  return std::string();
}

//------------------------------------------------------------------------------
std::string PlacedTextures::AddTo(Scene& scene)
{
  // With nothing but highlights, no height is coloured.
  if (this->Table && scene.specularCoefficient < 1.0)
  {
    ColorTexture tint;
    const std::string wrong = this->MapHeights(tint);
    if (!wrong.empty())
    {
      return wrong;
    }
    scene.diffuseTextures.push_back(tint);
  }
  for (std::size_t k = 0; k < this->Placed.size(); ++k)
  {
    std::vector<ColorTexture>& textures = scene.*Kinds[k].textures;
    textures.insert(textures.end(), this->Placed[k].begin(), this->Placed[k].end());
  }
  return std::string();
}

//------------------------------------------------------------------------------
void PlacedTextures::WarnOfTexels(int effects, vtkObject* reporter)
{
  for (std::size_t k = 0; k < std::size(Kinds); ++k)
  {
    const Kind& kind = Kinds[k];
    const InputVersion& given = this->PlacedFrom.textures[k];
    const bool counted = this->Counted[k].scalars == given.scalars &&
      this->Counted[k].scalarsTime == given.scalarsTime;
    if (this->Placed[k].empty() || counted || !(effects & kind.effect))
    {
      continue;
    }
    this->Counted[k] = given;
    const ColorTexture& texture = this->Placed[k].front();
    std::atomic<vtkIdType> unusable{ 0 };
    vtkReliefFor(0, texture.rows, 0,
      [&](vtkIdType begin, vtkIdType end)
      {
        unusable += static_cast<vtkIdType>(
          texture.CountUnusable(static_cast<int>(begin), static_cast<int>(end)));
      });
    if (unusable > 0)
    {
      vtkWarningWithObjectMacro(reporter,
        "The " << kind.what << " has " << unusable << (unusable == 1 ? " texel" : " texels")
               << " with negative or non-finite components; these count as 0.");
    }
  }
}

//------------------------------------------------------------------------------
void PlacedTextures::Release()
{
  this->Colors = nullptr;
  this->PlacedFrom = Origin();
}

//------------------------------------------------------------------------------
// Colours heights that follow one another, on one thread, for tables promise no more. In portions,
// for which the table needs memory of its own.
void PlacedTextures::MapRun(char* values, vtkIdType count, vtkIdType place)
{
  vtkDataArray* scalars = this->Heights.scalars;
  const vtkIdType most = 1 << 20;
  for (vtkIdType begin = 0; begin < count; begin += most)
  {
    const vtkIdType some = std::min(most, count - begin);
    auto portion =
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(scalars->GetDataType()));
    portion->SetVoidArray(values + begin * scalars->GetDataTypeSize(), some, 1);
    auto colors = vtkSmartPointer<vtkUnsignedCharArray>::Take(
      this->Table->MapScalars(portion, VTK_COLOR_MODE_MAP_SCALARS, 0, VTK_RGBA));
    std::copy_n(colors->GetPointer(0), 4 * some, this->Colors->GetPointer(4 * (place + begin)));
  }
}

//------------------------------------------------------------------------------
// Colours the heights that are shown by the table, unless that has been done. Returns an empty
// text, or what is wrong.
std::string PlacedTextures::MapHeights(ColorTexture& tint)
{
  const int* given = this->Heights.image->GetExtent();
  const int* shown = this->Heights.frame ? this->Heights.shown : given;
  tint.columns = shown[1] - shown[0] + 1;
  tint.rows = shown[3] - shown[2] + 1;
  const vtkIdType samples = static_cast<vtkIdType>(tint.columns) * tint.rows;
  if (auto* tiled = TiledHeights::SafeDownCast(this->Heights.scalars))
  {
    tint.texels = tiled->UseTable(this->Table);
    return std::string();
  }
  const InputVersion from(this->Heights);
  if (!this->Colors || this->MadeFrom != from || this->MadeBy != this->Table->GetMTime())
  {
    try
    {
      this->Colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
      this->Colors->SetNumberOfComponents(4);
      this->Colors->SetNumberOfTuples(samples);
      const vtkIdType pitch = given[1] - given[0] + 1;
      const vtkIdType first = (shown[2] - given[2]) * pitch + shown[0] - given[0];
      vtkDataArray* scalars = this->Heights.scalars;
      const vtkIdType size = scalars->GetDataTypeSize();
      char* values = static_cast<char*>(scalars->GetVoidPointer(0)) + first * size;
      // Whole rows follow one another.
      const int runs = tint.columns == pitch ? 1 : tint.rows;
      const vtkIdType run = samples / runs;
      for (int k = 0; k < runs; ++k)
      {
        this->MapRun(values + k * pitch * size, run, k * run);
      }
    }
    catch (const std::bad_alloc&)
    {
      this->Release();
      return "there is not enough memory for the colours of the lookup table";
    }
    this->MadeFrom = from;
    this->MadeBy = this->Table->GetMTime();
  }
  const int* whole = this->Heights.GetFrame()->GetExtent();
  tint.texels = this->Colors->GetPointer(0);
  tint.origin = glm::dvec2(whole[0] - shown[0], whole[2] - shown[2]);
  return std::string();
}
}

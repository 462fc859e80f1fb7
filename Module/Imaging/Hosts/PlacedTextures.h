// SPDX-License-Identifier: BSD-3-Clause
#ifndef PlacedTextures_h
#define PlacedTextures_h

/// @file
/// Images and colour tables as the model's textures. Not installed.

#include "SceneShading.h"

#include "vtkReliefShadingModule.h" // For export macro
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkObject;
class vtkScalarsToColors;
class vtkUnsignedCharArray;

namespace relief::hosts
{
/// An image as it comes through a port.
struct TextureInput
{
  vtkImageData* image = nullptr; ///< null where the port has none
  vtkDataArray* scalars = nullptr;
  int whole[6] = { 0, 0, 0, 0, 0, 0 }; ///< the whole extent, of which a distributed image is a part
  /// Of heights that come in parts, the image as a whole, and what is shown of it.
  vtkImageData* frame = nullptr;
  int shown[6] = { 0, 0, 0, 0, 0, 0 };

  /// Where the image lies.
  vtkImageData* GetFrame() const { return this->frame ? this->frame : this->image; }
};

class VTKRELIEFSHADING_EXPORT PlacedTextures
{
public:
  /// Places the textures for the diffuse, base and specular colour on the heights, unless they lie
  /// there already, and remembers a colour table, which may be null. Warns in the name of the
  /// reporter of a texture that lies nowhere. Returns an empty text, or what is wrong.
  std::string Place(const TextureInput& heights, const std::array<TextureInput, 3>& textures,
    vtkScalarsToColors* table, bool stretch, vtkObject* reporter);

  /// Adds them to a scene, and the table's colours below the diffuse texture. They are read where
  /// they are: heights and textures must outlive the scene. Returns an empty text, or what is
  /// wrong.
  std::string AddTo(Scene& scene);

  /// Changes when something has been placed anew; 0 before that.
  std::uint64_t GetVersion() const { return this->Version; }

  /// Warns of texels that are negative or not finite, once for each array, where they show: effects
  /// are those of the scene.
  void WarnOfTexels(int effects, vtkObject* reporter);

  /// Frees the table's colours; places anew the next time.
  void Release();

private:
  // What an input was. Modification times are never given twice.
  struct InputVersion
  {
    const void* image = nullptr;
    vtkMTimeType imageTime = 0;
    const void* scalars = nullptr;
    vtkMTimeType scalarsTime = 0;
    std::array<int, 6> whole = {};
    const void* frame = nullptr;
    std::array<int, 6> shown = {};
    InputVersion() = default;
    explicit InputVersion(const TextureInput& input);
    bool operator==(const InputVersion& other) const;
    bool operator!=(const InputVersion& other) const { return !(*this == other); }
  };
  struct Origin
  {
    InputVersion heights;
    std::array<InputVersion, 3> textures;
    const void* table = nullptr;
    vtkMTimeType tableTime = 0;
    bool stretch = false;
    bool operator==(const Origin& other) const;
  };

  std::string MapHeights(ColorTexture& tint);
  void MapRun(char* values, vtkIdType count, vtkIdType place);

  std::uint64_t Version = 0;
  Origin PlacedFrom;                               // of no heights where nothing is placed
  std::array<std::vector<ColorTexture>, 3> Placed; // none or one of each kind
  // What the table colours.
  TextureInput Heights;
  vtkScalarsToColors* Table = nullptr;
  vtkSmartPointer<vtkUnsignedCharArray> Colors;
  InputVersion MadeFrom;
  vtkMTimeType MadeBy = 0; // the table's time
  // The inputs whose texels were counted.
  std::array<InputVersion, 3> Counted;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef PreparedScene_h
#define PreparedScene_h

/// @file
/// A scene as the model takes it, converted when something has changed and not before. Not
/// installed.

#include "Scene.h"
#include "vtkReliefShadingModule.h" // For export macro
#include "vtkType.h"                // For vtkMTimeType

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkLight;
class vtkLightCollection;
class vtkMatrix4x4;
class vtkReliefScene;

namespace relief::hosts
{
class HostInputs;

class VTKRELIEFSHADING_EXPORT PreparedScene
{
public:
  /// Converts the scene of inputs that have been updated, unless it is at hand already. Lights in
  /// world coordinates, which may be null, stand in for those of a scene that has neither lights
  /// nor an environment: all but headlights, for light along the line of sight leaves no shadow in
  /// view. `toWorld` takes the data to the world. Returns an empty text, or what is wrong.
  std::string Update(
    HostInputs& inputs, vtkLightCollection* worldLights = nullptr, vtkMatrix4x4* toWorld = nullptr);

  /// Textures are read where they are: until the next update of the inputs.
  const Scene& Get() const { return this->Converted; }

  /// Changes with the scene; 0 before there is one.
  std::uint64_t GetVersion() const { return this->Version; }

private:
  // What it was made from. Modification times are never given twice.
  struct StandIn
  {
    vtkLight* light;
    vtkMTimeType time;
    vtkMatrix4x4* transform;
    vtkMTimeType transformTime;
    bool operator==(const StandIn& other) const;
  };
  struct Origin
  {
    vtkReliefScene* scene = nullptr;
    vtkMTimeType time = 0;
    std::uint64_t field = 0;
    std::uint64_t textures = 0;
    std::vector<StandIn> standIns;
    std::array<double, 16> toWorld = {};
    bool operator==(const Origin& other) const;
  };
  static Origin FindOrigin(
    HostInputs& inputs, vtkLightCollection* worldLights, vtkMatrix4x4* toWorld);

  Scene Converted;
  std::uint64_t Version = 0;
  Origin MadeFrom;
};
}

#endif

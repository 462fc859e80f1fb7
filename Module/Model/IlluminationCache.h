// SPDX-License-Identifier: BSD-3-Clause
#ifndef IlluminationCache_h
#define IlluminationCache_h

#include "HeightField.h"
#include "RayThickness.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace relief
{

/// Illuminations kept from run to run: while only colours, intensities, coefficients or falloffs
/// change, no ray needs to be traced again, and when one light moves, only that light's.
///
/// Holds float numbers, so what is reused equals what would be computed, bit for bit: 4 bytes a
/// sample and light, 8 for the light whose thickness is kept too.
class IlluminationCache
{
public:
  /// Everything that a light's illumination depends on.
  struct Key
  {
    std::uint64_t field = 0; ///< HeightField::GetVersion()
    int i0 = 0;              ///< the part of the field
    int j0 = 0;
    int columns = 0;
    int rows = 0;
    glm::dvec3 vector = glm::dvec3(0.0); ///< of the light
    bool positional = false;
    f64::ReliefMedium medium = {};
    int steps = 0; ///< of FixedStep, 0 for Exact
    bool thickness = false;

    bool operator==(const Key& other) const;
  };

  struct Entry
  {
    Key key;
    std::vector<float> illumination;
    std::vector<float> thickness; ///< empty unless the key asks for it
  };

  ///@{
  /// The most memory that is kept, in bytes; 0 keeps nothing.
  void SetLimit(std::size_t bytes) { this->Limit = bytes; }
  std::size_t GetLimit() const { return this->Limit; }
  ///@}

  /// What an entry takes, in bytes.
  static std::size_t SizeOf(const Key& key)
  {
    return static_cast<std::size_t>(key.columns) * key.rows * (key.thickness ? 2 : 1) *
      sizeof(float);
  }

  /// What is kept for a key, or null.
  std::shared_ptr<const Entry> Find(const Key& key) const;

  /// Keeps the entries that the last run used, as far as the limit allows, and forgets all others.
  void Keep(std::vector<std::shared_ptr<const Entry>> used);

private:
  std::vector<std::shared_ptr<const Entry>> Entries;
  std::size_t Limit = 0;
};

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef IlluminationCache_h
#define IlluminationCache_h

#include "IlluminationKey.h"
#include "RawArray.h"

#include <cstddef>
#include <memory>
#include <unordered_map>
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
  /// A light's illumination of a part of the field.
  struct Key
  {
    IlluminationKey light;
    int i0 = 0; ///< the part of the field
    int j0 = 0;
    int columns = 0;
    int rows = 0;
    bool thickness = false;

    bool operator==(const Key& other) const;
  };

  struct Entry
  {
    Key key;
    RawArray<float> illumination;
    RawArray<float> thickness; ///< empty unless the key asks for it
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
  std::shared_ptr<Entry> Find(const Key& key) const;

  /// The room of an illumination of so many samples that nobody uses, to be written anew; its entry
  /// is kept no longer. Nothing where there is none. To be asked for once all that is used is
  /// found.
  RawArray<float> TakeUnused(std::size_t samples);

  /// Keeps the entries that the last run used, as far as the limit allows, and forgets all others.
  void Keep(std::vector<std::shared_ptr<Entry>> used);

private:
  // A run asks for one part of the field, so the light tells entries apart.
  struct Hash
  {
    std::size_t operator()(const Key& key) const { return IlluminationHash()(key.light); }
  };
  std::unordered_map<Key, std::shared_ptr<Entry>, Hash> Entries;
  std::size_t Limit = 0;
};

}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef PackedLanes_h
#define PackedLanes_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace relief
{

/// Which of eight lanes are set in a mask, in their order, for each of the masks; 0 behind the
/// last.
struct PackedLanes
{
  std::array<std::array<std::uint8_t, 8>, 256> lanes{};

  constexpr PackedLanes()
  {
    for (std::size_t mask = 0; mask < this->lanes.size(); ++mask)
    {
      std::size_t next = 0;
      for (std::uint8_t lane = 0; lane < 8; ++lane)
      {
        if (mask >> lane & 1u)
        {
          this->lanes[mask][next++] = lane;
        }
      }
    }
  }
};

inline constexpr PackedLanes Packed;

}

#endif

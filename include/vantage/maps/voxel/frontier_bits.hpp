// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>

#include <vantage/geometry/voxel_bits.hpp>

namespace vantage {

/// The voxels of a block that have a set one among their 6 neighbours. bits(dx, dy, dz): those of the block so many
/// further.
template <class Bits>
VoxelBits beside(Bits&& bits) {
  constexpr std::uint64_t first_x = 0x0101010101010101u, last_x = first_x << 7;  // of every row
  const VoxelBits here = bits(0, 0, 0), left = bits(-1, 0, 0), right = bits(1, 0, 0), front = bits(0, -1, 0),
                  back = bits(0, 1, 0), below = bits(0, 0, -1), above = bits(0, 0, 1);
  VoxelBits found;
  for (std::size_t z = 0; z < 8; ++z) {
    const std::uint64_t s = here.slice[z];
    found.slice[z] = (s >> 1 & ~last_x) | (right.slice[z] & first_x) << 7            // x + 1
                     | (s << 1 & ~first_x) | (left.slice[z] & last_x) >> 7           // x - 1
                     | s >> 8 | back.slice[z] << 56 | s << 8 | front.slice[z] >> 56  // y +- 1
                     | (z < 7 ? here.slice[z + 1] : above.slice[0]) | (z > 0 ? here.slice[z - 1] : below.slice[7]);
  }
  return found;
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include <vantage/geometry/voxel_bits.hpp>

// The 512 log-odds of a block, in loops that become vectors: 16 voxels are two rows of bits.
namespace vantage {

using BlockLogOdds = std::span<float, 512>;

inline double log_odds_of(double probability) { return std::log(probability / (1 - probability)); }
inline double probability_of(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

/// l = clamp(l + weight(i) (hit_gain if hit, -pass_loss if only passed)); other voxels stay as they are.
template <class Weight>
void add_log_odds(const VoxelBits& hit, const VoxelBits& pass, float hit_gain, float pass_loss, float least, float most,
                  BlockLogOdds log_odds, Weight&& weight) {
  for (std::size_t z = 0; z < 8; ++z)
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      const auto hits = static_cast<std::uint32_t>(hit.slice[z] >> 16 * quarter & 0xFFFF),
                 passes = static_cast<std::uint32_t>(pass.slice[z] >> 16 * quarter & 0xFFFF);
      if ((hits | passes) == 0) continue;
      const std::size_t first = 64 * z + 16 * quarter;
      float* l = log_odds.data() + first;
      for (std::uint32_t i = 0; i < 16; ++i) {
        const bool hit_i = hits >> i & 1, pass_i = passes >> i & 1;
        const float gain = hit_i ? hit_gain : pass_i ? -pass_loss : 0.0F;
        const float sum = l[i] + weight(first + i) * gain;
        const float above = sum > least ? sum : least;
        const float clamped = above < most ? above : most;
        l[i] = (hit_i | pass_i) ? clamped : l[i];
      }
    }
}

/// The voxels for which test(log-odds) holds.
template <class Test>
VoxelBits where_log_odds(std::span<const float, 512> log_odds, Test&& test) {
  VoxelBits bits;
  for (std::size_t z = 0; z < 8; ++z)
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      const float* l = log_odds.data() + 64 * z + 16 * quarter;
      std::uint32_t word = 0;
      for (std::uint32_t i = 0; i < 16; ++i) word |= static_cast<std::uint32_t>(test(l[i])) << i;
      bits.slice[z] |= std::uint64_t{word} << 16 * quarter;
    }
  return bits;
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace vantage {

/// One random point a voxel: of those in the same voxel the one with the least of their random numbers stays.
class OnePerVoxel {
 public:
  /// For at most n points, and voxels of that edge [m].
  OnePerVoxel(std::size_t n, double edge_m) : edge_m_(edge_m), slots_(std::bit_ceil(2 * n + 1)) {}

  /// Points within 2^20 voxels of the origin; `number` is below 2^32 - 1.
  void add(const Eigen::Vector3d& point, std::uint32_t number, std::uint64_t random) {
    const Eigen::Array3d at = (point.array() / edge_m_).floor();
    std::uint64_t key = 0;
    for (int a = 0; a < 3; ++a)
      key = key << 21 | (static_cast<std::uint64_t>(static_cast<std::int64_t>(at[a]) + (1 << 20)) & 0x1FFFFF);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t s = hash(key) & mask;; s = (s + 1) & mask) {
      Slot& slot = slots_[s];
      if (slot.number != none && slot.key != key) continue;
      // Ties go to the lower number, so that the order of points does not count.
      if (slot.number == none || random < slot.random || (random == slot.random && number < slot.number))
        slot = {key, random, number};
      return;
    }
  }
  /// Marks those that stay, by number.
  void mark(std::vector<std::uint8_t>& stays) const {
    for (const Slot& s : slots_)
      if (s.number != none) stays[s.number] = 1;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  struct Slot {
    std::uint64_t key = 0, random = 0;
    std::uint32_t number = none;
  };
  static std::size_t hash(std::uint64_t key) {
    key *= 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(key ^ key >> 29);
  }
  double edge_m_;
  std::vector<Slot> slots_;
};

}  // namespace vantage

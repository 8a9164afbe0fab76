// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <vantage/geometry/voxel_grid.hpp>

// Voxels in blocks of 8 x 8 x 8: one bit a voxel makes a block one cache line, and 512 voxels one instruction's work.
// The block of voxel (i, j, k) is (i, j, k) / 8.
namespace vantage {

inline constexpr int block_edge = 8;

/// Yes or no for each voxel of a block: bit x + 8 y of slice z.
struct alignas(64) VoxelBits {
  std::array<std::uint64_t, 8> slice{};

  static constexpr VoxelBits all() { return filled(~std::uint64_t{0}); }
  /// Those of the block's voxels that lie inside of a grid.
  static VoxelBits inside(const VoxelGrid& grid, const Eigen::Vector3i& block) {
    const Eigen::Array3i n = (grid.size() - block_edge * block).array();
    VoxelBits bits;
    if ((n <= 0).any()) return bits;
    const std::uint64_t row = n.x() >= 8 ? 0xFF : (std::uint64_t{1} << n.x()) - 1;
    const std::uint64_t rows = 0x0101010101010101u * row;
    for (std::size_t z = 0; z < 8 && static_cast<int>(z) < n.z(); ++z)
      bits.slice[z] = n.y() >= 8 ? rows : rows & ((std::uint64_t{1} << 8 * n.y()) - 1);
    return bits;
  }
  /// Those from one voxel of a block to another, both included; both may lie outside of the block.
  static VoxelBits between(const Eigen::Vector3i& low, const Eigen::Vector3i& high) {
    const Eigen::Array3i a = low.array().max(0), b = high.array().min(block_edge - 1);
    VoxelBits bits;
    if ((a > b).any()) return bits;
    const auto run = [](int first, int last) { return (std::uint64_t{2} << last) - (std::uint64_t{1} << first); };
    const std::uint64_t row = run(a.x(), b.x());
    std::uint64_t rows = 0;
    for (int y = a.y(); y <= b.y(); ++y) rows |= row << 8 * y;
    for (int z = a.z(); z <= b.z(); ++z) bits.slice[static_cast<std::size_t>(z)] = rows;
    return bits;
  }

  /// `local`: the voxel within its block, each of 0 to 7.
  [[nodiscard]] constexpr bool operator[](std::size_t local) const { return (slice[local >> 6] >> (local & 63)) & 1; }
  constexpr void set(std::size_t local) { slice[local >> 6] |= std::uint64_t{1} << (local & 63); }
  constexpr void reset(std::size_t local) { slice[local >> 6] &= ~(std::uint64_t{1} << (local & 63)); }
  [[nodiscard]] constexpr bool any() const {
    std::uint64_t some = 0;
    for (const std::uint64_t s : slice) some |= s;
    return some != 0;
  }
  [[nodiscard]] constexpr int count() const {
    int n = 0;
    for (const std::uint64_t s : slice) n += std::popcount(s);
    return n;
  }
  /// f(local) for each voxel that is set, in the order x, y, z.
  template <class F>
  constexpr void for_each(F&& f) const {
    for (std::size_t z = 0; z < 8; ++z)
      for (std::uint64_t s = slice[z]; s != 0; s &= s - 1) f(64 * z + static_cast<std::size_t>(std::countr_zero(s)));
  }

  /// Whether f(local) holds for any voxel that is set; it is asked of no more after that.
  template <class F>
  [[nodiscard]] constexpr bool any_of(F&& f) const {
    for (std::size_t z = 0; z < 8; ++z)
      for (std::uint64_t s = slice[z]; s != 0; s &= s - 1)
        if (f(64 * z + static_cast<std::size_t>(std::countr_zero(s)))) return true;
    return false;
  }

  constexpr VoxelBits& operator&=(const VoxelBits& other) {
    for (std::size_t z = 0; z < 8; ++z) slice[z] &= other.slice[z];
    return *this;
  }
  constexpr VoxelBits& operator|=(const VoxelBits& other) {
    for (std::size_t z = 0; z < 8; ++z) slice[z] |= other.slice[z];
    return *this;
  }
  [[nodiscard]] constexpr VoxelBits operator~() const {
    VoxelBits bits;
    for (std::size_t z = 0; z < 8; ++z) bits.slice[z] = ~slice[z];
    return bits;
  }
  [[nodiscard]] friend constexpr VoxelBits operator&(const VoxelBits& a, const VoxelBits& b) {
    VoxelBits bits = a;
    return bits &= b;
  }
  [[nodiscard]] friend constexpr VoxelBits operator|(const VoxelBits& a, const VoxelBits& b) {
    VoxelBits bits = a;
    return bits |= b;
  }
  [[nodiscard]] constexpr bool operator==(const VoxelBits& other) const {  // without the call that std::array's makes
    std::uint64_t differ = 0;
    for (std::size_t z = 0; z < 8; ++z) differ |= slice[z] ^ other.slice[z];
    return differ == 0;
  }

 private:
  static constexpr VoxelBits filled(std::uint64_t word) {
    VoxelBits bits;
    bits.slice.fill(word);
    return bits;
  }
};

/// The block of a voxel (of a grid: none of its indices is negative).
inline Eigen::Vector3i block_of(const Eigen::Vector3i& voxel) {
  return {voxel.x() >> 3, voxel.y() >> 3, voxel.z() >> 3};
}
/// Where in its block a voxel is: x + 8 y + 64 z.
inline std::size_t local_of(const Eigen::Vector3i& voxel) {
  return static_cast<std::size_t>((voxel.x() & 7) | (voxel.y() & 7) << 3 | (voxel.z() & 7) << 6);
}
/// The voxel at `local` of a block.
inline Eigen::Vector3i voxel_of(const Eigen::Vector3i& block, std::size_t local) {
  const auto l = static_cast<int>(local);
  return block_edge * block + Eigen::Vector3i(l & 7, l >> 3 & 7, l >> 6);
}

}  // namespace vantage

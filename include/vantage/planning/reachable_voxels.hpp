// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/planning/passable.hpp>

namespace vantage {

/// The passable voxels to which a way leads from a start, over any of the 26 neighbours; none if the start is not
/// passable. What VoxelSearch reaches without asking how far it is, and so 512 voxels at a time: a block's bits grow
/// into their neighbours by shifts until nothing changes, and what they reach of the 26 blocks around waits its turn.
/// Memory and time in proportion to the blocks reached. Const members run concurrently.
class ReachableVoxels {
 public:
  template <PassableVoxels P>
  ReachableVoxels(const P& passable, const Eigen::Vector3i& start) : grid_(passable.grid()) {
    if (!passable(start)) return;
    Block& first = enter(passable, block_of(start));
    first.reached.set(local_of(start));
    std::vector<Block*> waiting = {&first};
    for (std::size_t i = 0; i < waiting.size(); ++i) {  // breadth first
      Block& block = *waiting[i];
      block.waits = false;
      for (VoxelBits before; !(before == block.reached);) {
        before = block.reached;
        block.reached = grown(before) & block.passable;
      }
      spill(passable, block, waiting);
    }
  }

  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  /// Any voxel: false outside of the grid.
  [[nodiscard]] bool operator()(const Eigen::Vector3i& voxel) const {
    return grid_.contains(voxel) && in(block_of(voxel))[local_of(voxel)];
  }
  [[nodiscard]] const VoxelBits& in(const Eigen::Vector3i& block) const {
    static constexpr VoxelBits none{};
    const auto found = blocks_.find(key(block));
    return found == blocks_.end() ? none : found->second.reached;
  }

 private:
  struct Block {
    Eigen::Vector3i at;
    VoxelBits passable{}, reached{};
    bool waits = false;
  };
  static std::uint64_t key(const Eigen::Vector3i& block) {
    const Eigen::Matrix<std::uint64_t, 3, 1> b = block.cast<std::uint64_t>();
    return b.x() | b.y() << 16 | b.z() << 32;
  }
  template <PassableVoxels P>
  Block& enter(const P& passable, const Eigen::Vector3i& at) {
    const auto [found, fresh] = blocks_.try_emplace(key(at));
    if (fresh) found->second.at = at, found->second.passable = passable.in(at);
    return found->second;
  }

  static constexpr std::uint64_t left = 0x0101010101010101u, right = left << 7;  // x = 0 and x = 7 of each row
  /// A slice and its neighbours in x and y.
  static constexpr std::uint64_t grown(std::uint64_t s) {
    s |= (s & ~right) << 1 | (s & ~left) >> 1;
    return s | s << 8 | s >> 8;
  }
  /// Bits and their 26 neighbours, as far as they lie in the block.
  static VoxelBits grown(const VoxelBits& bits) {
    std::array<std::uint64_t, 10> flat{};
    for (std::size_t z = 0; z < 8; ++z) flat[z + 1] = grown(bits.slice[z]);
    VoxelBits all;
    for (std::size_t z = 0; z < 8; ++z) all.slice[z] = flat[z] | flat[z + 1] | flat[z + 2];
    return all;
  }
  /// The face, edge or corner of a block that a neighbouring block in this direction touches, as that block's bits.
  static VoxelBits facing(const VoxelBits& bits, int x, int y, int z) {
    VoxelBits other;
    for (int k = 0; k < 8; ++k) {
      const int from = z == 0 ? k : (z > 0 ? 7 : 0), to = z == 0 ? k : 7 - from;
      std::uint64_t s = bits.slice[static_cast<std::size_t>(from)];
      if (x > 0) s = (s & right) >> 7;
      if (x < 0) s = (s & left) << 7;
      if (y > 0) s >>= 56;
      if (y < 0) s <<= 56;
      other.slice[static_cast<std::size_t>(to)] = s;
    }
    return other;
  }
  template <PassableVoxels P>
  void spill(const P& passable, const Block& block, std::vector<Block*>& waiting) {
    const Eigen::Array3i blocks = (grid_.size().array() + (block_edge - 1)) / block_edge;
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const Eigen::Vector3i at = block.at + Eigen::Vector3i(x, y, z);
          if ((x == 0 && y == 0 && z == 0) || (at.array() < 0).any() || (at.array() >= blocks).any()) continue;
          const VoxelBits touching = facing(block.reached, x, y, z);
          if (!touching.any()) continue;
          Block& next = enter(passable, at);
          // The touched layer, grown within its plane: a voxel's neighbours beyond a border lie around its own shadow.
          const VoxelBits reached =
              next.reached | (grown(touching) & facing(VoxelBits::all(), x, y, z) & next.passable);
          if (reached == next.reached) continue;
          next.reached = reached;
          if (!next.waits) next.waits = true, waiting.push_back(&next);
        }
  }

  VoxelGrid grid_;
  std::unordered_map<std::uint64_t, Block> blocks_;
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/map.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/maps/voxel/clearance.hpp>
#include <vantage/maps/voxel/frontier_bits.hpp>
#include <vantage/maps/voxel/log_odds.hpp>
#include <vantage/maps/voxel/voxel_blocks.hpp>

namespace vantage {

/// What a voxel map knows, whatever taught it: which voxels are explored, free and occupied; and what follows from
/// that: frontier (free, and one of the 6 neighbours is a voxel of the grid that is unexplored) and navigable voxels,
/// kept up exactly, by bits, in the blocks around those that changed. Block: a VoxelBlock. Const members may run
/// concurrently.
template <class Block, class Clearance>
class KnownVoxels {
 public:
  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  [[nodiscard]] Box3 bounds() const { return grid_.box(); }
  /// Of the index and all blocks; what a frame needs, kept for the next, is not counted.
  [[nodiscard]] std::size_t bytes() const { return blocks_.bytes(); }

  /// Unknown outside of the grid.
  [[nodiscard]] Space at(const Eigen::Vector3d& p) const {
    if (!grid_.box().contains(p)) return Space::unknown;
    const Eigen::Vector3i voxel = grid_.voxel_at(p);
    return grid_.contains(voxel) ? state(voxel) : Space::unknown;
  }
  /// Of any voxel: unknown outside of the grid, before it is explored, and while that was too little to tell.
  [[nodiscard]] Space state(const Eigen::Vector3i& voxel) const {
    const Block* b = blocks_.find(block_of(voxel));
    if (!b) return Space::unknown;
    const std::size_t local = local_of(voxel);
    return b->free[local] ? Space::free : b->occupied[local] ? Space::occupied : Space::unknown;
  }
  /// Whether a measurement hit or passed it; of any voxel, false outside of the grid.
  [[nodiscard]] bool explored(const Eigen::Vector3i& voxel) const {
    const Block* b = blocks_.find(block_of(voxel));
    return b && b->explored[local_of(voxel)];
  }
  /// ln(p / (1 - p)), p its probability of being occupied; of any voxel, 0 outside of the grid and until it is
  /// explored.
  [[nodiscard]] float log_odds(const Eigen::Vector3i& voxel) const {
    const Block* b = blocks_.find(block_of(voxel));
    return b ? b->log_odds[local_of(voxel)] : 0;
  }
  /// That it is occupied; of any voxel, 0.5 outside of the grid and until it is explored.
  [[nodiscard]] double probability(const Eigen::Vector3i& voxel) const { return probability_of(log_odds(voxel)); }

  // Of whole blocks.
  [[nodiscard]] std::span<const Eigen::Vector3i> known_blocks() const { return blocks_.known(); }
  [[nodiscard]] VoxelBits free_in(const Eigen::Vector3i& block) const { return bits(block, &VoxelBlock::free); }
  [[nodiscard]] VoxelBits occupied_in(const Eigen::Vector3i& block) const { return bits(block, &VoxelBlock::occupied); }
  [[nodiscard]] VoxelBits frontier_in(const Eigen::Vector3i& block) const { return bits(block, &VoxelBlock::frontier); }
  [[nodiscard]] VoxelBits navigable_in(const Eigen::Vector3i& block) const {
    return bits(block, &VoxelBlock::navigable);
  }
  [[nodiscard]] VoxelBits unexplored_in(const Eigen::Vector3i& block) const {
    if (!blocks_.contains(block)) return {};
    const VoxelBits inside = VoxelBits::inside(grid_, block);
    const Block* b = blocks_.find(block);
    return b ? inside & ~b->explored : inside;
  }
  /// All that is known of a block (any block), or none; good until the map changes.
  [[nodiscard]] const Block* block(const Eigen::Vector3i& block) const { return blocks_.find(block); }

  [[nodiscard]] double clearance_m() const { return clearance_m_; }
  [[nodiscard]] bool navigable(const Eigen::Vector3i& voxel) const {
    if (!grid_.contains(voxel)) return false;
    const Block* b = blocks_.find(block_of(voxel));
    return b && b->navigable[local_of(voxel)];
  }

  struct Counts {
    std::uint64_t explored = 0, free = 0, occupied = 0, frontier = 0, navigable = 0;
  };
  /// Voxels of each kind. O(blocks).
  [[nodiscard]] Counts counts() const {
    Counts n;
    for (std::size_t s = 0; s < blocks_.count(); ++s) {
      const Block& b = blocks_[s];
      const auto add = [](std::uint64_t& to, const VoxelBits& bits) { to += static_cast<std::uint64_t>(bits.count()); };
      add(n.explored, b.explored), add(n.free, b.free), add(n.occupied, b.occupied), add(n.frontier, b.frontier),
          add(n.navigable, b.navigable);
    }
    return n;
  }
  /// Share of the grid's voxels that are explored. O(blocks).
  [[nodiscard]] double coverage() const {
    return static_cast<double>(counts().explored) / static_cast<double>(grid_.count());
  }

  /// Every frontier voxel, by its centre; the normal is the normalised mean of the unit vectors to those of its 26
  /// neighbours that are free (to the side from which it can be seen). Where these cancel out it points away from the
  /// unexplored 6-neighbours, and where these do as well, up. In the order of known_blocks.
  [[nodiscard]] std::vector<Region> regions(frontier) const;

 protected:
  /// Throws Error if the grid alone needs more memory than max_bytes.
  KnownVoxels(const VoxelGrid& grid, double clearance_m, std::size_t max_bytes)
      : grid_(grid),
        blocks_(grid_, max_bytes),
        clearance_m_(clearance_m),
        dilation_(Clearance{}, grid_.voxel_m(), clearance_m) {}

  // Frontier and navigable voxels of the blocks around those of the slots that changed.
  void derive(std::span<const std::size_t> slots, std::span<const std::uint8_t> changed);
  // Of all blocks.
  void derive() {
    for (std::size_t s = 0; s < blocks_.count(); ++s) refresh(blocks_.known()[s], blocks_[s]);
  }

  VoxelGrid grid_;
  VoxelBlocks<Block> blocks_;

 private:
  [[nodiscard]] VoxelBits bits(const Eigen::Vector3i& block, VoxelBits VoxelBlock::*kind) const {
    const Block* b = blocks_.find(block);
    return b ? b->*kind : VoxelBits{};
  }
  void refresh(const Eigen::Vector3i& at, Block& block) const;

  double clearance_m_;
  Dilation dilation_;
  // Kept from frame to frame for their memory.
  std::vector<std::size_t> stale_;
  std::vector<std::uint8_t> is_stale_;  // by slot
};

template <class Block, class Clearance>
void KnownVoxels<Block, Clearance>::derive(std::span<const std::size_t> slots, std::span<const std::uint8_t> changed) {
  stale_.clear();
  is_stale_.assign(blocks_.count(), 0);
  const int reach = std::max(1, dilation_.blocks());
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (!changed[k]) continue;
    for (int z = -reach; z <= reach; ++z)
      for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
          const std::int32_t s = blocks_.slot(blocks_.known()[slots[k]] + Eigen::Vector3i(x, y, z));
          if (s < 0 || std::exchange(is_stale_[static_cast<std::size_t>(s)], std::uint8_t{1})) continue;
          stale_.push_back(static_cast<std::size_t>(s));
        }
  }
  parallel_for_blocks(stale_.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) refresh(blocks_.known()[stale_[i]], blocks_[stale_[i]]);
  });
}

template <class Block, class Clearance>
void KnownVoxels<Block, Clearance>::refresh(const Eigen::Vector3i& at, Block& block) const {
  block.frontier = {};
  block.navigable = {};
  if (!block.free.any()) return;
  block.frontier =
      block.free & beside([&](int x, int y, int z) { return unexplored_in(at + Eigen::Vector3i(x, y, z)); });
  block.navigable =
      block.free & ~dilation_([&](int x, int y, int z) {
        const Block* b = blocks_.find(at + Eigen::Vector3i(x, y, z));
        return b ? Clearance::in_the_way(b->free, b->occupied) : Clearance::beyond ? VoxelBits::all() : VoxelBits{};
      });
}

template <class Block, class Clearance>
std::vector<Region> KnownVoxels<Block, Clearance>::regions(frontier) const {
  std::vector<Region> found;
  const auto is_free = [&](const Eigen::Vector3i& v) { return grid_.contains(v) && state(v) == Space::free; };
  const auto is_unexplored = [&](const Eigen::Vector3i& v) { return grid_.contains(v) && !explored(v); };
  for (std::size_t s = 0; s < blocks_.count(); ++s)
    blocks_[s].frontier.for_each([&](std::size_t local) {
      const Eigen::Vector3i voxel = voxel_of(blocks_.known()[s], local);
      Eigen::Vector3d free = Eigen::Vector3d::Zero(), away = Eigen::Vector3d::Zero();
      for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
          for (int x = -1; x <= 1; ++x) {
            const Eigen::Vector3i step(x, y, z);
            if (step.isZero()) continue;
            const Eigen::Vector3d unit = grid_.voxel_m().cwiseProduct(step.cast<double>()).normalized();
            if (is_free(voxel + step)) free += unit;
            if (step.squaredNorm() == 1 && is_unexplored(voxel + step)) away -= unit;
          }
      const Eigen::Vector3d normal = free.norm() > 1e-9   ? free.normalized()
                                     : away.norm() > 1e-9 ? away.normalized()
                                                          : Eigen::Vector3d::UnitZ().eval();
      found.push_back({grid_.centre(voxel), normal});
    });
  return found;
}

}  // namespace vantage

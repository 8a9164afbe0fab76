// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/map.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/visible_voxels.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/utility/once_per_view.hpp>

namespace vantage {

/// The unexplored voxels of a map, by blocks: those that a VoxelOccupancy says; of any other OccupancyMap those voxels
/// of a grid dividing its bounds whose centre is unknown, asked for once. Refers to the map.
template <OccupancyMap M>
class UnexploredVoxels {
 public:
  /// `voxel_m`: edge [m] of the grid's voxels, for maps that have none of their own. Throws Error as
  /// VoxelGrid::dividing does. O(1) for a VoxelOccupancy, else O(voxels), with one bit each.
  UnexploredVoxels(const M& map, double voxel_m) : map_(&map), grid_(grid_of(map, voxel_m)) {
    if constexpr (!VoxelOccupancy<M>) {
      blocks_ = (grid_.size().array() + (block_edge - 1)) / block_edge;
      unknown_.resize(static_cast<std::size_t>(blocks_.x()) * static_cast<std::size_t>(blocks_.y()) *
                      static_cast<std::size_t>(blocks_.z()));
      parallel_for(static_cast<std::size_t>(blocks_.z()), [&](std::size_t z) {
        for (int y = 0; y < blocks_.y(); ++y)
          for (int x = 0; x < blocks_.x(); ++x) {
            const Eigen::Vector3i block(x, y, static_cast<int>(z));
            VoxelBits& bits = unknown_[slot(block)];
            VoxelBits::inside(grid_, block).for_each([&](std::size_t local) {
              if (map.at(grid_.centre(voxel_of(block, local))) == Space::unknown) bits.set(local);
            });
          }
      });
    }
  }
  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  /// Of a block of the grid.
  [[nodiscard]] VoxelBits in(const Eigen::Vector3i& block) const {
    if constexpr (VoxelOccupancy<M>)
      return map_->unexplored_in(block);
    else
      return unknown_[slot(block)];
  }

 private:
  static VoxelGrid grid_of(const M& map, double voxel_m) {
    if constexpr (VoxelOccupancy<M>)
      return map.grid();
    else
      return VoxelGrid::dividing(map.bounds(), voxel_m);
  }
  [[nodiscard]] std::size_t slot(const Eigen::Vector3i& b) const {
    return (static_cast<std::size_t>(b.z()) * static_cast<std::size_t>(blocks_.y()) + static_cast<std::size_t>(b.y())) *
               static_cast<std::size_t>(blocks_.x()) +
           static_cast<std::size_t>(b.x());
  }
  const M* map_;
  VoxelGrid grid_;
  Eigen::Vector3i blocks_ = Eigen::Vector3i::Zero();
  std::vector<VoxelBits> unknown_;
};

using ViewsSeen = OncePerView<VisibleVoxels>;

/// How many unexplored voxels are visible that were not visible before.
template <class M>
std::uint64_t count_unexplored(const UnexploredVoxels<M>& voxels, const VisibleVoxels& visible,
                               const std::vector<ViewsSeen::Pointer>& before) {
  std::uint64_t count = 0;
  visible.for_each_block([&](const Eigen::Vector3i& block) {
    VoxelBits bits = visible(block, voxels.in(block));
    for (const auto& b : before) bits &= ~(*b)(block, bits);
    count += static_cast<std::uint64_t>(bits.count());
  });
  return count;
}

}  // namespace vantage

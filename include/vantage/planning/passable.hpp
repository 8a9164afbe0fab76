// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <optional>

#include <Eigen/Core>

#include <vantage/concepts/map.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage {

/// Which voxels a search may pass, block by block: bits beyond the grid are 0.
template <class P>
concept PassableVoxels = requires(const P p, const Eigen::Vector3i& voxel, const Eigen::Vector3i& block) {
  { p.grid() } -> std::convertible_to<const VoxelGrid&>;
  { p(voxel) } -> std::same_as<bool>;  // any voxel: false outside of the grid
  { p.in(block) } -> std::convertible_to<VoxelBits>;
};

/// The voxels through which a robot can leave the place where it is: navigable ones, and its own ball, which is every
/// voxel whose centre is within `own_ball_m` (unless told, the map's clearance: the robot's own size) of the start
/// voxel's centre. The robot is there, so the ball is open even if the map does not know it yet; only what the map
/// holds occupied stays closed, except for the start itself. Refers to the map.
template <NavigableMap M>
class Passable {
 public:
  Passable(const M& map, const Eigen::Vector3i& start, const std::optional<double>& own_ball_m = {})
      : map_(&map), start_(start), own_ball_m_(own_ball_m.value_or(map.clearance_m()) + 1e-9) {
    const Eigen::Array3d voxels = own_ball_m_ / grid().voxel_m().array();
    const Eigen::Array3i reach = voxels.min(VoxelGrid::most_voxels).cast<int>();
    low_ = (start.array() - reach).max(0), high_ = (start.array() + reach).min(grid().size().array() - 1);
  }

  [[nodiscard]] const VoxelGrid& grid() const { return map_->grid(); }
  [[nodiscard]] bool operator()(const Eigen::Vector3i& voxel) const {
    return map_->navigable(voxel) || (grid().contains(voxel) && of_robot(voxel));
  }
  [[nodiscard]] VoxelBits in(const Eigen::Vector3i& block) const {
    VoxelBits bits = map_->navigable_in(block);
    const Eigen::Array3i low = low_.max(block_edge * block.array()),
                         high = high_.min(block_edge * block.array() + (block_edge - 1));
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int x = low.x(); x <= high.x(); ++x)
          if (of_robot({x, y, z})) bits.set(local_of({x, y, z}));
    return bits;
  }

 private:
  [[nodiscard]] bool of_robot(const Eigen::Vector3i& voxel) const {
    if (voxel == start_) return true;
    return (voxel - start_).template cast<double>().cwiseProduct(grid().voxel_m()).norm() <= own_ball_m_ &&
           map_->state(voxel) != Space::occupied;
  }
  const M* map_;
  Eigen::Vector3i start_;
  double own_ball_m_;
  Eigen::Array3i low_, high_;  // of the ball, in the grid
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>

#include <vantage/concepts/map.hpp>
#include <vantage/core/error.hpp>
#include <vantage/planning/poses.hpp>
#include <vantage/planning/robot_shape.hpp>
#include <vantage/planning/voxel_collision.hpp>

namespace vantage {

struct BoxInVoxelsConfig {
  /// A way on which the box keeps sqrt(3) times this from every obstacle is free for certain; one that comes closer may
  /// be called in collision [m].
  double tolerance_m = 0.01;
};

/// A robot that is a box among the voxels of a map: CollisionFree, for RrtStar. A pose is free if the box meets no
/// obstacle there (collides); a way, if it meets none all along (collides_on_way). Free is proven, not sampled, and to
/// touch is to collide. By default all is an obstacle that is not known to be free, and all beyond the grid; with
/// obstacle::Occupied{}, what is known to be occupied.
///
///     const BoxInVoxels body(map, shape::Box{{0.5, 0.1, 0.1}});
///     const auto path = RrtStar<>({.space = {.bounds = map.bounds()}}).plan(start, goal, body, rng);
///
/// Refers to the map. A pose that is no rigid transform is in collision. Cost: as of those functions. Const members run
/// concurrently.
template <VoxelOccupancy M, class Obstacles = obstacle::NotFree>
class BoxInVoxels {
 public:
  using Config = BoxInVoxelsConfig;

  /// Throws Error for half extents that are not finite and >= 0, and for a tolerance that is not finite and > 0.
  BoxInVoxels(const M& map, const shape::Box& box, const Config& config = {}, Obstacles obstacles = {})
      : map_(&map), half_extents_m_(box.half_extents_m), tolerance_m_(config.tolerance_m), obstacles_(obstacles) {
    Check check("BoxInVoxels");
    check(half_extents_m_.allFinite() && (half_extents_m_.array() >= 0).all(), "half_extents_m",
          concat("(", half_extents_m_.transpose(), ")"), "finite, each >= 0");
    check.positive("tolerance_m", tolerance_m_);
    check.done();
  }

  /// T_W_B: the box's centre and axes in the world.
  [[nodiscard]] bool is_free(const Eigen::Isometry3d& T_W_B) const { return !collides(*map_, at(T_W_B), obstacles_); }
  [[nodiscard]] bool is_free(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const {
    return !collides_on_way(*map_, at(from), to, tolerance_m_, obstacles_);
  }

 private:
  [[nodiscard]] OrientedBox at(const Eigen::Isometry3d& T_W_B) const { return {T_W_B, half_extents_m_}; }
  const M* map_;
  Eigen::Vector3d half_extents_m_;
  double tolerance_m_;
  Obstacles obstacles_;
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vantage/concepts/map.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/planning/rigid_motion.hpp>

// Bodies against the voxels of a map, exact to rounding: no samples on the body, no voxels rounded up. Both are closed:
// to touch is to collide.
namespace vantage {

/// Which space a body must not meet.
namespace obstacle {

/// What is not known to be free, and all that is beyond of the grid.
struct NotFree {
  static constexpr bool beyond = true;
  template <VoxelOccupancy M>
  static VoxelBits in(const M& map, const Eigen::Vector3i& block) {
    return ~map.free_in(block) & VoxelBits::inside(map.grid(), block);
  }
};
/// What is known to be occupied.
struct Occupied {
  static constexpr bool beyond = false;
  template <VoxelOccupancy M>
  static VoxelBits in(const M& map, const Eigen::Vector3i& block) {
    return map.occupied_in(block);
  }
};

}  // namespace obstacle

/// A ball; a radius of 0 is a point. World frame [m].
struct Ball {
  Eigen::Vector3d centre;
  double radius_m;

  [[nodiscard]] bool valid() const { return centre.allFinite() && std::isfinite(radius_m) && radius_m >= 0; }
  [[nodiscard]] Box3 bounds() const { return {centre.array() - radius_m, centre.array() + radius_m}; }
  /// Whether it meets a cell of the given half extents, by the cell's centre.
  [[nodiscard]] auto meets_cells(const Eigen::Vector3d& half_m) const {
    return [c = centre, half_m, square = radius_m * radius_m](const Eigen::Vector3d& cell) {
      return ((cell - c).cwiseAbs() - half_m).cwiseMax(0).squaredNorm() <= square;
    };
  }
};

/// All that a ball sweeps over on a straight line: a capsule. World frame [m].
struct SweptBall {
  Eigen::Vector3d from, to;
  double radius_m;

  [[nodiscard]] bool valid() const { return Ball{from, radius_m}.valid() && to.allFinite(); }
  [[nodiscard]] Box3 bounds() const {
    return {from.cwiseMin(to).array() - radius_m, from.cwiseMax(to).array() + radius_m};
  }
  [[nodiscard]] auto meets_cells(const Eigen::Vector3d& half_m) const {
    return [*this, half_m](const Eigen::Vector3d& cell) {
      return squared_distance(Box3(cell - half_m, cell + half_m), from, to) <= radius_m * radius_m;
    };
  }
};

/// A box with a pose: its half extents along the pose's axes, around its origin. World frame [m].
struct OrientedBox {
  Eigen::Isometry3d pose;
  Eigen::Vector3d half_extents_m;

  [[nodiscard]] bool valid() const {
    return is_rigid(pose) && half_extents_m.allFinite() && (half_extents_m.array() >= 0).all();
  }
  [[nodiscard]] Box3 bounds() const {
    const Eigen::Vector3d reach = pose.linear().cwiseAbs() * half_extents_m;
    return {pose.translation() - reach, pose.translation() + reach};
  }
  /// By the fifteen axes that can separate two boxes (Gottschalk et al., "OBBTree", SIGGRAPH 1996).
  [[nodiscard]] auto meets_cells(const Eigen::Vector3d& half_m) const {
    Eigen::Matrix<double, 15, 3> axes;
    const Eigen::Matrix3d r = pose.linear();
    axes.topRows<3>().setIdentity();
    axes.middleRows<3>(3) = r.transpose();
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) axes.row(6 + 3 * i + k) = Eigen::Vector3d::Unit(i).cross(r.col(k));
    // Two edges that are parallel give no axis: a row of rounding errors, which must not separate.
    const Eigen::Matrix<double, 15, 1> reach =
        axes.cwiseAbs() * half_m + (axes * r).cwiseAbs() * half_extents_m +
        1e-12 * (1 + pose.translation().cwiseAbs().maxCoeff()) * Eigen::Matrix<double, 15, 1>::Ones();
    return [axes, reach, c = Eigen::Vector3d(pose.translation())](const Eigen::Vector3d& cell) {
      return ((axes * (cell - c)).cwiseAbs().array() <= reach.array()).all();
    };
  }
};

/// Whether a body meets an obstacle of the map. A body that is not finite, has a negative size or a pose that is no
/// rotation, is in collision. Blocks of 512 voxels without an obstacle near the body cost one test; the rest one a
/// voxel that is both an obstacle and within the body's bounds. Const, so that it runs concurrently.
template <class Obstacles = obstacle::NotFree, VoxelOccupancy M, class Body>
bool collides(const M& map, const Body& body, Obstacles = {}) {
  if (!body.valid()) return true;
  const VoxelGrid& grid = map.grid();
  const Box3 bounds = body.bounds(), box = grid.box();
  if (!bounds.min().allFinite() || !bounds.max().allFinite()) return true;
  // The body touches its bounds on each side, so that it leaves the grid where they do.
  if (Obstacles::beyond &&
      ((bounds.min().array() <= box.min().array()).any() || (bounds.max().array() >= box.max().array()).any()))
    return true;

  // Voxels within the bounds, those included that only touch them, to rounding.
  const auto voxel = [&](const Eigen::Vector3d& p, double slack) {
    const Eigen::Array3d v = ((p - grid.origin()).cwiseQuotient(grid.voxel_m()).array() + slack).floor();
    return Eigen::Vector3i(v.max(-1).min(grid.size().array().cast<double>()).cast<int>());
  };
  const Eigen::Vector3i low = voxel(bounds.min(), -1e-9).cwiseMax(0),
                        high = voxel(bounds.max(), 1e-9).cwiseMin(grid.size() - Eigen::Vector3i::Ones());
  if ((low.array() > high.array()).any()) return false;

  const Eigen::Vector3d half = 0.5 * grid.voxel_m();
  const auto meets_voxel = body.meets_cells(half);
  const auto meets_block = body.meets_cells(block_edge * half);
  const Eigen::Vector3i first = block_of(low), last = block_of(high);
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        const Eigen::Vector3i block(x, y, z);
        if (!meets_block(grid.origin() +
                         block_edge * grid.voxel_m().cwiseProduct((block.cast<double>().array() + 0.5).matrix())))
          continue;
        const VoxelBits bits =
            Obstacles::in(map, block) & VoxelBits::between(low - block_edge * block, high - block_edge * block);
        if (bits.any_of([&](std::size_t local) { return meets_voxel(grid.centre(voxel_of(block, local))); }))
          return true;
      }
  return false;
}

/// Whether a box meets an obstacle on the way (a RigidMotion) from one pose to another. Errs to the safe side only:
/// parts of the way are tested with the box grown by half of their length until that is below `tolerance_m`, so that
/// true may also mean an obstacle up to sqrt(3) times the tolerance away. O(log(way / tolerance)) tests in the open,
/// way / tolerance along an obstacle. Throws Error for a tolerance that is not finite and > 0.
template <class Obstacles = obstacle::NotFree, VoxelOccupancy M>
bool collides_on_way(const M& map, const OrientedBox& from, const Eigen::Isometry3d& to, double tolerance_m,
                     Obstacles obstacles = {}) {
  Check check("collides_on_way");
  check.positive("tolerance_m", tolerance_m);
  check.done();
  if (collides(map, from, obstacles) || collides(map, OrientedBox{to, from.half_extents_m}, obstacles)) return true;
  const RigidMotion motion(from.pose, to);
  const double way_m = motion.way_m(from.half_extents_m.norm());
  // The parts of a way that is halved n times, in turn: those of the tree that are still in doubt.
  struct Part {
    double begin, length;
  };
  std::vector<Part> parts = {{0, 1}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    const double middle = part.begin + 0.5 * part.length, grown_m = 0.5 * part.length * way_m;
    const OrientedBox box{motion.at(middle), from.half_extents_m};
    if (!collides(map, OrientedBox{box.pose, box.half_extents_m.array() + grown_m}, obstacles)) continue;
    if (grown_m <= tolerance_m || collides(map, box, obstacles)) return true;
    parts.push_back({middle, 0.5 * part.length});
    parts.push_back({part.begin, 0.5 * part.length});
  }
  return false;
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/map.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage {

/// From where a region is looked at (Fig. 6.3): neither too near nor too far from its centre, and not too far off its
/// normal. Borders belong to it, to a nanometre.
struct ViewCone {
  double nearest_m = 0.3;   ///< > 0
  double farthest_m = 2;    ///< not below nearest_m
  double min_cosine = 0.5;  ///< of the angle to the normal, in [-1, 1]

  void check(Check& check) const {
    check.positive("cone.nearest_m", nearest_m);
    check(std::isfinite(farthest_m) && farthest_m >= nearest_m, "cone.farthest_m", farthest_m,
          "finite, not below nearest_m");
    check(min_cosine >= -1 && min_cosine <= 1, "cone.min_cosine", min_cosine, "in [-1, 1]");
  }
  [[nodiscard]] bool contains(const Region& region, const Eigen::Vector3d& position) const {
    const Eigen::Vector3d d = position - region.centre;
    const double distance = d.norm();
    return distance >= nearest_m - tolerance && distance <= farthest_m + tolerance &&
           region.normal.dot(d) >= min_cosine * distance - tolerance;
  }
  /// Whether any point within `radius_m` of `centre` may lie inside: never false where one does.
  [[nodiscard]] bool may_contain(const Region& region, const Eigen::Vector3d& centre, double radius_m) const {
    const Eigen::Vector3d d = centre - region.centre;
    const double distance = d.norm(), r = radius_m + tolerance;
    return distance + r >= nearest_m && distance - r <= farthest_m &&
           region.normal.dot(d) + r >= min_cosine * (distance + (min_cosine < 0 ? r : -r));
  }
  /// The box around it.
  [[nodiscard]] Box3 box(const Region& region) const {
    const double opening_rad = std::acos(min_cosine);
    const auto reach_m = [&](double cosine) {  // along an axis at this angle to the normal
      const double beyond_rad = std::acos(std::clamp(cosine, -1.0, 1.0)) - opening_rad;
      return tolerance + farthest_m * std::max(0.0, std::cos(std::max(0.0, beyond_rad)));
    };
    Box3 box(region.centre, region.centre);
    for (int a = 0; a < 3; ++a) {
      box.min()[a] -= reach_m(-region.normal[a]);
      box.max()[a] += reach_m(region.normal[a]);
    }
    return box;
  }

 private:
  static constexpr double tolerance = 1e-9;
};

namespace detail {

/// The voxels of a grid that a box touches: from `low` to below `high`.
struct VoxelRange {
  Eigen::Vector3i low, high;
  VoxelRange(const VoxelGrid& grid, const Box3& box) {
    const Eigen::Array3d size = grid.size().cast<double>().array();
    const auto index = [&](const Eigen::Vector3d& p) {
      return (p - grid.origin()).cwiseQuotient(grid.voxel_m()).array();
    };
    low = index(box.min()).floor().max(0).min(size).cast<int>();
    high = (index(box.max()).floor() + 1).max(0).min(size).cast<int>();
  }
  [[nodiscard]] bool empty() const { return (low.array() >= high.array()).any(); }
  [[nodiscard]] std::uint64_t count() const {
    const Eigen::Matrix<std::uint64_t, 3, 1> n = (high - low).cast<std::uint64_t>();
    return n.x() * n.y() * n.z();
  }
  [[nodiscard]] Eigen::Vector3i operator[](std::uint64_t i) const {
    const Eigen::Matrix<std::uint64_t, 3, 1> n = (high - low).cast<std::uint64_t>();
    return low + Eigen::Matrix<std::uint64_t, 3, 1>(i % n.x(), i / n.x() % n.y(), i / n.x() / n.y()).cast<int>();
  }
};

}  // namespace detail

/// f(voxel) for each navigable voxel whose centre lies in a region's cone, block by block in the order z, y, x. Blocks
/// that the cone misses cost a distance, those without a navigable voxel one look at their bits. `Space` is a
/// NavigableMap, or anything else with its grid(), navigable(voxel) and navigable_in(block).
template <class Space, class F>
void for_each_in_cone(const Space& map, const Region& region, const ViewCone& cone, F&& f) {
  const VoxelGrid& grid = map.grid();
  const detail::VoxelRange range(grid, cone.box(region));
  if (range.empty()) return;
  const Eigen::Vector3i first = block_of(range.low), last = block_of(range.high - Eigen::Vector3i::Ones());
  const Eigen::Vector3d half = 0.5 * (block_edge - 1) * grid.voxel_m();  // from a block's middle to its outmost centres
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        const Eigen::Vector3i block(x, y, z);
        if (!cone.may_contain(region, grid.centre(block_edge * block) + half, half.norm())) continue;
        const VoxelBits navigable = map.navigable_in(block);
        navigable.for_each([&](std::size_t local) {
          const Eigen::Vector3i voxel = voxel_of(block, local);
          if (cone.contains(region, grid.centre(voxel))) f(voxel);
        });
      }
}

/// Writes `n` different voxels of those that for_each_in_cone names, each set of n equally likely, into `drawn`; all of
/// them if there are fewer. Looks at a few dozen voxels where many will do, at all of the cone where few do.
template <class Space>
void draw_in_cone(const Space& map, const Region& region, const ViewCone& cone, std::size_t n, Rng& rng,
                  std::vector<Eigen::Vector3i>& drawn) {
  constexpr std::size_t attempts = 24;  // for each voxel wanted
  drawn.clear();
  const detail::VoxelRange range(map.grid(), cone.box(region));
  if (range.empty() || n == 0) return;
  // Voxels of the box, thrown away unless they will do. Whether this succeeds says nothing of which voxels it finds.
  for (std::size_t i = 0; i < attempts * n && drawn.size() < n; ++i) {
    const Eigen::Vector3i voxel = range[rng.index(range.count())];
    if (cone.contains(region, map.grid().centre(voxel)) && map.navigable(voxel) &&
        std::find(drawn.begin(), drawn.end(), voxel) == drawn.end())
      drawn.push_back(voxel);
  }
  if (drawn.size() == n) return;
  // A reservoir, which draws a number only when something enters it (Li, "Reservoir-sampling algorithms of time
  // complexity O(n(1 + log(N/n)))", 1994).
  drawn.clear();
  const auto log_uniform = [&] { return std::log(1 - rng.uniform()); };
  double log_weight = 0, wait = 0;
  const auto draw_wait = [&] {
    log_weight += log_uniform() / static_cast<double>(n);
    wait = std::floor(log_uniform() / std::log1p(-std::exp(log_weight)));
  };
  for_each_in_cone(map, region, cone, [&](const Eigen::Vector3i& voxel) {
    if (drawn.size() < n) {
      drawn.push_back(voxel);
      if (drawn.size() == n) draw_wait();
    } else if (wait-- < 1) {
      drawn[rng.index(n)] = voxel;
      draw_wait();
    }
  });
}

}  // namespace vantage

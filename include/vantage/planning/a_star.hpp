// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/planning/passable.hpp>
#include <vantage/planning/voxel_search.hpp>
#include <vantage/planning/waypoints.hpp>

namespace vantage {

struct AStarConfig {
  /// Radius of the space around the robot that is open because it is there, >= 0; unset: the map's clearance_m().
  std::optional<double> own_ball_m = {};
};

/// The router of voxel maps (section 6.2.3): shortest paths over the 26-connected graph of the voxels in which the
/// robot's body fits, and its own ball (Passable), by one search for all goals (VoxelSearch).
///
/// A path goes from the start to the centre of its voxel, from centre to centre, and from the last centre to the goal;
/// straight if both are in one voxel. lengths_m() are the lengths of just these paths: for starts and goals at centres,
/// as in chapter 6, those of the graph. Infinity, and an empty path, for a goal that cannot be reached: enclosed, not
/// navigable, or outside of the grid; for every goal if the start is outside. Throws Error for a view that is no rigid,
/// finite pose. A path is cleaned from needless corners by Shortcut<AStar>.
///
/// The map's clearance r holds at the centres of navigable voxels. On the straight line between two of them, m apart,
/// sqrt(r^2 - m^2 / 4) of it is left: 19.5 of 20 cm on the longest diagonal of voxels of 5 cm. On the legs from the
/// start and to the goal, each within one voxel of diagonal d, r - d / 2 is left; in the robot's own ball, nothing.
class AStar {
 public:
  using MapNeeds = Needs<need::Navigable>;
  using Config = AStarConfig;
  AStar() = default;
  explicit AStar(const AStarConfig& config) : config_(config) {
    Check check("AStar::Config");
    check.not_negative("own_ball_m", config.own_ball_m.value_or(0));
    check.done();
  }

  template <NavigableMap M>
  std::vector<double> lengths_m(const M& map, const View& from, Views goals) const {
    std::vector<double> lengths(goals.size(), std::numeric_limits<double>::infinity());
    search(map, from, goals, [&](std::size_t i, const auto& found, const auto& start, const auto& end) {
      const double between_m = found.length_m(end);
      const VoxelGrid& grid = map.grid();
      const Eigen::Vector3d a = from.position(), b = goals[i].position();
      lengths[i] =
          start == end ? (b - a).norm() : (grid.centre(start) - a).norm() + between_m + (b - grid.centre(end)).norm();
    });
    return lengths;
  }
  template <NavigableMap M>
  std::vector<View> path(const M& map, const View& from, const View& goal) const {
    const std::vector<Eigen::Vector3d> points = std::move(ways(map, from, {&goal, 1}).front());
    if (points.empty()) return {};
    return views_along(points, from, goal);
  }

  /// The paths to all goals as polylines, both ends included, without points in the middle of a straight line.
  template <NavigableMap M>
  std::vector<std::vector<Eigen::Vector3d>> ways(const M& map, const View& from, Views goals) const {
    std::vector<std::vector<Eigen::Vector3d>> ways(goals.size());
    search(map, from, goals, [&](std::size_t i, const auto& found, const auto&, const auto& end) {
      const std::vector<Eigen::Vector3i> voxels = found.path(end);
      if (voxels.empty()) return;
      ways[i].push_back(from.position());
      for (std::size_t k = 0; voxels.size() > 1 && k < voxels.size(); ++k)
        if (k == 0 || k + 1 == voxels.size() || voxels[k] - voxels[k - 1] != voxels[k + 1] - voxels[k])
          add(map.grid().centre(voxels[k]), ways[i]);
      add(goals[i].position(), ways[i]);
      if (ways[i].size() == 1) ways[i].push_back(goals[i].position());  // the robot is there
    });
    return ways;
  }
  /// The voxels that a path from here may pass; none if the start is outside of the grid.
  template <NavigableMap M>
  std::optional<Passable<M>> passable(const M& map, const View& from) const {
    const std::optional<Eigen::Vector3i> start = voxel_at(map.grid(), from);
    if (!start) return std::nullopt;
    return Passable<M>(map, *start, config_.own_ball_m);
  }

 private:
  // found(i, search, start, end) for every goal inside of the grid.
  template <class M, class F>
  void search(const M& map, const View& from, Views goals, F&& found) const {
    check_view(from, "AStar (from)");
    const VoxelGrid& grid = map.grid();
    std::vector<std::optional<Eigen::Vector3i>> ends;
    std::vector<Eigen::Vector3i> inside;
    for (std::size_t i = 0; i < goals.size(); ++i) {
      check_view(goals[i], concat("AStar (goal ", i, ")"));
      ends.push_back(voxel_at(grid, goals[i]));
      if (ends.back()) inside.push_back(*ends.back());
    }
    const std::optional<Passable<M>> open = passable(map, from);
    if (!open) return;
    const Eigen::Vector3i start = grid.voxel_at(from.position());
    const VoxelSearch search(*open, start, inside);
    for (std::size_t i = 0; i < goals.size(); ++i)
      if (ends[i]) found(i, search, start, *ends[i]);
  }
  static std::optional<Eigen::Vector3i> voxel_at(const VoxelGrid& grid, const View& view) {
    if (!grid.box().contains(view.position())) return std::nullopt;
    const Eigen::Vector3i voxel = grid.voxel_at(view.position());
    if (!grid.contains(voxel)) return std::nullopt;
    return voxel;
  }
  static void add(const Eigen::Vector3d& point, std::vector<Eigen::Vector3d>& to) {
    if (to.back() != point) to.push_back(point);
  }
  Config config_{};
};

}  // namespace vantage

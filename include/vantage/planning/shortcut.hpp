// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/planning/line_of_sight.hpp>
#include <vantage/planning/passable.hpp>
#include <vantage/planning/waypoints.hpp>

namespace vantage {

/// A polyline without the corners that it does not need: from each point it goes straight to the farthest later one
/// that is in line of sight, or else to the next as before. Never longer than what it was given.
template <PassableVoxels P>
std::vector<Eigen::Vector3d> shortcut(const P& passable, std::span<const Eigen::Vector3d> points) {
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t at = 0; at < points.size();) {
    kept.push_back(points[at]);
    std::size_t next = points.size() - 1;
    while (next > at + 1 && !line_of_sight(passable, points[at], points[next])) --next;
    at = std::max(next, at + 1);
  }
  return kept;
}

/// A router whose paths are those of another, straightened: lengths_m() are the lengths of the straightened paths, so
/// that a selector weighs what the robot will fly. (Chapter 6 weighs the lengths of the graph: that is the other router
/// alone.) Goals are straightened concurrently. The other router also says ways() and passable(), as AStar does.
///
/// The voxels that a straightened leg touches are navigable, so that the map's clearance r holds at their centres. No
/// point of a voxel of diagonal d is farther than d / 2 from its centre: on the leg, r - d / 2 is left, 15.7 of 20 cm
/// in voxels of 5 cm. A leg that stays keeps what the other router says, AStar's no less. In the robot's own ball,
/// nothing is left.
template <class Router = AStar>
class Shortcut {
 public:
  using MapNeeds = NeedsOf<Router>;
  Shortcut() = default;
  explicit Shortcut(Router router) : router_(std::move(router)) {}

  template <NavigableMap M>
  requires RouterFor<Router, M> std::vector<double> lengths_m(const M& map, const View& from, Views goals)
  const {
    std::vector<double> lengths;
    for (const auto& way : ways(map, from, goals))
      lengths.push_back(way.empty() ? std::numeric_limits<double>::infinity() : length_m(way));
    return lengths;
  }
  template <NavigableMap M>
  requires RouterFor<Router, M> std::vector<View> path(const M& map, const View& from, const View& goal)
  const {
    const auto way = std::move(ways(map, from, {&goal, 1}).front());
    if (way.empty()) return {};
    return views_along(way, from, goal);
  }
  template <NavigableMap M>
  std::vector<std::vector<Eigen::Vector3d>> ways(const M& map, const View& from, Views goals) const {
    auto ways = router_.ways(map, from, goals);
    if (const auto open = router_.passable(map, from))
      parallel_for_blocks(ways.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ways[i] = shortcut(*open, ways[i]);
      });
    return ways;
  }
  template <NavigableMap M>
  auto passable(const M& map, const View& from) const {
    return router_.passable(map, from);
  }

 private:
  Router router_{};
};

}  // namespace vantage

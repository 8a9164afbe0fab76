// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/box.hpp>

namespace vantage {

/// Says whether a robot may be at a point (world frame [m]): called concurrently.
template <class F>
concept FreeSpace = std::predicate<const F&, const Eigen::Vector3d&>;

/// The points of a cubic lattice through `start`, inside of `bounds` (sides included), at which `is_free` holds and
/// that can be reached from `start` in steps along an axis from one such point to the next; `start` is the first, the
/// others follow by the number of steps. Only the points are asked, not the way between them: if `is_free` means a
/// clearance of r >= spacing_m / 2 to any obstacle, every point of a step keeps at least r - spacing_m / 2. Empty if
/// the start is not free. Throws Error for bounds or a start that are not finite, a start outside, or more than 2^28
/// lattice points. One call of `is_free` for each point that has a reachable neighbour; one bit of memory a lattice
/// point.
template <FreeSpace F>
std::vector<Eigen::Vector3d> reachable_positions(const Box3& bounds, double spacing_m, const Eigen::Vector3d& start,
                                                 const F& is_free) {
  Check check("reachable_positions");
  check(bounds.min().allFinite() && bounds.max().allFinite() && !bounds.isEmpty(), "bounds",
        concat("(", bounds.min().transpose(), ") to (", bounds.max().transpose(), ")"), "finite, not empty");
  check.positive("spacing_m", spacing_m);
  check(start.allFinite() && bounds.contains(start), "start", concat("(", start.transpose(), ")"), "in the bounds");
  check.done();
  const Eigen::Array3d below = ((start - bounds.min()).array() / spacing_m + 1e-9).floor(),
                       above = ((bounds.max() - start).array() / spacing_m + 1e-9).floor();
  const Eigen::Array3d extent = below + above + 1;
  if (!(extent.prod() <= 0x1p28))
    throw Error("reachable_positions", concat("the bounds hold ", extent.prod(), " points"), "2^28 at most");
  const Eigen::Vector3i n = extent.cast<int>(), origin = below.cast<int>();
  const auto slot = [&](const Eigen::Vector3i& p) {
    return (static_cast<std::size_t>(p.z()) * static_cast<std::size_t>(n.y()) + static_cast<std::size_t>(p.y())) *
               static_cast<std::size_t>(n.x()) +
           static_cast<std::size_t>(p.x());
  };
  const auto position = [&](const Eigen::Vector3i& p) {
    return Eigen::Vector3d(start + spacing_m * (p - origin).cast<double>());
  };

  std::vector<bool> asked(static_cast<std::size_t>(extent.prod()));
  std::vector<Eigen::Vector3d> reached;
  std::vector<Eigen::Vector3i> wave = {origin};  // as many steps from the start
  asked[slot(origin)] = true;
  while (!wave.empty()) {
    std::vector<std::uint8_t> is_open(wave.size());
    parallel_for_blocks(wave.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) is_open[i] = is_free(position(wave[i])) ? 1 : 0;
    });
    std::vector<Eigen::Vector3i> next;
    for (std::size_t i = 0; i < wave.size(); ++i) {
      if (is_open[i] == 0) continue;
      reached.push_back(position(wave[i]));
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          Eigen::Vector3i p = wave[i];
          p[axis] += step;
          if (p[axis] < 0 || p[axis] >= n[axis] || asked[slot(p)]) continue;
          asked[slot(p)] = true;
          next.push_back(p);
        }
    }
    wave = std::move(next);
  }
  return reached;
}

}  // namespace vantage

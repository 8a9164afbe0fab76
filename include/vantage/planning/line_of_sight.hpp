// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/planning/passable.hpp>

namespace vantage {

/// f(voxel) for every voxel that a segment between two points touches, borders included, while f returns true; whether
/// it did for all. A segment that runs from one voxel to another through a common edge or corner touches all that meet
/// there, so that no gap between two diagonal neighbours is taken for a way. Points within 2^30 voxels of the grid;
/// voxels may lie outside of it, and may come twice. World frame [m].
template <class F>
bool every_voxel_on(const VoxelGrid& grid, const Eigen::Vector3d& a, const Eigen::Vector3d& b, F&& f) {
  // In voxels; what is this near to a border lies on it.
  constexpr double tolerance = 1e-9;
  const Eigen::Array3d from = (a - grid.origin()).cwiseQuotient(grid.voxel_m()),
                       to = (b - grid.origin()).cwiseQuotient(grid.voxel_m()), along = to - from;
  const auto touched = [&](const Eigen::Array3d& low, const Eigen::Array3d& high) {
    const Eigen::Array3i first = (low.min(high) - tolerance).floor().cast<int>(),
                         last = (low.max(high) + tolerance).floor().cast<int>();
    for (int z = first.z(); z <= last.z(); ++z)
      for (int y = first.y(); y <= last.y(); ++y)
        for (int x = first.x(); x <= last.x(); ++x)
          if (!f(Eigen::Vector3i(x, y, z))) return false;
    return true;
  };
  // From border to border of whatever axis: each piece lies within one voxel, but for its ends.
  Eigen::Array3d border, at = from;
  for (int i = 0; i < 3; ++i) border[i] = along[i] > 0 ? std::floor(from[i]) + 1 : std::ceil(from[i]) - 1;
  for (double t = 0; t < 1;) {
    Eigen::Array3d when;
    for (int i = 0; i < 3; ++i)
      when[i] = along[i] != 0 ? (border[i] - from[i]) / along[i] : std::numeric_limits<double>::infinity();
    t = std::min(1.0, when.minCoeff());
    const Eigen::Array3d next = t < 1 ? Eigen::Array3d(from + t * along) : to;
    if (!touched(at, next)) return false;
    for (int i = 0; i < 3; ++i)
      if (when[i] <= t) border[i] += along[i] > 0 ? 1 : -1;
    at = next;
  }
  return a == b ? touched(from, from) : true;
}

/// Whether a robot may go straight from a to b: every voxel that the segment touches is passable.
template <PassableVoxels P>
bool line_of_sight(const P& passable, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return every_voxel_on(passable.grid(), a, b, [&](const Eigen::Vector3i& voxel) { return passable(voxel); });
}

}  // namespace vantage

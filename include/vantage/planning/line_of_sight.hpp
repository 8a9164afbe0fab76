// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>

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
  const auto at = [&](const Eigen::Array3d& p) {
    const Eigen::Array3i first = (p - tolerance).floor().cast<int>(), last = (p + tolerance).floor().cast<int>();
    for (int z = first.z(); z <= last.z(); ++z)
      for (int y = first.y(); y <= last.y(); ++y)
        for (int x = first.x(); x <= last.x(); ++x)
          if (!f(Eigen::Vector3i(x, y, z))) return false;
    return true;
  };
  // From border to border of whatever axis: on a border meets what is on both sides of it, between two only one voxel
  // (or those on either side of a border along the segment).
  Eigen::Array3d border;
  for (int i = 0; i < 3; ++i) border[i] = along[i] > 0 ? std::floor(from[i]) + 1 : std::ceil(from[i]) - 1;
  if (!at(from)) return false;
  for (double t = 0; t < 1;) {
    Eigen::Array3d when = Eigen::Array3d::Constant(1);
    for (int i = 0; i < 3; ++i)
      if (along[i] != 0) when[i] = std::min(1.0, (border[i] - from[i]) / along[i]);
    const double next = when.minCoeff();
    if (!at(from + 0.5 * (t + next) * along) || !at(next < 1 ? Eigen::Array3d(from + next * along) : to)) return false;
    for (int i = 0; i < 3; ++i)
      if (when[i] <= next) border[i] += along[i] > 0 ? 1 : -1;
    t = next;
  }
  return true;
}

/// Whether a robot may go straight from a to b: every voxel that the segment touches is passable.
template <PassableVoxels P>
bool line_of_sight(const P& passable, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return every_voxel_on(passable.grid(), a, b, [&](const Eigen::Vector3i& voxel) { return passable(voxel); });
}

}  // namespace vantage

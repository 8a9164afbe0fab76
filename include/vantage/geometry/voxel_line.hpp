// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include <Eigen/Core>

namespace vantage {

/// Whether `f(voxel)` holds for every voxel on the straight line between the centres of two voxels, both ends included;
/// asks in order from the first and stops at the first that says no. Exact in whole numbers, whatever the voxels'
/// edges, and the same voxels in both directions: where the line passes through an edge or a corner it touches no voxel
/// but the two that it leaves and enters. Voxels within 2^30 of each other.
template <class F>
bool all_between(const Eigen::Vector3i& from, const Eigen::Vector3i& to, F&& f) {
  using Wide = Eigen::Matrix<std::int64_t, 3, 1>;
  const Wide n = (to - from).cast<std::int64_t>().cwiseAbs();
  const Eigen::Vector3i way = (to - from).cwiseSign();
  Eigen::Vector3i voxel = from;
  // The line crosses the k-th border along an axis after (2 k - 1) / (2 n) of its length.
  Wide crossing = Wide::Ones();
  const auto before = [&](int a, int b) {  // whether axis a's next border comes no later than axis b's
    return n[b] == 0 || (n[a] != 0 && crossing[a] * n[b] <= crossing[b] * n[a]);
  };
  while (f(voxel)) {
    if (voxel == to) return true;
    const bool x = before(0, 1) && before(0, 2), y = before(1, 0) && before(1, 2), z = before(2, 0) && before(2, 1);
    if (x && n.x() != 0) voxel.x() += way.x(), crossing.x() += 2;
    if (y && n.y() != 0) voxel.y() += way.y(), crossing.y() += 2;
    if (z && n.z() != 0) voxel.z() += way.z(), crossing.z() += 2;
  }
  return false;
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <vantage/concepts/policy.hpp>

#include "drawn_voxels.hpp"

namespace vantage::test {

/// Two rooms, 6 x 3 x 2 m at 20 cm, walls of a voxel around and at x = 3 m, between which a door of 1 m is open. The
/// left one is known; of the right one only what lies before x = 4.4 m.
inline DrawnFrontiers two_rooms() {
  DrawnFrontiers map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(6, 3, 2)}, 0.2), 0.2);
  const Eigen::Vector3i last = map.grid().size() - Eigen::Vector3i::Ones();
  for (int z = 0; z <= last.z(); ++z)
    for (int y = 0; y <= last.y(); ++y)
      for (int x = 0; x < 22; ++x) {
        const bool shell = x == 0 || y == 0 || y == last.y() || z == 0 || z == last.z();
        const bool wall = x == 15 && !(y >= 5 && y < 10);
        map.draw({x, y, z}, shell || wall ? Space::occupied : Space::free);
      }
  return map;
}

template <class Sampler, class M>
Candidates sample(Sampler sampler, const M& map, const Situation& q, std::uint64_t seed) {
  const auto height = [](Views, Views views, std::span<double> out) {
    for (std::size_t i = 0; i < views.size(); ++i) out[i] = views[i].position().z();
  };
  Rng rng(seed);
  return sampler.sample(map, q, Score(height), rng);
}

}  // namespace vantage::test

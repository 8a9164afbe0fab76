// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <set>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/planning/passable.hpp>
#include <vantage/planning/reachable_voxels.hpp>

#include "drawn_voxels.hpp"

namespace vantage {
namespace {

using Voxel = std::array<int, 3>;

/// One voxel after the other.
std::set<Voxel> reference(const Passable<test::DrawnVoxels>& passable, const Eigen::Vector3i& start) {
  std::set<Voxel> found;
  std::vector<Eigen::Vector3i> open;
  const auto enter = [&](const Eigen::Vector3i& v) {
    if (passable(v) && found.insert({v.x(), v.y(), v.z()}).second) open.push_back(v);
  };
  enter(start);
  while (!open.empty()) {
    const Eigen::Vector3i v = open.back();
    open.pop_back();
    for (int k = 0; k < 27; ++k) enter(v + Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
  }
  return found;
}

TEST(ReachableVoxels, AreThoseThatAFloodReaches) {
  // Around the share of free voxels at which 26-connected ones begin to hang together, ways are long and winding.
  std::size_t most = 0, least = 1 << 20;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng(seed);
    const double share = rng.uniform(0.05, 0.25);
    test::DrawnVoxels map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2.7, 1.9, 3.1)}, 0.1), 0.01);
    map.draw_all([&](const Eigen::Vector3i&) { return rng.uniform() < share ? Space::free : Space::occupied; });
    const auto index = [&](int axis) {
      return static_cast<int>(rng.index(static_cast<std::uint64_t>(map.grid().size()[axis])));
    };
    const int x = index(0), y = index(1);
    const Eigen::Vector3i start(x, y, index(2));
    const Passable passable(map, start, 0.1);
    const ReachableVoxels reachable(passable, start);
    std::set<Voxel> ours;
    for (int k = -1; k <= map.grid().size().z(); ++k)
      for (int j = -1; j <= map.grid().size().y(); ++j)
        for (int i = -1; i <= map.grid().size().x(); ++i)
          if (reachable({i, j, k})) ours.insert({i, j, k});
    const std::set<Voxel> theirs = reference(passable, start);
    EXPECT_EQ(ours, theirs) << "seed " << seed;
    most = std::max(most, ours.size()), least = std::min(least, ours.size());
  }
  EXPECT_GT(most, 2000u);
  EXPECT_LT(least, 100u);
}

TEST(ReachableVoxels, NoneFromWhereNothingPasses) {
  test::DrawnVoxels map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1)}, 0.1), 0.01);
  map.draw_all([](const Eigen::Vector3i&) { return Space::free; });
  const Passable passable(map, {20, 0, 0}, 0.1);
  const ReachableVoxels reachable(passable, {20, 0, 0});
  EXPECT_FALSE(reachable({20, 0, 0}) || reachable({5, 5, 5}) || reachable.in({0, 0, 0}).any());
}

}  // namespace
}  // namespace vantage

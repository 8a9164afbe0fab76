// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/geometry/visible_voxels.hpp>

#include "golden.hpp"

// The visible unexplored voxels that the published code counts from eight views, given what it rendered there.
namespace vantage {
namespace {

using GoldenUnexplored = test::ToyRoom;

TEST_F(GoldenUnexplored, ThePublishedCodesCounts) {
  ASSERT_EQ(grid.size(), Eigen::Vector3i(13, 11, 8));
  const std::vector<double> unexplored = column("after2.csv", "unexplored"),
                            counts = column("utility.csv", "N_visible_unexplored"),
                            psi = column("utility.csv", "psi_V");
  ASSERT_EQ(unexplored.size(), grid.count());
  test::DrawnVoxels room(grid, 0);
  for (std::size_t i = 0; i < unexplored.size(); ++i)
    if (unexplored[i] != 1) room.draw(voxel_in(i), Space::unknown);
  const std::vector<View> views = candidates();
  ASSERT_EQ(counts.size(), 8u);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Image<float> depth = rendered_depth(i);
    ASSERT_EQ(depth.size(), 64 * 64);
    const VisibleVoxels visible(grid, views.at(i), camera, depth, 5);
    std::uint64_t count = 0;
    visible.for_each_block([&](const Eigen::Vector3i& block) {
      count += static_cast<std::uint64_t>(visible(block, room.unexplored_in(block)).count());
    });
    EXPECT_EQ(static_cast<double>(count), counts[i]) << "view " << i;
    EXPECT_NEAR(static_cast<double>(count) / static_cast<double>(grid.count()), psi[i], 1e-15);
  }
}

}  // namespace
}  // namespace vantage

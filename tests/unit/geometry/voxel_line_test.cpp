// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/geometry/voxel_line.hpp>

namespace vantage {
namespace {

using Voxels = std::vector<std::array<int, 3>>;

Voxels line(const Eigen::Vector3i& from, const Eigen::Vector3i& to) {
  Voxels passed;
  EXPECT_TRUE(all_between(from, to, [&](const Eigen::Vector3i& v) {
    passed.push_back({v.x(), v.y(), v.z()});
    return passed.size() < 1000;
  }));
  return passed;
}
Eigen::Vector3i random_voxel(Rng& rng) {
  const auto index = [&] { return static_cast<int>(rng.index(21)) - 10; };
  const int x = index(), y = index();
  return {x, y, index()};
}

/// Every voxel around whose open cube the segment of centres cuts in more than a point.
Voxels reference(const Eigen::Vector3i& from, const Eigen::Vector3i& to) {
  const Eigen::Array3d a = from.cast<double>().array(), d = (to - from).cast<double>().array();
  Voxels cut;
  for (int z = -10; z <= 10; ++z)
    for (int y = -10; y <= 10; ++y)
      for (int x = -10; x <= 10; ++x) {
        const Eigen::Array3d middle(x, y, z);
        double enter = 0, leave = 1;
        for (int k = 0; k < 3; ++k) {
          if (d[k] == 0) {
            if (middle[k] != a[k]) leave = -1;
          } else {
            const double s = (middle[k] - 0.5 - a[k]) / d[k], t = (middle[k] + 0.5 - a[k]) / d[k];
            enter = std::max(enter, std::min(s, t)), leave = std::min(leave, std::max(s, t));
          }
        }
        if (enter < leave - 1e-9 || (d == 0).all()) {
          if (leave >= 0) cut.push_back({x, y, z});
        }
      }
  return cut;
}

TEST(VoxelLine, PassesWhatTheSegmentCuts) {
  Rng rng(1);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3i from = random_voxel(rng), to = random_voxel(rng);
    Voxels passed = line(from, to), cut = reference(from, to);
    EXPECT_EQ(passed.front(), (std::array{from.x(), from.y(), from.z()}));
    EXPECT_EQ(passed.back(), (std::array{to.x(), to.y(), to.z()}));
    std::sort(passed.begin(), passed.end());
    std::sort(cut.begin(), cut.end());
    EXPECT_EQ(passed, cut) << from.transpose() << " to " << to.transpose();
  }
}

TEST(VoxelLine, IsTheSameBothWays) {
  Rng rng(2);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3i a = random_voxel(rng), b = random_voxel(rng);
    Voxels there = line(a, b), back = line(b, a);
    std::reverse(back.begin(), back.end());
    EXPECT_EQ(there, back);
  }
}

TEST(VoxelLine, CrossesEdgesAndCornersAtOnce) {
  EXPECT_EQ(line({0, 0, 0}, {3, 3, 3}), (Voxels{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}));
  EXPECT_EQ(line({0, 5, 0}, {-2, 5, 2}), (Voxels{{0, 5, 0}, {-1, 5, 1}, {-2, 5, 2}}));
  EXPECT_EQ(line({4, 4, 4}, {4, 4, 4}), (Voxels{{4, 4, 4}}));
}

TEST(VoxelLine, StopsWhereItIsToldTo) {
  int asked = 0;
  EXPECT_FALSE(all_between({0, 0, 0}, {10, 4, 0}, [&](const Eigen::Vector3i& v) { return ++asked, v.x() < 3; }));
  EXPECT_EQ(asked, 5);  // (0,0) (1,0) (2,1)... up to the first with x = 3
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/planning/box_in_voxels.hpp>
#include <vantage/planning/rigid_motion.hpp>
#include <vantage/planning/rrt_star.hpp>

#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

#include <vantage/core/units.hpp>

#include "drawn_voxels.hpp"
#include "message_of.hpp"

namespace vantage {
namespace {

using test::DrawnVoxels;
static_assert(CollisionFree<BoxInVoxels<DrawnVoxels>>);
static_assert(CollisionFree<BoxInVoxels<DrawnVoxels, obstacle::Occupied>>);

const shape::Box plank{{0.5, 0.1, 0.15}};

Eigen::Isometry3d pose(double x, double y, double z, double yaw_rad = 0) {
  Eigen::Isometry3d p(Eigen::Translation3d(x, y, z));
  p.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  return p;
}
/// 4 x 3 x 1 m of free voxels of 10 cm, and across it at x = 0 a wall of 20 cm with a gap, `gap_m` wide, around y = 0.
DrawnVoxels room_with_a_gap(double gap_m, Space in_the_gap = Space::free) {
  const Eigen::Vector3d half(2, 1.5, 0.5);
  DrawnVoxels map(VoxelGrid::dividing({-half, half}, 0.1), 0.3);
  map.draw_all([&](const Eigen::Vector3i& v) {
    const Eigen::Vector3d p = map.grid().centre(v);
    if (std::abs(p.x()) > 0.1) return Space::free;
    return std::abs(p.y()) < 0.5 * gap_m ? in_the_gap : Space::occupied;
  });
  return map;
}
/// Slow and obvious: points throughout the body, closer than the voxels are, each in a voxel that is free.
bool is_free_by_points(const DrawnVoxels& map, const Eigen::Isometry3d& p) {
  constexpr int n = 13;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k)
        if (map.at(p * (Eigen::Vector3d(i, j, k) / n).cwiseProduct(plank.half_extents_m)) != Space::free) return false;
  return true;
}

TEST(BoxInVoxels, APlankTurnsToPassAGapThroughWhichItDoesNotFitCrosswise) {
  // 1 m long and 20 cm wide, through a gap of 60 cm; it starts and ends crosswise, and stays on the ground.
  const DrawnVoxels map = room_with_a_gap(0.6);
  const BoxInVoxels body(map, plank);
  const Eigen::Isometry3d start = pose(-1.2, 0, 0, deg(90)), goal = pose(1.2, 0, 0, deg(90));
  ASSERT_TRUE(body.is_free(start) && body.is_free(goal));
  ASSERT_FALSE(body.is_free(start, goal));
  ASSERT_FALSE(body.is_free(pose(0, 0, 0, deg(90))));
  ASSERT_TRUE(body.is_free(pose(-1, 0, 0), pose(1, 0, 0)));
  const UprightPoses ground{.bounds = {Eigen::Vector3d(-2, -1.5, 0), Eigen::Vector3d(2, 1.5, 0)}};
  const auto path = RrtStar<>({.space = ground, .samples = 1500}).plan(start, goal, body, Rng(1));
  ASSERT_TRUE(path);
  EXPECT_TRUE(path->poses.front().isApprox(start, 1e-12) && path->poses.back().isApprox(goal, 1e-12));
  EXPECT_GT(path->cost_m, 2.4 + 0.1);  // it turned
  for (std::size_t i = 1; i < path->poses.size(); ++i) {
    EXPECT_TRUE(body.is_free(path->poses[i])) << i;
    EXPECT_TRUE(body.is_free(path->poses[i - 1], path->poses[i])) << i;
    const RigidMotion motion(path->poses[i - 1], path->poses[i]);
    for (int s = 0; s <= 100; ++s)
      EXPECT_TRUE(is_free_by_points(map, motion.at(s / 100.0))) << i << " at " << s << " %";
  }
}

TEST(BoxInVoxels, NoPathWhereItDoesNotFit) {
  const UprightPoses space{.bounds = {Eigen::Vector3d(-2, -1.5, -0.5), Eigen::Vector3d(2, 1.5, 0.5)}};
  const RrtStar<> planner({.space = space, .samples = 1000});
  const auto finds_a_way = [&](const auto& body) {
    return planner.plan(pose(-1.2, 0, 0), pose(1.2, 0, 0), body, Rng(1)).has_value();
  };
  const DrawnVoxels closed = room_with_a_gap(0), narrow = room_with_a_gap(0.2),
                    unknown = room_with_a_gap(0.6, Space::unknown);
  EXPECT_FALSE(finds_a_way(BoxInVoxels(closed, plank)));
  EXPECT_FALSE(finds_a_way(BoxInVoxels(narrow, plank)));  // as wide as the plank: to touch is to collide
  EXPECT_FALSE(finds_a_way(BoxInVoxels(unknown, plank)));
  EXPECT_TRUE(finds_a_way(BoxInVoxels(unknown, plank, {}, obstacle::Occupied{})));
}

TEST(BoxInVoxels, TheToleranceIsHowCloseAWayMayCome) {
  // Along the wall at x = -0.1, whose plank then ends 15 mm from it.
  const DrawnVoxels map = room_with_a_gap(0);
  const Eigen::Isometry3d from = pose(-0.215, -0.9, 0, deg(90)), to = pose(-0.215, 0.9, 0, deg(90));
  EXPECT_TRUE(BoxInVoxels(map, plank, {.tolerance_m = 0.008}).is_free(from, to));
  EXPECT_FALSE(BoxInVoxels(map, plank, {.tolerance_m = 0.1}).is_free(from, to));
}

TEST(BoxInVoxels, WhatIsNoBodyIsRefusedAndWhatIsNoPoseCollides) {
  const DrawnVoxels map = room_with_a_gap(0.6);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_REFUSED(BoxInVoxels(map, shape::Box{{0.1, -0.1, 0.1}}), "half_extents_m");
  EXPECT_REFUSED(BoxInVoxels(map, shape::Box{{0.1, nan, 0.1}}), "half_extents_m");
  EXPECT_REFUSED(BoxInVoxels(map, shape::Box{{0.1, 0.1, infinity}}), "half_extents_m");
  for (const double bad : {0.0, -1.0, nan, infinity})
    EXPECT_REFUSED(BoxInVoxels(map, plank, {.tolerance_m = bad}), "tolerance_m");
  const BoxInVoxels body(map, plank);
  Eigen::Isometry3d mirrored = pose(-1, 0, 0);
  mirrored.linear()(0, 0) = -1;
  for (const Eigen::Isometry3d& bad : {mirrored, pose(nan, 0, 0), pose(-1, 0, infinity)}) {
    EXPECT_FALSE(body.is_free(bad));
    EXPECT_FALSE(body.is_free(pose(-1, 0, 0), bad));
    EXPECT_FALSE(body.is_free(bad, pose(-1, 0, 0)));
  }
  EXPECT_TRUE(BoxInVoxels(map, shape::Box{}).is_free(pose(-1, 0, 0)));  // a point
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/planning/a_star.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>
#include <vantage/planning/shortcut.hpp>

#include "drawn_voxels.hpp"
#include "tight_box.hpp"

namespace vantage {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
static_assert(RouterFor<AStar, test::DrawnVoxels> && !RouterFor<AStar, archetype::Voxelled<>>);

double length_m(const std::vector<View>& path) {
  double sum_m = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum_m += distance_m(path[i - 1], path[i]);
  return sum_m;
}
View at(const VoxelGrid& grid, const Eigen::Vector3i& voxel, const Eigen::Vector3d& towards = {1, 0, 0}) {
  return look_at(grid.centre(voxel), grid.centre(voxel) + towards);
}

/// Two rooms of 2 m x 4 m x 2 m and a wall between them with a door at its one end; 25 cm, body of 25 cm.
class TwoRooms : public testing::Test {
 protected:
  VoxelGrid grid = VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 4, 2)}, 0.25);
  test::DrawnVoxels map{grid, 0.25};
  TwoRooms() {
    map.draw_all([&](const Eigen::Vector3i& v) { return v.x() == 8 && v.y() < 11 ? Space::occupied : Space::free; });
  }
};

TEST_F(TwoRooms, ThePathGoesThroughTheDoor) {
  const View from = at(grid, {3, 3, 3}), goal = at(grid, {12, 3, 3}, {0, -1, -0.5});
  const AStar router;
  const std::vector<View> path = router.path(map, from, goal);
  ASSERT_GE(path.size(), 4u);
  EXPECT_EQ(path.front().T_W_C.matrix(), from.T_W_C.matrix());
  EXPECT_EQ(path.back().T_W_C.matrix(), goal.T_W_C.matrix());
  const double stated_m = router.lengths_m(map, from, {&goal, 1}).front();
  EXPECT_NEAR(length_m(path), stated_m, 1e-9);
  // To the door and back: at (8, 12) at least, one voxel away from the wall's end.
  const double half_m = 0.25 * (5 * std::sqrt(2.0) + 4), other_half_m = 0.25 * (4 * std::sqrt(2.0) + 5);
  EXPECT_NEAR(stated_m, half_m + other_half_m, 1e-9);
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    EXPECT_TRUE(map.navigable(grid.voxel_at(path[i].position())));
    EXPECT_NO_THROW(check_view(path[i], "waypoint"));
    // Level, and towards the next waypoint.
    const Eigen::Vector3d leg = path[i + 1].position() - path[i].position();
    EXPECT_NEAR(path[i].forward().z(), 0, 1e-12);
    EXPECT_NEAR(path[i].forward().dot(leg.normalized()), 1, 1e-9);
  }
}

TEST_F(TwoRooms, WhatCannotBeReachedIsInfinitelyFar) {
  const AStar router;
  const View from = at(grid, {3, 3, 3});
  const std::vector<View> goals = {at(grid, {4, 3, 3}), at(grid, {8, 3, 3}), at(grid, {0, 0, 0}),
                                   nadir(9, 1, 1),      nadir(4, 4, 2),      nadir(1e300, 1, 1)};
  const std::vector<double> lengths_m = router.lengths_m(map, from, goals);
  EXPECT_NEAR(lengths_m[0], 0.25, 1e-9);
  EXPECT_EQ(router.path(map, from, goals[0]).size(), 2u);
  for (std::size_t i = 1; i < goals.size(); ++i) {
    EXPECT_EQ(lengths_m[i], infinity) << i;
    EXPECT_TRUE(router.path(map, from, goals[i]).empty()) << i;
  }
  for (const View& start : {nadir(-1, 1, 1), nadir(1e300, 1, 1)})
    for (const double length : router.lengths_m(map, start, goals)) EXPECT_EQ(length, infinity);
  EXPECT_TRUE(router.lengths_m(map, from, {}).empty());
}

TEST_F(TwoRooms, LeavesAVoxelThatTheMapHoldsOccupied) {
  map.draw({4, 3, 3}, Space::occupied);
  const AStar router;
  const View from = at(grid, {4, 3, 3}), goal = at(grid, {2, 3, 3}), before = at(grid, {2, 3, 4});
  const double length_there_m = router.lengths_m(map, from, {&goal, 1}).front();
  EXPECT_GE(length_there_m, 0.5);
  EXPECT_LE(length_there_m, 0.25 * 2 * std::sqrt(2.0) + 1e-9);
  const std::vector<View> path = router.path(map, from, goal);
  ASSERT_GE(path.size(), 2u);
  EXPECT_EQ(path.front().T_W_C.matrix(), from.T_W_C.matrix());
  EXPECT_NEAR(length_m(path), length_there_m, 1e-9);
  for (std::size_t i = 1; i < path.size(); ++i) EXPECT_EQ(map.state(grid.voxel_at(path[i].position())), Space::free);
  // No other voxel that is occupied is open: neither as a goal nor on the way.
  EXPECT_EQ(router.lengths_m(map, before, {&from, 1}).front(), infinity);
  map.draw_all([&](const Eigen::Vector3i& v) {
    return (v - Eigen::Vector3i(4, 3, 3)).cwiseAbs().maxCoeff() <= 1 ? Space::occupied : Space::free;
  });
  const View beside = look_at(from.position() + Eigen::Vector3d(0.1, 0, 0), from.position());
  const std::vector<View> goals = {goal, at(grid, {5, 3, 3}), at(grid, {7, 7, 4}), beside};
  const std::vector<double> lengths_m = router.lengths_m(map, from, goals);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(lengths_m[i], infinity) << i;
    EXPECT_TRUE(router.path(map, from, goals[i]).empty()) << i;
  }
  EXPECT_NEAR(lengths_m[3], 0.1, 1e-12) << "in the robot's own voxel";
}

TEST(AStar, FindsNothingInABoxThatIsSmallerThanTheBody) {
  for (const double length_m : {1.2, 0.1}) {
    const VoxelMap<> map = test::tight_box(length_m, std::min(length_m, 0.4));
    ASSERT_GT(map.counts().free, 0u);
    ASSERT_EQ(map.counts().navigable, 0u);
    const View from = at(map.grid(), {0, 0, 0});
    const std::vector<View> goals = {nadir(0.75, 0.25, 0.25), nadir(1.15, 0.05, 0.05), nadir(-0.05, 0.05, 0.05)};
    const auto expect_nothing = [&](const auto& router) {
      for (const double length : router.lengths_m(map, from, goals)) EXPECT_EQ(length, infinity);
      for (const View& goal : goals) EXPECT_TRUE(router.path(map, from, goal).empty());
      EXPECT_EQ(router.lengths_m(map, from, {&from, 1}).front(), 0);
    };
    expect_nothing(AStar{});
    expect_nothing(Shortcut<AStar>{});
  }
}

TEST_F(TwoRooms, CountsTheWayToAndFromTheCentres) {
  const AStar router;
  const View a = nadir(0.8, 0.9, 1.1), same_voxel = nadir(0.95, 0.76, 1.05), other = nadir(1.6, 0.8, 1.2);
  const std::vector<View> goals = {a, same_voxel, other};
  const std::vector<double> lengths_m = router.lengths_m(map, a, goals);
  EXPECT_EQ(lengths_m[0], 0);
  EXPECT_EQ(lengths_m[1], distance_m(a, same_voxel));
  const Eigen::Vector3d c(0.875, 0.875, 1.125), d(1.625, 0.875, 1.125);
  EXPECT_NEAR(lengths_m[2], (a.position() - c).norm() + 0.75 + (d - other.position()).norm(), 1e-9);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const std::vector<View> path = router.path(map, a, goals[i]);
    ASSERT_GE(path.size(), 2u);
    EXPECT_NEAR(length_m(path), lengths_m[i], 1e-9);
  }
}

TEST_F(TwoRooms, TheRobotLeavesWhereItIs) {
  // It has seen nothing nearer than two voxels: the map knows no way from where it is.
  for (int x = 5; x <= 7; ++x)
    for (int y = 3; y <= 5; ++y)
      for (int z = 3; z <= 5; ++z) map.draw({x, y, z}, Space::unknown);
  const View from = at(grid, {6, 4, 4}), goal = at(grid, {2, 3, 3}), beyond = at(grid, {10, 4, 4});
  EXPECT_EQ(AStar({.own_ball_m = 0}).lengths_m(map, from, {&goal, 1}).front(), infinity);
  EXPECT_EQ(AStar({.own_ball_m = 0.3}).lengths_m(map, from, {&goal, 1}).front(), infinity);
  EXPECT_TRUE(std::isfinite(AStar({.own_ball_m = 0.5}).lengths_m(map, from, {&goal, 1}).front()));
  // Its ball opens no wall.
  EXPECT_GT(AStar({.own_ball_m = 1}).lengths_m(map, from, {&beyond, 1}).front(), 2);
}

TEST_F(TwoRooms, RefusesPosesThatAreNone) {
  const AStar router;
  const View good = at(grid, {3, 3, 3}), bad = nadir(std::numeric_limits<double>::quiet_NaN(), 1, 1);
  EXPECT_THROW(static_cast<void>(router.lengths_m(map, bad, {&good, 1})), Error);
  EXPECT_THROW(static_cast<void>(router.lengths_m(map, good, {&bad, 1})), Error);
  EXPECT_THROW(static_cast<void>(router.path(map, good, bad)), Error);
  EXPECT_THROW(AStar({.own_ball_m = -1}), Error);
  EXPECT_THROW(AStar({.own_ball_m = infinity}), Error);
}

}  // namespace
}  // namespace vantage

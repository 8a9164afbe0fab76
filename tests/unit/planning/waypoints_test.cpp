// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/planning/waypoints.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace vantage {
namespace {

TEST(Waypoints, TheRobotLooksWhereItFliesAndUpAndDownItDoesNotTurn) {
  const View from = look_at({0, 0, 1}, {0, 1, 0}), goal = look_at({2, 1, 2}, {0, 0, 0});
  const std::vector<Eigen::Vector3d> points = {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {1, 0, 3}, {2, 1, 3}, {2, 1, 2}};
  const std::vector<View> views = views_along(points, from, goal);
  ASSERT_EQ(views.size(), points.size());
  EXPECT_EQ(views.front().T_W_C.matrix(), from.T_W_C.matrix());
  EXPECT_EQ(views.back().T_W_C.matrix(), goal.T_W_C.matrix());
  const Eigen::Vector3d diagonal = Eigen::Vector3d(1, 1, 0).normalized();
  const std::vector<Eigen::Vector3d> ahead = {{0, 1, 0}, {1, 0, 0}, diagonal, diagonal};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    EXPECT_NO_THROW(check_view(views[i], "waypoint"));
    EXPECT_EQ(views[i].position(), points[i]);
    EXPECT_TRUE(views[i].forward().isApprox(ahead[i - 1], 1e-12)) << i;
  }
  EXPECT_DOUBLE_EQ(length_m(points), 1 + 1 + 1 + std::sqrt(2.0) + 1);
  EXPECT_EQ(length_m({}), 0);
  EXPECT_EQ(views_along(std::vector{points[0], points[5]}, from, goal).size(), 2u);
}

}  // namespace
}  // namespace vantage

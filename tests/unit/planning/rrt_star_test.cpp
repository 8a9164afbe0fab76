// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/planning/rigid_motion.hpp>
#include <vantage/planning/rrt_star.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/units.hpp>

namespace vantage {
namespace {

Box3 box(double x0, double y0, double z0, double x1, double y1, double z1) {
  return {Eigen::Vector3d(x0, y0, z0), Eigen::Vector3d(x1, y1, z1)};
}
Eigen::Isometry3d pose(double x, double y, double z, double yaw_rad = 0) {
  Eigen::Isometry3d p = Eigen::Isometry3d::Identity();
  p.translation() << x, y, z;
  p.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  return p;
}

/// A plank (its body's axes half as long as `half_m`) among boxes: sampled densely, as obvious as it gets.
struct Plank {
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();
  std::vector<Box3> solids = {};
  [[nodiscard]] bool is_free(const Eigen::Isometry3d& p) const {
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j)
        for (const Box3& s : solids)
          if (s.contains(p * Eigen::Vector3d(half_m.x() * i / 4, half_m.y() * j / 4, 0))) return false;
    return true;
  }
  [[nodiscard]] bool is_free(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
    for (int i = 0; i <= 50; ++i)
      if (!is_free(RigidMotion(a, b).at(i / 50.0))) return false;
    return true;
  }
};

/// The parts of a path, checked.
void expect_valid(const PosePath& path, const Eigen::Isometry3d& start, const Eigen::Isometry3d& goal,
                  const Plank& body, double metres_per_rad) {
  ASSERT_GE(path.poses.size(), 1u);
  EXPECT_TRUE(path.poses.front().isApprox(start, 1e-12));
  EXPECT_TRUE(path.poses.back().isApprox(goal, 1e-12));
  double cost_m = 0;
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    EXPECT_TRUE(body.is_free(path.poses[i - 1], path.poses[i])) << i;
    cost_m += pose_distance_m(path.poses[i - 1], path.poses[i], metres_per_rad);
  }
  EXPECT_NEAR(path.cost_m, cost_m, 1e-9);
}

TEST(RrtStar, TendsToTheShortestWayRoundAWall) {
  // A point in a flat box, which may be without height, as for a robot on the ground; a wall from y = -1 to 1: the
  // shortest way touches one of its ends.
  const Plank body{.solids = {box(-0.1, -1, -1, 0.1, 1, 1)}};
  const Eigen::Isometry3d start = pose(-1.5, 0, 0), goal = pose(1.5, 0, 0);
  const double least_m = 2 * std::hypot(1.4, 1) + 0.2;
  for (const double height_m : {0.1, 0.0}) {
    const UprightPoses space{.bounds = box(-2, -2, -0.5 * height_m, 2, 2, 0.5 * height_m), .metres_per_rad = 0.05};
    double error_few = 0, error_many = 0;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const auto few = RrtStar<>({.space = space, .samples = 500}).plan(start, goal, body, Rng(seed));
      const auto many = RrtStar<>({.space = space, .samples = 5000}).plan(start, goal, body, Rng(seed));
      ASSERT_TRUE(few && many);
      for (const auto& path : {*few, *many}) {
        expect_valid(path, start, goal, body, 0.05);
        EXPECT_GE(path.cost_m, least_m * (1 - 1e-3));  // the wall is sampled
        for (const Eigen::Isometry3d& p : path.poses) EXPECT_LE(2 * std::abs(p.translation().z()), height_m);
      }
      EXPECT_LE(many->cost_m, few->cost_m);  // the same draws, and more
      error_few += few->cost_m / least_m - 1, error_many += many->cost_m / least_m - 1;
    }
    EXPECT_LT(error_few / 5, 0.15);
    EXPECT_LT(error_many / 5, 0.05);
    EXPECT_LT(error_many, error_few);
  }
}

TEST(RrtStar, APlankTurnsToFitThroughAGap) {
  // 1 m long, through a gap of 0.5 m: across it does not fit, lengthwise it does.
  const Plank body{.half_m = {0.5, 0.05, 0},
                   .solids = {box(-0.1, -5, -5, 0.1, -0.25, 5), box(-0.1, 0.25, -5, 0.1, 5, 5)}};
  const Eigen::Isometry3d start = pose(-1.5, 0, 0, deg(90)), goal = pose(1.5, 0, 0, deg(90));
  ASSERT_FALSE(body.is_free(pose(0, 0, 0, deg(90))));
  ASSERT_TRUE(body.is_free(pose(0, 0, 0, 0)));
  const UprightPoses space{.bounds = box(-2, -1.5, -0.1, 2, 1.5, 0.1)};
  const auto path = RrtStar<>({.space = space, .samples = 6000}).plan(start, goal, body, Rng(1));
  ASSERT_TRUE(path);
  expect_valid(*path, start, goal, body, space.metres_per_rad);
  EXPECT_GT(path->cost_m, 3.1);  // it turned
}

TEST(RrtStar, AllRotationsInSpace) {
  // The same plank upright at the start, a slit that lies flat.
  Eigen::Isometry3d start = pose(-1.2, 0, 0), goal = pose(1.2, 0, 0);
  start.rotate(Eigen::AngleAxisd(deg(90), Eigen::Vector3d::UnitX()));
  const Plank body{.half_m = {0.1, 0.5, 0}, .solids = {box(-0.1, -5, 0.3, 0.1, 5, 5), box(-0.1, -5, -5, 0.1, 5, -0.3)}};
  const FreePoses space{.bounds = box(-1.5, -1, -1, 1.5, 1, 1), .metres_per_rad = 0.2};
  const auto path = RrtStar<FreePoses>({.space = space, .samples = 4000}).plan(start, goal, body, Rng(2));
  ASSERT_TRUE(path);
  expect_valid(*path, start, goal, body, 0.2);
}

TEST(RrtStar, NoneWhereThereIsNone) {
  const UprightPoses space{.bounds = box(-2, -2, -0.1, 2, 2, 0.1)};
  const RrtStar<> planner({.space = space, .samples = 1000});
  const Plank wall{.solids = {box(-0.1, -5, -5, 0.1, 5, 5)}};
  EXPECT_FALSE(planner.plan(pose(-1, 0, 0), pose(1, 0, 0), wall, Rng(1)));
  EXPECT_FALSE(planner.plan(pose(0, 0, 0), pose(1, 0, 0), wall, Rng(1)));  // the start is in the wall
  EXPECT_FALSE(planner.plan(pose(1, 0, 0), pose(0, 0, 0), wall, Rng(1)));
  EXPECT_TRUE(planner.plan(pose(1, 0, 0), pose(1, 1, 0), wall, Rng(1)));
}

TEST(RrtStar, StraightWhereNothingIsInTheWay) {
  const UprightPoses space{.bounds = box(-2, -2, -2, 2, 2, 2)};
  const auto path = RrtStar<>({.space = space, .samples = 10}).plan(pose(0, 0, 0), pose(0.5, 0, 0, 1), Plank{}, Rng(1));
  ASSERT_TRUE(path);
  EXPECT_EQ(path->poses.size(), 2u);
  EXPECT_NEAR(path->cost_m, std::hypot(0.5, 0.3), 1e-12);
  const auto nowhere = RrtStar<>({.space = space}).plan(pose(1, 0, 0), pose(1, 0, 0), Plank{}, Rng(1));
  ASSERT_TRUE(nowhere);
  EXPECT_EQ(nowhere->cost_m, 0);
}

TEST(RrtStar, TheSameSeedTheSamePath) {
  const Plank body{.solids = {box(-0.1, -1, -1, 0.1, 1, 1)}};
  const RrtStar<> planner({.space = {.bounds = box(-2, -2, -1, 2, 2, 1)}, .samples = 800});
  const auto plan = [&](std::uint64_t seed) { return planner.plan(pose(-1, 0, 0), pose(1, 0, 0), body, Rng(seed)); };
  const auto a = plan(3), b = plan(3), c = plan(4);
  ASSERT_TRUE(a && b && c);
  ASSERT_EQ(a->poses.size(), b->poses.size());
  for (std::size_t i = 0; i < a->poses.size(); ++i) EXPECT_EQ(a->poses[i].matrix(), b->poses[i].matrix());
  EXPECT_EQ(a->cost_m, b->cost_m);
  EXPECT_NE(a->cost_m, c->cost_m);
}

TEST(RrtStar, RefusesBadInput) {
  const UprightPoses space{.bounds = box(-2, -2, -2, 2, 2, 2)};
  EXPECT_THROW(RrtStar<>({.space = space, .samples = 0}), Error);
  EXPECT_THROW(RrtStar<>({.space = space, .step_m = 0}), Error);
  EXPECT_THROW(RrtStar<>({.space = space, .goal_bias = 1}), Error);
  EXPECT_THROW(RrtStar<>({.space = {.bounds = Box3()}}), Error);
  EXPECT_THROW(RrtStar<FreePoses>({.space = {.bounds = space.bounds, .metres_per_rad = 0}}), Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(RrtStar<>({.space = space}).plan(pose(nan, 0, 0), pose(0, 0, 0), Plank{}, Rng(1))),
               Error);
  EXPECT_THROW(static_cast<void>(RrtStar<>({.space = space}).plan(pose(0, 0, 0), pose(nan, 0, 0), Plank{}, Rng(1))),
               Error);
}

TEST(Poses, AFlatSpaceHasFewerDimensions) {
  constexpr double turns = 2 * std::numbers::pi, rotations = 8 * std::numbers::pi * std::numbers::pi;
  const auto upright = [](const Box3& bounds) { return UprightPoses{.bounds = bounds, .metres_per_rad = 0.5}; };
  const auto free = [](const Box3& bounds) { return FreePoses{.bounds = bounds, .metres_per_rad = 0.5}; };
  EXPECT_EQ(upright(box(0, 0, 0, 1, 2, 3)).dimension(), 4);
  EXPECT_NEAR(upright(box(0, 0, 0, 1, 2, 3)).volume(), 6 * 0.5 * turns, 1e-9);
  EXPECT_EQ(free(box(0, 0, 0, 1, 2, 3)).dimension(), 6);
  EXPECT_NEAR(free(box(0, 0, 0, 1, 2, 3)).volume(), 6 * 0.125 * rotations, 1e-9);
  EXPECT_EQ(upright(box(0, 0, 3, 1, 2, 3)).dimension(), 3);
  EXPECT_NEAR(upright(box(0, 0, 3, 1, 2, 3)).volume(), 2 * 0.5 * turns, 1e-9);
  EXPECT_EQ(free(box(1, 0, 3, 1, 2, 3)).dimension(), 4);
  EXPECT_NEAR(free(box(1, 0, 3, 1, 2, 3)).volume(), 2 * 0.125 * rotations, 1e-9);
  EXPECT_EQ(upright(box(1, 2, 3, 1, 2, 3)).dimension(), 1);  // it turns in one place
  EXPECT_NEAR(upright(box(1, 2, 3, 1, 2, 3)).volume(), 0.5 * turns, 1e-9);
}

TEST(Poses, DrawsAreUniformAndBetweenIsHalfWay) {
  const FreePoses free{.bounds = box(0, 0, 0, 1, 2, 3)};
  const UprightPoses upright{.bounds = free.bounds};
  Rng rng(1);
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  double turn = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Isometry3d p = free.draw(rng), q = upright.draw(rng);
    EXPECT_NO_THROW(check_view({p}, "draw"));
    EXPECT_TRUE(free.bounds.contains(p.translation()) && free.bounds.contains(q.translation()));
    EXPECT_TRUE(q.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
    mean += p.linear() / 20'000;
    turn += turn_rad(Eigen::Isometry3d::Identity(), p) / 20'000;
    const Eigen::Isometry3d middle = RigidMotion(p, q).at(0.5);
    EXPECT_NEAR(pose_distance_m(p, middle, 0.3), 0.5 * pose_distance_m(p, q, 0.3), 1e-9);
    EXPECT_NEAR(pose_distance_m(middle, q, 0.3), 0.5 * pose_distance_m(p, q, 0.3), 1e-9);
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 0.02);
  EXPECT_NEAR(turn, std::numbers::pi / 2 + 2 / std::numbers::pi, 0.02);  // of a uniform rotation
}

}  // namespace
}  // namespace vantage

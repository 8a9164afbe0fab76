// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/planning/rrt_star.hpp>
#include <vantage/planning/voxel_collision.hpp>

#include "drawn_voxels.hpp"
#include "message_of.hpp"
#include "random_pose.hpp"
#include "tight_box.hpp"

namespace vantage {
namespace {

using test::DrawnVoxels;

// Voxels that are no cubes, a grid that ends within its blocks, and more or less in it.
DrawnVoxels random_map(Rng& rng, double unknown, double occupied) {
  DrawnVoxels map(VoxelGrid::dividing(Box3(Eigen::Vector3d(-2, -1.5, -1), Eigen::Vector3d(2, 1.5, 1.1)), 0.21), 0.3);
  map.draw_all([&](const Eigen::Vector3i&) {
    const double u = rng.uniform();
    return u < unknown ? Space::unknown : u < unknown + occupied ? Space::occupied : Space::free;
  });
  return map;
}
// Free but for one voxel, with a border of three blocks.
const Eigen::Vector3i the_voxel(12, 12, 12);
DrawnVoxels map_with_one(Space space) {
  DrawnVoxels map(VoxelGrid::on_lattice(Box3(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(2.5)), 0.1), 0.3);
  map.draw_all([&](const Eigen::Vector3i& v) { return v == the_voxel ? space : Space::free; });
  return map;
}

// Slow and obvious: asks every voxel, and whether the body leaves the grid.
template <class MeetsVoxel>
bool brute_force(const DrawnVoxels& map, const Box3& bounds, bool only_occupied, MeetsVoxel meets) {
  if (!only_occupied && !map.bounds().contains(bounds)) return true;
  for (int z = 0; z < map.grid().size().z(); ++z)
    for (int y = 0; y < map.grid().size().y(); ++y)
      for (int x = 0; x < map.grid().size().x(); ++x) {
        const Space space = map.state({x, y, z});
        if (only_occupied ? space != Space::occupied : space == Space::free) continue;
        if (meets(map.grid().box_of({x, y, z}))) return true;
      }
  return false;
}

// The distance of a convex body to a box, by alternating projections: slow to converge, but from above.
bool boxes_meet(const OrientedBox& a, const Box3& b, double slack) {
  Eigen::Vector3d p = b.center();
  double d = 0;
  for (int i = 0; i < 3000; ++i) {
    Eigen::Vector3d q = a.pose.inverse() * p;
    q = a.pose * q.cwiseMax(-a.half_extents_m).cwiseMin(a.half_extents_m);
    p = q.cwiseMax(b.min()).cwiseMin(b.max());
    d = (p - q).norm();
    if (d <= slack) return true;
  }
  return false;
}

template <class Body, class MeetsVoxel>
void expect_as_by_brute_force(const DrawnVoxels& map, const Body& body, MeetsVoxel meets, int& met, int& free) {
  const bool any = brute_force(map, body.bounds(), false, meets);
  EXPECT_EQ(collides(map, body), any);
  EXPECT_EQ(collides(map, body, obstacle::Occupied{}), brute_force(map, body.bounds(), true, meets));
  ++(any ? met : free);
}

TEST(VoxelCollision, BallsAsByBruteForce) {
  Rng rng(1);
  int met = 0, free = 0;
  for (int k = 0; k < 20; ++k) {
    const DrawnVoxels map = random_map(rng, 0.01, 0.01);
    for (int i = 0; i < 100; ++i) {
      const Ball ball{test::random_point(rng, 1.7), i % 10 == 0 ? 0 : rng.uniform(0, 0.6)};
      expect_as_by_brute_force(
          map, ball, [&](const Box3& voxel) { return voxel.exteriorDistance(ball.centre) <= ball.radius_m; }, met,
          free);
    }
  }
  EXPECT_GT(met, 300);
  EXPECT_GT(free, 300);
}

TEST(VoxelCollision, SweptBallsAsByBruteForce) {
  Rng rng(2);
  int met = 0, free = 0;
  for (int k = 0; k < 10; ++k) {
    const DrawnVoxels map = random_map(rng, 0.002, 0.002);
    for (int i = 0; i < 100; ++i) {
      const SweptBall ball{test::random_point(rng, 1), test::random_point(rng, 1), rng.uniform(0, 0.3)};
      expect_as_by_brute_force(
          map, ball,
          [&](const Box3& voxel) {
            return squared_distance(voxel, ball.from, ball.to) <= ball.radius_m * ball.radius_m;
          },
          met, free);
    }
  }
  EXPECT_GT(met, 200);
  EXPECT_GT(free, 200);
}

TEST(VoxelCollision, BoxesAsByBruteForce) {
  Rng rng(3);
  int met = 0, free = 0;
  for (int k = 0; k < 4; ++k) {
    const DrawnVoxels map = random_map(rng, 0.003, 0.003);
    for (int i = 0; i < 60; ++i) {
      OrientedBox box{test::random_pose(rng, 0.9), test::random_point(rng, 0.4).cwiseAbs()};
      if (i % 6 == 0) box.pose.linear().setIdentity();  // edges that are parallel
      if (i % 7 == 0) box.half_extents_m.z() = 0;
      expect_as_by_brute_force(
          map, box, [&](const Box3& voxel) { return boxes_meet(box, voxel, 1e-7); }, met, free);
    }
  }
  EXPECT_GT(met, 50);
  EXPECT_GT(free, 50);
}

TEST(VoxelCollision, TouchingCountsAndABitLessDoesNot) {
  for (const Space space : {Space::occupied, Space::unknown}) {
    const DrawnVoxels map = map_with_one(space);
    const Box3 voxel = map.grid().box_of(the_voxel);
    const Eigen::Vector3d face = voxel.center() - Eigen::Vector3d(0.05 + 0.25, 0, 0), corner = voxel.min();
    const auto diagonal = [&](double away) -> Eigen::Vector3d {
      return corner - Eigen::Vector3d::Constant(away / std::sqrt(3.0));
    };
    EXPECT_TRUE(collides(map, Ball{face, 0.25 + 1e-9}));
    EXPECT_FALSE(collides(map, Ball{face, 0.25 - 1e-9}));
    EXPECT_TRUE(collides(map, Ball{diagonal(0.25), 0.25 + 1e-9}));
    EXPECT_FALSE(collides(map, Ball{diagonal(0.25), 0.25 - 1e-9}));
    const Eigen::Vector3d up(0, 0, 0.9);
    EXPECT_TRUE(collides(map, SweptBall{face - up, face + up, 0.25 + 1e-9}));
    EXPECT_FALSE(collides(map, SweptBall{face - up, face + up, 0.25 - 1e-9}));
    OrientedBox box{Eigen::Isometry3d::Identity(), {0.25, 0.1, 0.1}};
    box.pose.translation() = face;
    EXPECT_FALSE(collides(map, OrientedBox{box.pose, Eigen::Vector3d(0.25 - 1e-9, 0.1, 0.1)}));
    EXPECT_TRUE(collides(map, OrientedBox{box.pose, Eigen::Vector3d(0.25 + 1e-9, 0.1, 0.1)}));
    EXPECT_EQ(collides(map, Ball{voxel.center(), 0}, obstacle::Occupied{}), space == Space::occupied);
  }
}

TEST(VoxelCollision, BeyondTheGridIsNotFreeAndNotOccupied) {
  const DrawnVoxels map = map_with_one(Space::free);
  EXPECT_FALSE(collides(map, Ball{{1, 1, 0.3}, 0.29}));
  EXPECT_TRUE(collides(map, Ball{{1, 1, 0.3}, 0.31}));
  EXPECT_FALSE(collides(map, Ball{{1, 1, 0.3}, 0.31}, obstacle::Occupied{}));
  for (const Eigen::Vector3d& far : {Eigen::Vector3d(1e12, 0, 0), Eigen::Vector3d(-1e300, 1, 1)}) {
    EXPECT_TRUE(collides(map, Ball{far, 0.1}));
    EXPECT_FALSE(collides(map, Ball{far, 0.1}, obstacle::Occupied{}));
  }
}

// Nothing throws, hangs or is free.
TEST(VoxelCollision, WhatIsNoBodyCollides) {
  const DrawnVoxels map = map_with_one(Space::free);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d good(1, 1, 1);
  for (const double bad : {nan, inf, -inf, 1e308}) {
    for (int i = 0; i < 3; ++i) {
      Eigen::Vector3d p = good;
      p[i] = bad;
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() = p;
      EXPECT_TRUE(collides(map, Ball{p, 0.1}));
      EXPECT_TRUE(collides(map, SweptBall{p, good, 0.1}));
      EXPECT_TRUE(collides(map, SweptBall{good, p, 0.1}));
      EXPECT_TRUE(collides(map, OrientedBox{pose, {0.1, 0.1, 0.1}}));
      EXPECT_TRUE(collides(map, OrientedBox{Eigen::Isometry3d(Eigen::Translation3d(good)), p - good}));
      EXPECT_TRUE(
          collides_on_way(map, OrientedBox{Eigen::Isometry3d(Eigen::Translation3d(good)), 0.1 * good}, pose, 0.01));
    }
    EXPECT_TRUE(collides(map, Ball{good, bad}));
  }
  EXPECT_TRUE(collides(map, Ball{good, -0.1}));
  EXPECT_TRUE(collides(map, Ball{good, nan}, obstacle::Occupied{}));
  OrientedBox sheared{Eigen::Isometry3d::Identity(), {0.1, 0.1, 0.1}};
  sheared.pose.linear()(0, 1) = 0.5;
  sheared.pose.translation() = good;
  EXPECT_TRUE(collides(map, sheared));
  EXPECT_REFUSED(collides_on_way(map, OrientedBox{Eigen::Isometry3d::Identity(), good}, sheared.pose, 0.0),
                 "tolerance_m");
}

TEST(VoxelCollision, ABoxOnItsWayMissesNothing) {
  Rng rng(4);
  constexpr double tolerance_m = 0.01;
  int met = 0, free = 0, in_doubt = 0;
  for (int k = 0; k < 10; ++k) {
    const DrawnVoxels map = random_map(rng, 0.001, 0.001);
    for (int i = 0; i < 60; ++i) {
      const OrientedBox from{test::random_pose(rng, 0.8), test::random_point(rng, 0.15).cwiseAbs()};
      const Eigen::Isometry3d to = test::random_pose(rng, 0.8);
      const RigidMotion motion(from.pose, to);
      bool sampled = false, near = false;
      const double grown_m = 2 * std::sqrt(3.0) * tolerance_m;
      for (int s = 0; s <= 300; ++s) {
        const OrientedBox box{motion.at(s / 300.0), from.half_extents_m};
        sampled = sampled || collides(map, box);
        near = near || collides(map, OrientedBox{box.pose, box.half_extents_m.array() + grown_m});
      }
      const bool answer = collides_on_way(map, from, to, tolerance_m);
      EXPECT_TRUE(answer || !sampled);
      EXPECT_TRUE(!answer || near);
      ++(sampled ? met : !near ? free : in_doubt);
    }
  }
  EXPECT_GT(met, 30);
  EXPECT_GT(free, 100);
  EXPECT_LT(in_doubt, 150);
}

TEST(VoxelCollision, NowhereFreeInABoxThatIsSmallerThanTheBody) {
  const VoxelMap<> map = test::tight_box();
  const double r = map.clearance_m();
  const auto at = [](const Eigen::Vector3d& p) { return Eigen::Isometry3d(Eigen::Translation3d(p)); };
  for (int x = 0; x < map.grid().size().x(); ++x) {
    const Eigen::Vector3d p = map.grid().centre({x, 2, 2});
    EXPECT_TRUE(collides(map, Ball{p, r}));
    EXPECT_TRUE(collides(map, OrientedBox{at(p), Eigen::Vector3d::Constant(r)}));
    EXPECT_EQ(collides(map, Ball{p, 0.04}), x >= 8) << "but for what is smaller";
    EXPECT_FALSE(collides(map, Ball{p, r}, obstacle::Occupied{})) << "nothing is there";
  }
  // A planner for bodies finds no way, not even to where it is.
  const struct {
    const VoxelMap<>& map;
    double half_m;
    [[nodiscard]] bool is_free(const Eigen::Isometry3d& pose) const {
      return !collides(map, OrientedBox{pose, Eigen::Vector3d::Constant(half_m)});
    }
    [[nodiscard]] bool is_free(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
      return !collides_on_way(map, {a, Eigen::Vector3d::Constant(half_m)}, b, 0.01);
    }
  } large{map, r}, small{map, 0.05};
  const RrtStar<> planner({.space = {.bounds = map.bounds()}, .samples = 200});
  const Eigen::Isometry3d from = at({0.15, 0.15, 0.15}), to = at({0.65, 0.25, 0.25});
  EXPECT_FALSE(planner.plan(from, to, large, Rng(1)));
  EXPECT_FALSE(planner.plan(from, from, large, Rng(1)));
  EXPECT_TRUE(planner.plan(from, to, small, Rng(1)));
}

TEST(VoxelCollision, TheSameFromAllThreads) {
  Rng rng(5);
  const DrawnVoxels map = random_map(rng, 0.01, 0.01);
  std::vector<Ball> balls;
  for (int i = 0; i < 1000; ++i) balls.push_back({test::random_point(rng, 1.5), 0.3});
  std::vector<std::uint8_t> answers(balls.size());
  parallel_for(balls.size(), [&](std::size_t i) { answers[i] = collides(map, balls[i]) ? 1 : 0; });
  for (std::size_t i = 0; i < balls.size(); ++i) EXPECT_EQ(answers[i] != 0, collides(map, balls[i]));
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/planning/collision.hpp>
#include <vantage/planning/rrt_star.hpp>

#include "collision_scenes.hpp"
#include "random_pose.hpp"

namespace vantage {
namespace {

using namespace test;  // scenes and shapes
using Verdict = CollisionVerdict;

TriangleMesh soup(Rng& rng, int triangles, double reach, double size) {
  TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Eigen::Vector3d p = test::random_point(rng, reach);
    add_triangle(mesh, p, p + test::random_point(rng, size), p + test::random_point(rng, size));
  }
  return mesh;
}

// Slow and obvious: the least distance between points of two triangles, by alternating projections.
Eigen::Vector3d nearest_on_triangle(const std::array<Eigen::Vector3d, 3>& t, const Eigen::Vector3d& p) {
  const Eigen::Vector3d u = t[1] - t[0], v = t[2] - t[0], n = u.cross(v);
  const Eigen::Vector3d w = p - t[0];
  const double area = n.squaredNorm(), b = w.cross(v).dot(n) / area, c = u.cross(w).dot(n) / area;
  if (b >= 0 && c >= 0 && b + c <= 1) return t[0] + b * u + c * v;
  Eigen::Vector3d best = t[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d a = t[k], e = t[(k + 1) % 3] - a;
    const Eigen::Vector3d q = a + std::clamp((p - a).dot(e) / e.squaredNorm(), 0.0, 1.0) * e;
    if ((q - p).norm() < (best - p).norm()) best = q;
  }
  return best;
}
double point_distance(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    least = std::min(least, (nearest_on_triangle(mesh.corners(i), p) - p).norm());
  return least;
}
using Triangle3 = std::array<Eigen::Vector3d, 3>;
double triangle_distance(const Triangle3& a, const Triangle3& b) {
  Eigen::Vector3d p = (b[0] + b[1] + b[2]) / 3;
  double d = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d q = nearest_on_triangle(a, p);
    p = nearest_on_triangle(b, q);
    if (const double next = (p - q).norm(); i > 0 && d - next < 1e-13)
      return next;
    else
      d = next;
  }
  return d;
}
// Of a box, from its centre.
bool holds(const Eigen::Vector3d& half, const Eigen::Vector3d& p) {
  return (p.cwiseAbs().array() <= half.array()).all();
}

TEST(Collision, ClearanceAboveTheGround) {
  const CollisionScene scene(ground());
  for (const RobotShape& shape : shapes_of_half_a_metre()) {
    const CollisionChecker checker(scene, shape);
    for (const double z : {0.5001, 0.6, 1.0, 5.0}) {
      const CollisionCheck c = checker.check(at(1, 2, z));
      EXPECT_TRUE(c.free());
      EXPECT_NEAR(c.clearance_m, z - 0.5, 1e-6);
    }
    for (const double z : {0.4999, 0.2, 0.0, -0.3}) {
      EXPECT_EQ(checker.check(at(1, 2, z)).verdict, Verdict::contact) << z;
      EXPECT_EQ(checker.check(at(1, 2, z)).clearance_m, 0);
    }
    EXPECT_TRUE(checker.check(at(1, 2, -0.6)).free());  // a surface, not a half space
  }
}

TEST(Collision, ATurnedBoxReachesFarther) {
  const CollisionChecker checker(CollisionScene(ground()), shape::Box{{0.5, 0.5, 0.5}});
  Eigen::Isometry3d pose = at(0, 0, 0.6);
  EXPECT_TRUE(checker.check(pose).free());
  pose.rotate(Eigen::AngleAxisd(0.25 * M_PI, Eigen::Vector3d::UnitX()));
  EXPECT_EQ(checker.check(pose).verdict, Verdict::contact);
  pose.translation().z() = 1;
  EXPECT_NEAR(checker.check(pose).clearance_m, 1 - std::sqrt(0.5), 1e-9);
}

TEST(Collision, SpheresAsByBruteForce) {
  Rng rng(1);
  const TriangleMesh mesh = soup(rng, 60, 2, 0.5);
  const CollisionScene scene(mesh);
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const double radius_m = i % 4 == 0 ? 0 : rng.uniform(0, 0.5);
    const Eigen::Vector3d p = test::random_point(rng, 2.5);
    const double clearance_m = point_distance(mesh, p) - radius_m;
    const CollisionCheck c = CollisionChecker(scene, shape::Sphere{radius_m}).check(at(p.x(), p.y(), p.z()));
    EXPECT_EQ(c.free(), clearance_m > 0);
    EXPECT_NEAR(c.clearance_m, std::max(clearance_m, 0.0), 1e-7);
    met += c.free() ? 0 : 1;
  }
  EXPECT_GT(met, 30);
  EXPECT_LT(met, 370);
}

TEST(Collision, ConvexBodiesAndMeshesAsByBruteForce) {
  Rng rng(2);
  const TriangleMesh mesh = soup(rng, 40, 2, 0.5);
  const CollisionScene scene(mesh);
  int met = 0;
  for (int i = 0; i < 150; ++i) {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.05) + test::random_point(rng, 0.25).cwiseAbs();
    const Eigen::Isometry3d pose = test::random_pose(rng, 2);
    const auto corners = corners_of(half);
    const TriangleMesh surface = surface_of(convex_hull(corners));
    double surfaces_m = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      inside = inside || holds(half, pose.inverse() * mesh.corners(k)[0]);
      for (std::size_t j = 0; j < surface.triangles.size(); ++j) {
        Triangle3 t = surface.corners(j);
        for (Eigen::Vector3d& p : t) p = pose * p;
        surfaces_m = std::min(surfaces_m, triangle_distance(mesh.corners(k), t));
      }
    }
    const auto expect = [&](const RobotShape& shape, bool meets) {
      const CollisionCheck c = CollisionChecker(scene, shape).check(pose);
      EXPECT_EQ(c.verdict, meets ? Verdict::contact : Verdict::free);
      EXPECT_NEAR(c.clearance_m, meets ? 0 : surfaces_m, 1e-3);  // the reference converges slowly
    };
    if (surfaces_m > 1e-7 && surfaces_m < 1e-3) continue;  // and does not tell these apart
    expect(shape::Box{half}, surfaces_m < 1e-7 || inside);
    expect(shape::Convex{corners}, surfaces_m < 1e-7 || inside);
    expect(shape::Mesh{surface}, surfaces_m < 1e-7);
    met += surfaces_m < 1e-7 || inside ? 1 : 0;
  }
  EXPECT_GT(met, 5);
  EXPECT_LT(met, 120);
}

TEST(Collision, WhatASolidHoldsItMeets) {
  TriangleMesh speck;
  add_triangle(speck, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1});
  const CollisionScene scene(speck);
  const auto shapes = shapes_of_half_a_metre();
  for (std::size_t i = 0; i < 3; ++i) {
    const CollisionChecker checker(scene, shapes[i]);
    EXPECT_EQ(checker.check(at(0, 0, 0)).verdict, Verdict::contact);
    EXPECT_EQ(checker.check(at(0, 0, 0), at(0.1, 0, 0)).verdict, Verdict::contact);
  }
  EXPECT_TRUE(CollisionChecker(scene, shapes[3]).check(at(0, 0, 0)).free());  // a surface, as documented
}

TEST(Collision, AMotionThroughAWallIsFoundHoweverThinTheRobot) {
  TriangleMesh wall;
  add_triangle(wall, {1, -5, -5}, {1, 5, -5}, {1, 0, 5});
  const CollisionScene scene(wall);
  std::vector<RobotShape> shapes = shapes_of_half_a_metre();
  shapes.emplace_back(shape::Sphere{0});
  shapes.emplace_back(shape::Box{Eigen::Vector3d::Zero()});
  for (const RobotShape& shape : shapes) {
    const CollisionChecker checker(scene, shape);
    ASSERT_TRUE(checker.check(at(0, 0, 0)).free());
    ASSERT_TRUE(checker.check(at(7.3, 0, 0)).free());
    const CollisionCheck c = checker.check(at(0, 0, 0), at(7.3, 0, 0));
    EXPECT_EQ(c.verdict, Verdict::contact);
    EXPECT_NEAR(7.3 * c.at, 1, 0.51);
    EXPECT_TRUE(checker.check(at(0, 0, 0), at(0.3, 1, 0)).free());
  }
}

TEST(Collision, ATurnIsPartOfTheMotion) {
  TriangleMesh pole;
  add_triangle(pole, {0.8, 0.8, -1}, {0.82, 0.8, -1}, {0.8, 0.8, 1});
  const CollisionChecker checker(CollisionScene(pole), shape::Box{{1.3, 0.1, 0.1}});
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.rotate(Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(checker.check(Eigen::Isometry3d::Identity()).free());
  EXPECT_TRUE(checker.check(turned).free());
  const CollisionCheck c = checker.check(Eigen::Isometry3d::Identity(), turned);
  EXPECT_EQ(c.verdict, Verdict::contact);
  EXPECT_NEAR(c.at, 0.5, 0.1);
}

TEST(Collision, MotionsAgreeWithManySamples) {
  Rng rng(3);
  const TriangleMesh mesh = soup(rng, 40, 3, 0.4);
  const CollisionScene scene(mesh);
  int met = 0, free = 0;
  for (const RobotShape& shape : {RobotShape(shape::Sphere{0.2}), RobotShape(shape::Box{{0.3, 0.1, 0.2}}),
                                  RobotShape(shape::Mesh{surface_of(convex_hull(corners_of({0.1, 0.2, 0.3})))})}) {
    const CollisionChecker checker(scene, shape);
    for (int i = 0; i < 60; ++i) {
      const Eigen::Isometry3d from = test::random_pose(rng, 2.5), to = test::random_pose(rng, 2.5);
      const RigidMotion motion(from, to);
      double least = std::numeric_limits<double>::infinity();
      bool meets = false;
      for (int k = 0; k <= 400 && !meets; ++k) {
        const CollisionCheck c = checker.check(motion.at(k / 400.0));
        meets = !c.free();
        least = std::min(least, c.clearance_m);
      }
      const CollisionCheck c = checker.check(from, to);
      if (meets) {
        EXPECT_EQ(c.verdict, Verdict::contact);
        EXPECT_EQ(c.clearance_m, 0);
        ++met;
      } else if (c.free()) {
        EXPECT_LE(c.clearance_m, least + 1e-9);
        EXPECT_GE(c.clearance_m, 0.9 * (least - motion.way_m(0.4) / 800) - 1e-3);
        EXPECT_LE(checker.check(motion.at(c.at)).clearance_m, c.clearance_m / 0.9 + 1e-3);
        ++free;
      } else {
        EXPECT_LT(least, motion.way_m(0.4) / 800 + 1e-3);
      }
    }
  }
  EXPECT_GT(met, 30);
  EXPECT_GT(free, 30);
}

TEST(Collision, AMotionThatStaysIsItsPose) {
  const CollisionChecker checker(CollisionScene(ground()), shape::Sphere{0.5});
  const CollisionCheck c = checker.check(at(0, 0, 1), at(0, 0, 1));
  EXPECT_TRUE(c.free());
  EXPECT_NEAR(c.clearance_m, 0.5, 1e-9);
  EXPECT_FALSE(checker.check(at(0, 0, 0.1), at(0, 0, 0.1)).free());
}

TEST(Collision, APathNamesItsFirstSegmentInCollision) {
  const CollisionChecker checker(CollisionScene(ground()), shape::Sphere{0.5});
  const auto path = [](std::initializer_list<double> heights) {
    std::vector<View> views;
    double x = 0;
    for (const double z : heights) views.push_back({at(x += 1, 0, z)});
    return views;
  };
  const PathCheck free = checker.check(path({2, 1, 0.8, 1, 3}));
  EXPECT_TRUE(free.free());
  EXPECT_NEAR(free.clearance_m, 0.3, 0.031);
  EXPECT_LE(free.clearance_m, 0.3 + 1e-9);
  EXPECT_TRUE(free.segment == 1 || free.segment == 2);
  const PathCheck met = checker.check(path({2, 1, 1, 0.2, 3, 0.1}));
  EXPECT_EQ(met.verdict, Verdict::contact);
  EXPECT_EQ(met.segment, 2U);
  EXPECT_EQ(checker.check(path({2, 1, -1})).segment, 1U);  // through it
  EXPECT_EQ(checker.check(path({0.2})).verdict, Verdict::contact);
  EXPECT_NEAR(checker.check(path({2})).clearance_m, 1.5, 1e-9);
  EXPECT_TRUE(std::isinf(checker.check(Views{}).clearance_m));
  EXPECT_TRUE(checker.check(Views{}).free());
  auto nan = path({2, 2, 2, 2});
  nan[2].T_W_C.translation().y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(checker.check(nan).verdict, Verdict::bad_pose);
  EXPECT_EQ(checker.check(nan).segment, 1U);
}

TEST(Collision, RrtStarTakesAPlankThroughASlit) {
  TriangleMesh wall;
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector3d low(0, 0.3 * side, -4), high(0, 0.3 * side, 4), far_low(0, 4 * side, -4),
        far_high(0, 4 * side, 4);
    add_triangle(wall, low, far_low, high);
    add_triangle(wall, far_low, far_high, high);
  }
  const CollisionChecker plank(CollisionScene(wall), shape::Box{{0.05, 0.6, 0.05}});
  static_assert(CollisionFree<CollisionChecker>);
  const RrtStar<UprightPoses> planner(
      {.space = {.bounds = {Eigen::Vector3d(-2, -1, -0.5), Eigen::Vector3d(2, 1, 0.5)}}, .samples = 400});
  EXPECT_FALSE(plank.is_free(at(-1, 0, 0), at(1, 0, 0)));  // straight on it would hit both sides
  const auto path = planner.plan(at(-1, 0, 0), at(1, 0, 0), plank, Rng(3));
  ASSERT_TRUE(path);
  ASSERT_GE(path->poses.size(), 3U);
  for (std::size_t i = 1; i < path->poses.size(); ++i)
    EXPECT_TRUE(plank.is_free(path->poses[i - 1], path->poses[i])) << i;
}

TEST(Collision, TheSameFromAllThreads) {
  Rng rng(4);
  const CollisionScene scene(soup(rng, 200, 3, 0.4));
  for (const RobotShape& shape : shapes_of_half_a_metre()) {
    const CollisionChecker checker(scene, shape);
    std::vector<Eigen::Isometry3d> poses;
    for (int i = 0; i < 200; ++i) poses.push_back(test::random_pose(rng, 3));
    std::vector<CollisionCheck> at_once(poses.size());
    parallel_for(poses.size(), [&](std::size_t i) { at_once[i] = checker.check(poses[i]); });
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const CollisionCheck alone = checker.check(poses[i]);
      EXPECT_EQ(alone.verdict, at_once[i].verdict);
      EXPECT_EQ(alone.clearance_m, at_once[i].clearance_m);
    }
  }
}

TEST(Collision, VerdictsHaveNames) {
  EXPECT_EQ(to_string(Verdict::free), "free");
  EXPECT_EQ(to_string(Verdict::unresolved), "unresolved");
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <new>
#include <stdexcept>
#include <variant>
#include <vector>

#include <vantage/planning/collision.hpp>

#include "collision_scenes.hpp"
#include "message_of.hpp"

// What is known to go wrong in FCL 0.7: nothing hangs, throws or is free.
namespace vantage {
namespace {

using namespace test;  // scenes and shapes
using Verdict = CollisionVerdict;

TEST(CollisionHazard, BadPosesAreInCollision) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const RobotShape& shape : shapes_of_half_a_metre()) {
    const CollisionChecker checker(CollisionScene(ground()), shape);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        for (const double bad : {nan, inf, -inf, 1e300, 1e7}) {
          Eigen::Isometry3d pose = at(0, 0, 5);
          pose.matrix()(row, column) = bad;
          EXPECT_EQ(checker.check(pose).verdict, Verdict::bad_pose);
          EXPECT_EQ(checker.check(at(0, 0, 5), pose).verdict, Verdict::bad_pose);
          EXPECT_EQ(checker.check(pose, at(0, 0, 5)).verdict, Verdict::bad_pose);
        }
    Eigen::Isometry3d mirrored = at(0, 0, 5);
    mirrored.linear()(0, 0) = -1;
    EXPECT_EQ(checker.check(mirrored).verdict, Verdict::bad_pose);
    mirrored.linear().setZero();
    EXPECT_EQ(checker.check(mirrored).verdict, Verdict::bad_pose);
  }
}

TEST(CollisionHazard, BoxesFarApartAreMeasured) {
  TriangleMesh box = surface_of(convex_hull(corners_of({0.03, 0.12, 0.1})));
  const CollisionScene scene(box);
  for (const double away : {10.0, 1e3, 1e5, 9e5}) {
    const CollisionCheck c = CollisionChecker(scene, shape::Box{{0.025, 0.35, 1.8}}).check(at(away, 0, 0));
    EXPECT_TRUE(c.free());
    EXPECT_NEAR(c.clearance_m, away - 0.055, 1e-6);
  }
}

TEST(CollisionHazard, HugeCoordinates) {
  TriangleMesh far = ground();
  for (Eigen::Vector3f& v : far.vertices) v.x() += 9e5F;
  const CollisionChecker checker(CollisionScene(far), shape::Box{{0.5, 0.5, 0.5}});
  EXPECT_NEAR(checker.check(at(9e5, 0, 1)).clearance_m, 0.5, 1e-6);
  EXPECT_FALSE(checker.check(at(9e5, 0, 0.4)).free());
  EXPECT_FALSE(checker.check(at(9e5 - 5, 0, -3), at(9e5 + 1, 0, 3)).free());
  far.vertices[0].x() = 1e9F;
  EXPECT_REFUSED(CollisionScene(far), "up to 1e6 m");
}

TEST(CollisionHazard, TrianglesWithoutAreaStayWhereTheyAre) {
  const std::vector<RobotShape> shapes = {shape::Sphere{0.1}, shape::Box{{0.1, 0.1, 0.1}}, shape::Sphere{0}};
  for (const auto& [a, b, c] : std::vector<std::array<Eigen::Vector3d, 3>>{{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}},
                                                                           {{{-1, 0, 1}, {0, 0, 1}, {1, 0, 1}}},
                                                                           {{{-1, 0, 1}, {1, 0, 1}, {1, 0, 1}}},
                                                                           {{{-1, 0, 1}, {-1, 0, 1}, {1, 0, 1}}},
                                                                           {{{1, 0, 1}, {-1, 0, 1}, {1, 0, 1}}},
                                                                           {{{1, 0, 1}, {0, 1e-9, 1}, {-1, 0, 1}}}}) {
    TriangleMesh mesh;
    add_triangle(mesh, a, b, c);
    const CollisionScene scene(mesh);
    for (const RobotShape& shape : shapes) {
      const CollisionChecker checker(scene, shape);
      const double size = checker.check(at(0, 0, 3)).clearance_m;
      EXPECT_NEAR(size, std::get_if<shape::Sphere>(&shape) && std::get<shape::Sphere>(shape).radius_m == 0 ? 2 : 1.9,
                  1e-5);
      EXPECT_FALSE(checker.check(at(0, 0, 1)).free());
      EXPECT_FALSE(checker.check(at(0, 0, 3), at(0, 0, -1)).free());
    }
  }
}

TEST(CollisionHazard, RefusesBadMeshesAndShapes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh mesh = ground();
  mesh.vertices[2].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_REFUSED(CollisionScene(mesh), "finite coordinates");
  mesh = ground();
  mesh.triangles[0][1] = 7;
  EXPECT_REFUSED(CollisionScene(mesh), "uses vertex 7");
  EXPECT_REFUSED(CollisionScene(TriangleMesh()), "no triangle");
  const CollisionScene scene(ground());
  EXPECT_REFUSED(CollisionChecker(scene, shape::Sphere{-1}), "radius_m");
  EXPECT_REFUSED(CollisionChecker(scene, shape::Sphere{nan}), "radius_m");
  EXPECT_REFUSED(CollisionChecker(scene, shape::Box{{1, nan, 1}}), "half extents");
  EXPECT_REFUSED(CollisionChecker(scene, shape::Convex{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}), "plane");
  EXPECT_REFUSED(CollisionChecker(scene, shape::Mesh{}), "no triangle");
  EXPECT_REFUSED(CollisionChecker(scene, shape::Sphere{1}, {.resolution_m = 0}), "resolution_m");
  EXPECT_REFUSED(CollisionChecker(scene, shape::Sphere{1}, {.clearance_error = 1}), "clearance_error");
}

TEST(CollisionHazard, TooManyQueriesAreUnresolved) {
  const CollisionChecker checker(CollisionScene(ground()), shape::Sphere{0.5},
                                 {.resolution_m = 1e-6, .most_queries = 20});
  const CollisionCheck c = checker.check(at(-9, 0, 0.501), at(9, 0, 0.501));
  EXPECT_EQ(c.verdict, Verdict::unresolved);
  EXPECT_FALSE(c.free());
  EXPECT_EQ(c.clearance_m, 0);
}

TEST(CollisionHazard, WhatFclThrowsIsInCollision) {
  for (const CollisionCheck& c : {detail::guarded([]() -> CollisionCheck { throw std::logic_error("as of FCL"); }),
                                  detail::guarded([]() -> CollisionCheck { throw std::bad_alloc(); })}) {
    EXPECT_EQ(to_string(c.verdict), "failed");
    EXPECT_FALSE(c.free());
    EXPECT_EQ(c.clearance_m, 0);
  }
  EXPECT_EQ(detail::guarded([] { return CollisionCheck{Verdict::free, 2}; }).clearance_m, 2);
}

}  // namespace
}  // namespace vantage

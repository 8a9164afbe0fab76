// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/ray_scene.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

namespace vantage {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

// z = 0, x and y in [0, 1] and a second one above it, seen counter-clockwise from above.
TriangleMesh two_squares() {
  TriangleMesh m;
  for (const float z : {0.0F, 2.0F}) {
    const auto first = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}});
    m.triangles.push_back({first, first + 1, first + 2});
    m.triangles.push_back({first, first + 2, first + 3});
  }
  return m;
}

// A closed box of n x n squares a side, its vertices moved along the radius: many edges to slip through.
TriangleMesh ball(int n) {
  TriangleMesh m;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(m.vertices.size());
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
          Eigen::Vector3d p;
          p[axis] = sign;
          p[(axis + 1) % 3] = 2.0 * i / n - 1;
          p[(axis + 2) % 3] = 2.0 * j / n - 1;
          // rounded, so that the box's sides meet
          m.vertices.push_back(((3072 * p.normalized()).array().round() / 1024).matrix().cast<float>());
        }
      const auto row = static_cast<std::uint32_t>(n + 1);
      for (std::uint32_t i = 0; i + 1 < row; ++i)
        for (std::uint32_t j = 0; j + 1 < row; ++j) {
          const std::uint32_t a = first + i * row + j, b = a + row, c = b + 1, d = a + 1;
          m.triangles.push_back({a, b, c});
          m.triangles.push_back({a, c, d});
        }
    }
  return m;
}

Eigen::Vector3d direction(Rng& rng) {
  const double z = rng.uniform(-1, 1), angle = rng.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

std::string refusal(const TriangleMesh& mesh, const RaySceneConfig& config = {}) {
  try {
    const RayScene scene(mesh, config);
  } catch (const Error& e) { return e.what(); }
  return "accepted";
}

TEST(RayScene, MeetsTheNearestTriangle) {
  const RayScene scene(two_squares());
  EXPECT_EQ(scene.triangles(), 4U);
  EXPECT_TRUE(scene.bounds().isApprox(Box3(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 2))));
  const auto hit = scene.cast({{0.75, 0.25, 3}, {0, 0, -4}});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance_m, 1);  // metres, whatever the direction's length
  EXPECT_EQ(hit->triangle, 2U);
  EXPECT_NEAR(hit->u, 0.5, 1e-6);  // (0.75, 0.25) = 0.25 a + 0.5 b + 0.25 c
  EXPECT_NEAR(hit->v, 0.25, 1e-6);
  EXPECT_TRUE(hit->normal.isApprox(Eigen::Vector3d(0, 0, 1)));
  const auto below = scene.cast({{0.25, 0.75, -1}, {0, 0, 1}});
  ASSERT_TRUE(below);
  EXPECT_EQ(below->triangle, 1U);
  EXPECT_TRUE(below->normal.isApprox(Eigen::Vector3d(0, 0, 1)));  // the triangle's, not the viewer's
  EXPECT_FALSE(scene.cast({{1.5, 0.5, 3}, {0, 0, -1}}));
}

TEST(RayScene, LooksBetweenNearAndFarOnly) {
  const RayScene scene(two_squares());
  const Eigen::Vector3d eye(0.5, 0.25, 3), down(0, 0, -1);
  EXPECT_DOUBLE_EQ(scene.cast({eye, down, 1.5})->distance_m, 3);
  EXPECT_FALSE(scene.cast({eye, down, 0, 0.5}));
  EXPECT_FALSE(scene.cast({eye, down, 1.5, 2.5}));
  EXPECT_TRUE(scene.occluded({eye, down}));
  EXPECT_TRUE(scene.occluded({eye, down, 0, 1.5}));
  EXPECT_FALSE(scene.occluded({eye, down, 0, 0.5}));
  EXPECT_FALSE(scene.occluded({eye, down, 1.5, 2.5}));
  EXPECT_FALSE(scene.occluded({eye, down, 2, 1}));
  EXPECT_FALSE(scene.cast({eye, down, 2, 1}));
}

TEST(RayScene, PacketsSeeWhatSingleRaysSee) {
  const RayScene scene(ball(8));
  Rng rng(1);
  for (int repeat = 0; repeat < 200; ++repeat) {
    RayPacket p;
    p.origin = direction(rng).cast<float>();
    const Eigen::Vector3d middle = direction(rng);
    const double spread = repeat % 2 ? 0.05 : 2;  // coherent, and not at all
    for (int k = 0; k < RayPacket::size; ++k) {
      const Eigen::Vector3f d = (2 * (middle + spread * direction(rng))).cast<float>();
      p.direction_x[k] = d.x();
      p.direction_y[k] = d.y();
      p.direction_z[k] = d.z();
    }
    scene.cast(p);
    for (int k = 0; k < RayPacket::size; ++k) {
      const Eigen::Vector3d d = Eigen::Vector3f(p.direction_x[k], p.direction_y[k], p.direction_z[k]).cast<double>();
      const auto hit = scene.cast({p.origin.cast<double>(), d});
      ASSERT_TRUE(hit);
      ASSERT_NE(p.triangle[static_cast<std::size_t>(k)], RayPacket::none);
      EXPECT_NEAR(p.distance[k] * d.norm(), hit->distance_m, 1e-5);
      if (p.triangle[static_cast<std::size_t>(k)] != hit->triangle) continue;  // on an edge
      EXPECT_NEAR(p.u[k], hit->u, 1e-4);
      EXPECT_NEAR(p.v[k], hit->v, 1e-4);
      const Eigen::Vector3d n(p.normal_x[k], p.normal_y[k], p.normal_z[k]);
      EXPECT_TRUE(n.normalized().isApprox(hit->normal, 1e-5));
    }
  }
}

TEST(RayScene, PacketsThatMissSayNone) {
  const RayScene scene(two_squares());
  RayPacket p;
  p.origin = {0.5F, 0.5F, 5};
  p.direction_x = p.direction_y = 0;
  p.direction_z = 1;
  p.direction_z[3] = -1;
  scene.cast(p);
  for (int k = 0; k < RayPacket::size; ++k) {
    EXPECT_EQ(p.triangle[static_cast<std::size_t>(k)] == RayPacket::none, k != 3);
    EXPECT_EQ(std::isinf(p.distance[k]), k != 3);
  }
  EXPECT_FLOAT_EQ(p.distance[3], 3);
}

TEST(RayScene, NoRayLeavesAClosedSurfaceAlongItsEdges) {
  const TriangleMesh mesh = ball(16);
  const RayScene scene(mesh);
  RayPacket p;
  p.origin.setZero();
  const auto aim = [&](int k, const Eigen::Vector3f& d) {
    p.direction_x[k] = d.x();
    p.direction_y[k] = d.y();
    p.direction_z[k] = d.z();
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {  // at the corners and at points on the edges
    for (int k = 0; k < RayPacket::size; ++k) {
      const auto corner = [&](int i) { return mesh.vertices[mesh.triangles[t][static_cast<std::size_t>(i % 3)]]; };
      const float s = static_cast<float>(k / 3) / 5;
      aim(k, (1 - s) * corner(k) + s * corner(k + 1));
    }
    scene.cast(p);
    for (const std::uint32_t hit : p.triangle) ASSERT_NE(hit, RayPacket::none);
  }
}

TEST(RayScene, OtherHierarchiesSeeTheSame) {
  const TriangleMesh mesh = ball(8);
  const RayScene scene(mesh);
  for (const RaySceneConfig& config :
       {RaySceneConfig{.watertight = false}, RaySceneConfig{.watertight = false, .high_quality = true}}) {
    const RayScene other(mesh, config);
    Rng rng(3);
    for (int i = 0; i < 1000; ++i) {
      const Ray ray{0.5 * direction(rng), direction(rng)};
      const auto a = scene.cast(ray), b = other.cast(ray);
      ASSERT_TRUE(a && b);
      EXPECT_NEAR(a->distance_m, b->distance_m, 1e-4);
    }
  }
}

TEST(RayScene, CopiesOutliveTheOriginal) {
  std::optional<RayScene> first = RayScene(two_squares());
  const RayScene copy = *first;
  first.reset();
  EXPECT_TRUE(copy.occluded({{0.5, 0.25, 3}, {0, 0, -1}}));
}

TEST(RayScene, RefusesMeshesThatEmbreeWouldTakeSilently) {
  TriangleMesh mesh = two_squares();
  EXPECT_EQ(refusal(mesh), "accepted");
  mesh.vertices[5].y() = static_cast<float>(nan);
  EXPECT_NE(refusal(mesh).find("vertex 5 is (  1 nan   2)"), std::string::npos) << refusal(mesh);
  mesh.vertices[5].y() = static_cast<float>(-infinity);
  EXPECT_NE(refusal(mesh).find("vertex 5"), std::string::npos) << refusal(mesh);
  mesh.vertices[5].y() = 1e20F;
  EXPECT_NE(refusal(mesh).find("1e9 m"), std::string::npos) << refusal(mesh);
  mesh = two_squares();
  mesh.triangles[3][1] = 8;
  EXPECT_NE(refusal(mesh).find("triangle 3 uses vertex 8"), std::string::npos) << refusal(mesh);
  mesh.triangles.clear();
  EXPECT_NE(refusal(mesh).find("no triangle"), std::string::npos) << refusal(mesh);
}

TEST(RayScene, RefusesRaysThatWouldAbortEmbree) {
  const RayScene scene(two_squares());
  for (const double bad : {nan, infinity, -infinity, 1e300}) {
    for (int i = 0; i < 3; ++i) {
      Ray ray{{0, 0, 3}, {0, 0, -1}};
      ray.origin[i] = bad;
      EXPECT_THROW((void)scene.cast(ray), Error);
      EXPECT_THROW((void)scene.occluded(ray), Error);
      if (bad == 1e300) continue;  // a length that is none the worse for being large
      ray = {{0, 0, 3}, {0, 0, -1}};
      ray.direction[i] = bad;
      EXPECT_THROW((void)scene.cast(ray), Error);
      EXPECT_THROW((void)scene.occluded(ray), Error);
    }
  }
  EXPECT_THROW((void)scene.cast({{0, 0, 3}, {0, 0, 0}}), Error);
  EXPECT_THROW((void)scene.cast({{0, 0, 3}, {0, 0, -1}, nan}), Error);
  EXPECT_THROW((void)scene.cast({{0, 0, 3}, {0, 0, -1}, -1}), Error);
  EXPECT_THROW((void)scene.cast({{0, 0, 3}, {0, 0, -1}, 0, nan}), Error);
  EXPECT_TRUE(scene.cast({{0.5, 0.25, 3}, {0, 0, -1e-300}}));
  EXPECT_TRUE(scene.cast({{0.5, 0.25, 3}, {0, 0, -1e300}}));

  RayPacket good;
  good.origin = {0.5F, 0.5F, 3};
  good.direction_x = good.direction_y = 0;
  good.direction_z = -1;
  scene.cast(good);
  for (const float bad : {static_cast<float>(nan), static_cast<float>(infinity), 1e30F}) {
    for (int k : {0, 7, 15})
      for (int i = 0; i < 3; ++i) {
        RayPacket p = good;
        (i == 0 ? p.direction_x : i == 1 ? p.direction_y : p.direction_z)[k] = bad;
        EXPECT_THROW(scene.cast(p), Error);
      }
    RayPacket p = good;
    p.origin.y() = bad;
    EXPECT_THROW(scene.cast(p), Error);
  }
  RayPacket p = good;
  p.direction_z[9] = 0;
  EXPECT_THROW(scene.cast(p), Error);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/geometry/tsdf.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <vantage/concepts/map.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/marching_cubes.hpp>
#include <vantage/geometry/mesh_components.hpp>

#include "analytic_scene.hpp"
#include "mesh_topology.hpp"

namespace vantage {
namespace {

static_assert(Map<Tsdf> && ColouredBrickVolume<Tsdf>);

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
const Box3 unit(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1));

// From all sides, at a distance of 2.5 m.
std::vector<View> around(const Eigen::Vector3d& centre) {
  std::vector<View> views;
  for (const double elevation : {-70.0, -35.0, 0.0, 35.0, 70.0})
    for (int i = 0; i < 12; ++i) {
      const double azimuth = deg(30.0 * i + elevation);
      views.push_back(look_at(
          centre + 2.5 * Eigen::Vector3d(std::cos(deg(elevation)) * std::cos(azimuth),
                                         std::cos(deg(elevation)) * std::sin(azimuth), std::sin(deg(elevation))),
          centre));
    }
  return views;
}
template <class S>
Tsdf fused(const S& surface, const std::vector<View>& views, const Tsdf::Config& config) {
  const Camera camera = Camera::from_fov(256, 256, deg(50));
  Tsdf tsdf(config);
  for (const View& v : views) tsdf.integrate(test::observe(surface, v, camera, unit));
  return tsdf;
}
// Everything that can be read from it.
std::vector<float> content(const Tsdf& t) {
  std::vector<float> all;
  for (std::size_t b = 0; b < t.bricks(); ++b) {
    const Eigen::Vector3i first = t.corner(b) * brick_edge;
    for (int i = 0; i < 512; ++i)
      if (const auto v = t.at(first + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6)))
        for (const float x : {static_cast<float>(b), static_cast<float>(i), v->distance_m, v->weight, v->colour.x(),
                              v->colour.y(), v->colour.z()})
          all.push_back(x);
  }
  return all;
}

TEST(Tsdf, DistancesOfOneFrameAreThoseAlongTheRay) {
  // A wall at x = 1.0, seen from the origin along x; each voxel against the formula, with the pixel looked up by hand.
  const test::Plane wall{Eigen::Vector3d::UnitX(), 1.0};
  const Camera camera{64, 48, 60, 55, 30, 25};
  const View view = look_at({0, 0, 0}, {1, 0.1, -0.2});
  const Frame frame = test::observe(wall, view, camera, unit);
  Tsdf tsdf({.bounds = Box3(Eigen::Vector3d(0.5, -1, -1), Eigen::Vector3d(1.5, 1, 1)), .truncation_m = 0.07});
  tsdf.integrate(frame);
  std::size_t known = 0;
  for (std::size_t b = 0; b < tsdf.bricks(); ++b)
    for (int i = 0; i < 512; ++i) {
      const Eigen::Vector3i voxel = tsdf.corner(b) * brick_edge + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
      const Eigen::Vector3d centre =
          Eigen::Vector3d(0.5, -1, -1) + 0.02 * (voxel.cast<double>().array() + 0.5).matrix();
      const Eigen::Vector3d p = view.T_W_C.inverse() * centre;
      const double u = camera.fx * p.x() / p.z() + camera.cx, v = camera.fy * p.y() / p.z() + camera.cy;
      const auto found = tsdf.at(voxel);
      if (p.z() <= 0 || u < 0 || v < 0 || u >= camera.width || v >= camera.height) {
        EXPECT_FALSE(found);
        continue;
      }
      const auto d = static_cast<double>(frame.depth(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(u)));
      const double along = (d - p.z()) * p.norm() / p.z();
      if (std::abs(along + 0.07) < 1e-5) continue;
      ASSERT_EQ(found.has_value(), along >= -0.07);
      if (!found) continue;
      ++known;
      ASSERT_NEAR(found->distance_m, std::min(along, 0.07), 2e-6);
      ASSERT_EQ(found->weight, 1);
    }
  EXPECT_GT(known, 10'000u);
}

TEST(Tsdf, EveryVoxelOfABandIsInATouchedBrick) {
  const auto room = test::all_of(test::Cuboid{Box3(Eigen::Vector3d(-1.9, -1.7, -1.2), Eigen::Vector3d(1.8, 1.6, 1.3))},
                                 test::Sphere{{0.7, 0.3, 0}, 0.4});
  const Camera camera = Camera::from_fov(128, 128, deg(80));
  const View view = look_at({-1, -0.9, 0.2}, {0.9, 0.5, -0.2});
  const Frame frame = test::observe(room, view, camera, unit);
  for (const double truncation : {0.02, 0.1, 0.5}) {
    Tsdf tsdf(
        {.bounds = Box3(Eigen::Vector3d::Constant(-2), Eigen::Vector3d::Constant(2)), .truncation_m = truncation});
    tsdf.integrate(frame);
    for (int v = 0; v < camera.height; v += 3)
      for (int u = 0; u < camera.width; u += 3) {
        const Eigen::Vector3d ray = camera.ray(u + 0.5, v + 0.5);
        for (double s = -1; s <= 1; s += 0.125) {
          const double z = static_cast<double>(frame.depth(v, u)) + s * truncation / ray.norm();
          const Eigen::Vector3d p = view.T_W_C * (z * ray);
          if (z <= 0 || !tsdf.bounds().contains(p)) continue;
          const Eigen::Vector3i brick = ((p - tsdf.bounds().min()) / 0.16).array().floor().cast<int>().min(24);
          const Eigen::Vector3d inside = (p - tsdf.bounds().min()) / 0.16 - brick.cast<double>();
          if (inside.minCoeff() < 1e-4 || inside.maxCoeff() > 1 - 1e-4) continue;  // single precision
          ASSERT_GE(tsdf.brick_at(brick), 0) << u << ' ' << v << ' ' << s;
        }
      }
  }
}

TEST(Tsdf, ASphereIsWatertightAndOfItsSize) {
  // Distances along oblique rays are too long, and cut at the truncation: this much of a bias belongs to the method.
  const test::Sphere sphere{{0.03, -0.02, 0.01}, 0.6};
  struct Case {
    double truncation_m, mean_m, worst_m;
  };
  for (const Case& c : {Case{0.10, 0.002, 0.007}, Case{0.04, 0.0003, 0.004}}) {
    const Tsdf tsdf = fused(sphere, around(sphere.centre), {.bounds = unit, .truncation_m = c.truncation_m});
    const TriangleMesh mesh = without_small_components(marching_cubes(tsdf));
    const test::Topology t = test::topology(mesh);
    EXPECT_TRUE(t.closed()) << t.open << " open edges";
    EXPECT_EQ(t.euler, 2);
    EXPECT_NEAR(test::volume(mesh) / (4.0 / 3 * std::numbers::pi * 0.216), 1, 3 * c.mean_m / 0.6 + 0.001);
    double mean = 0, worst = 0;
    for (const Eigen::Vector3f& v : mesh.vertices) {
      const double off = (v.cast<double>() - sphere.centre).norm() - sphere.radius_m;
      mean += off / static_cast<double>(mesh.vertices.size());
      worst = std::max(worst, std::abs(off));
    }
    EXPECT_LT(std::abs(mean), c.mean_m);
    EXPECT_LT(worst, c.worst_m);
  }
}

TEST(Tsdf, ColoursAreThoseOfTheSurface) {
  const test::Sphere sphere{{0, 0, 0}, 0.6};
  const TriangleMesh mesh = marching_cubes(fused(sphere, around(sphere.centre), {.bounds = unit}));
  ASSERT_EQ(mesh.colours.size(), mesh.vertices.size());
  double worst = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)  // the colour is the place in [-1, 1]^3
    worst = std::max(
        worst, static_cast<double>(((mesh.vertices[i].array() + 1) / 2 - mesh.colours[i].array()).abs().maxCoeff()));
  EXPECT_LT(worst, 0.05);
  const TriangleMesh plain = marching_cubes(fused(sphere, around(sphere.centre), {.bounds = unit, .colour = false}));
  EXPECT_TRUE(plain.colours.empty());
  EXPECT_EQ(plain.vertices, mesh.vertices);
}

TEST(Tsdf, ARoomSeenFromInside) {
  const Box3 walls(Eigen::Vector3d(-0.93, -0.81, -0.71), Eigen::Vector3d(0.87, 0.77, 0.83));
  const test::Cuboid room{walls};
  std::vector<View> views;
  const Eigen::Vector3d eye(0.05, -0.03, 0.04);
  for (int turn = 0; turn < 360; turn += 30)
    for (const double up : {-1.5, -0.6, 0.0, 0.6, 1.5})
      views.push_back(look_at(eye, eye + Eigen::Vector3d(std::cos(deg(turn)), std::sin(deg(turn)), up)));
  for (const double z : {-1.0, 1.0}) views.push_back(look_at(eye, eye + Eigen::Vector3d(0, 0, z)));
  const Tsdf tsdf = fused(room, views, {.bounds = Box3(walls.min().array() - 0.2, walls.max().array() + 0.2)});
  const TriangleMesh mesh = without_small_components(marching_cubes(tsdf));
  EXPECT_TRUE(test::topology(mesh).closed());
  double worst = 0;
  for (const Eigen::Vector3f& v : mesh.vertices) {
    const Eigen::Array3d p = v.cast<double>().array();
    const double off = std::min((p - walls.min().array()).abs().minCoeff(), (p - walls.max().array()).abs().minCoeff());
    worst = std::max(worst, off);
  }
  EXPECT_LT(worst, 0.02) << "corners are cut, walls are not";
  const Eigen::Vector3d s = walls.sizes();
  EXPECT_NEAR(-test::volume(mesh) / s.prod(), 1, 0.01) << "a room's surface faces inwards";
}

TEST(Tsdf, WhatNoPixelSawIsUnknown) {
  const test::Plane wall{Eigen::Vector3d::UnitX(), 0.5};
  Frame frame = test::observe(wall, look_at({-0.9, 0, 0}, {1, 0, 0}), Camera::from_fov(64, 64, deg(60)), unit);
  frame.depth.leftCols(32).setConstant(nan);  // the camera's left is +y
  Tsdf tsdf({.bounds = unit});
  tsdf.integrate(frame);
  std::size_t left = 0, right = 0;
  for (const Eigen::Vector3f& v : marching_cubes(tsdf).vertices) (v.y() > 0.011F ? left : right) += 1;
  EXPECT_EQ(left, 0u);
  EXPECT_GT(right, 100u);
  frame.depth.setConstant(nan);
  Tsdf blind({.bounds = unit});
  blind.integrate(frame);
  EXPECT_EQ(blind.bricks(), 0u);
  EXPECT_TRUE(marching_cubes(blind).empty());
  EXPECT_FALSE(blind.at({0, 0, 0}));
  EXPECT_FALSE(blind.at({-1, 5, 1'000'000}));
}

TEST(Tsdf, MemoryFollowsWhatIsSeen) {
  const Box3 hall(Eigen::Vector3d(-20, -20, 0), Eigen::Vector3d(20, 20, 6));
  Tsdf tsdf({.bounds = hall});
  const std::size_t empty = tsdf.bytes();
  EXPECT_EQ(empty, 4u * 250 * 250 * 38);
  tsdf.integrate(test::observe(test::Sphere{{0, 0, 2}, 0.5}, look_at({2, 0, 2}, {0, 0, 2}),
                               Camera::from_fov(64, 64, deg(60)), hall));
  EXPECT_GT(tsdf.bricks(), 20u);
  EXPECT_LT(tsdf.bricks(), 400u);
  EXPECT_EQ(tsdf.bytes() - empty, 512u * (512 * 20 + sizeof(Eigen::Vector3i))) << "one slab";
}

TEST(Tsdf, DoesNotDependOnTheThreads) {
  const auto scene = test::all_of(test::Sphere{{0.2, 0.1, 0}, 0.5}, test::Plane{Eigen::Vector3d::UnitZ(), -0.7});
  const auto run = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      std::vector<View> views = around({0, 0, 0});
      views.resize(30);
      return content(fused(scene, views, {.bounds = unit}));
    });
  };
  const auto one = run(1);
  EXPECT_GT(one.size(), 100'000u);
  EXPECT_EQ(run(2), one);
  EXPECT_EQ(run(8), one);
}

TEST(Tsdf, ARefusedFrameChangesNothing) {
  const test::Sphere sphere{{0, 0, 0}, 0.6};
  const Frame good = test::observe(sphere, look_at({2, 0, 0}, {0, 0, 0}), Camera::from_fov(64, 64, deg(50)), unit);
  Tsdf tsdf({.bounds = unit});
  tsdf.integrate(good);
  const auto before = content(tsdf);
  const auto refused = [&](auto&& damage) {
    Frame bad = good;
    bad.view = look_at({0, 2, 0}, {0, 0, 0});
    damage(bad);
    EXPECT_THROW(tsdf.integrate(bad), Error);
    EXPECT_EQ(content(tsdf), before);
  };
  refused([](Frame& f) { f.view.T_W_C(0, 3) = std::numeric_limits<double>::quiet_NaN(); });
  refused([](Frame& f) { f.view.T_W_C.linear() *= 1.01; });
  refused([](Frame& f) { f.camera.fx = 0; });
  refused([](Frame& f) { f.depth.conservativeResize(63, 64); });
  refused([](Frame& f) { f.depth(3, 4) = -1; });
  refused([](Frame& f) { f.depth(3, 4) = std::numeric_limits<float>::infinity(); });
  refused([](Frame& f) { f.depth.resize(0, 0); });
  refused([](Frame& f) { f.colour.g(5, 5) = 1.5F; });
  refused([](Frame& f) { f.colour = {}; });
}

TEST(Tsdf, RefusesWhatDoesNotFitIntoMemory) {
  const auto message = [](const auto& f) -> std::string {
    try {
      f();
    } catch (const Error& e) { return e.what(); }
    return "accepted";
  };
  const Box3 vast(Eigen::Vector3d::Constant(-1e4), Eigen::Vector3d::Constant(1e4));
  EXPECT_NE(message([&] { Tsdf({.bounds = vast}); }).find("bricks of 8^3"), std::string::npos);
  EXPECT_NE(message([&] { Tsdf({.bounds = Box3(), .voxel_m = 0, .truncation_m = -1}); }).find("truncation_m = -1"),
            std::string::npos);
  Tsdf small({.bounds = unit, .max_bytes = 100'000});  // the directory fits, a slab does not
  const Frame frame = test::observe(test::Sphere{{0, 0, 0}, 0.6}, look_at({2, 0, 0}, {0, 0, 0}),
                                    Camera::from_fov(64, 64, deg(50)), unit);
  EXPECT_NE(message([&] { small.integrate(frame); }).find("max_bytes"), std::string::npos);
  EXPECT_EQ(small.bricks(), 0u);
  EXPECT_TRUE(content(small).empty());
}

TEST(Tsdf, DepthFarBeyondTheBoundsIsHarmless) {
  Frame frame = test::observe(test::Sphere{{0, 0, 0}, 0.6}, look_at({2, 0, 0}, {0, 0, 0}),
                              Camera::from_fov(64, 64, deg(50)), unit);
  frame.depth.topRows(20).setConstant(1e30F);
  frame.depth(40, 40) = std::numeric_limits<float>::max();
  frame.depth(41, 40) = std::numeric_limits<float>::min();
  Tsdf tsdf({.bounds = unit});
  tsdf.integrate(frame);
  for (const float x : content(tsdf)) ASSERT_TRUE(std::isfinite(x));
  marching_cubes(tsdf).validate("test");
}

}  // namespace
}  // namespace vantage

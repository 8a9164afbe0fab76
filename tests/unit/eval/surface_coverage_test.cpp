// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/eval/reachable_space.hpp>
#include <vantage/eval/surface_coverage.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <vantage/core/units.hpp>

#include "analytic_scene.hpp"
#include "mesh_topology.hpp"

namespace vantage {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Box3 room(Eigen::Vector3d(-2, -2, -2), Eigen::Vector3d(2, 2, 2));

bool nothing_between(const Eigen::Vector3d&, const Eigen::Vector3d&) { return true; }
// In line of sight past an analytic surface.
template <class S>
auto past(S surface) {
  return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return surface(from, Eigen::Vector3d(to - from)) > 1 - 1e-3;
  };
}
SurfaceSamples points(std::vector<Eigen::Vector3f> p) {
  SurfaceSamples s{std::move(p), {}};
  s.triangles.resize(s.points.size());
  return s;
}

TEST(ReachablePositions, FillTheBoundsOfAnEmptyRoom) {
  const auto all = reachable_positions(room, 0.5, {0, 0, 0}, [](const Eigen::Vector3d&) { return true; });
  EXPECT_EQ(all.size(), 729u) << "9^3, the sides included";
  EXPECT_EQ(all.front(), Eigen::Vector3d::Zero());
  for (const Eigen::Vector3d& p : all) EXPECT_TRUE(room.contains(p));
}

TEST(ReachablePositions, DoNotPassWalls) {
  // A wall at x = 0.5 with a door 1 m wide; without the door, only the near side is reached.
  const auto wall = [](double door) {
    return [door](const Eigen::Vector3d& p) { return std::abs(p.x() - 0.5) > 0.1 || std::abs(p.y()) < door; };
  };
  const auto closed = reachable_positions(room, 0.25, {-1, 0.1, 0}, wall(0));
  EXPECT_TRUE(std::ranges::all_of(closed, [](const Eigen::Vector3d& p) { return p.x() < 0.4; }));
  EXPECT_EQ(closed.size(), 10u * 16 * 17) << "x from -2 to 0.25, y from -1.9, z from -2 to 2";
  const auto open = reachable_positions(room, 0.25, {-1, 0.1, 0}, wall(0.5));
  EXPECT_EQ(open.size(), 16u * 16 * 17 + 4 * 17) << "both sides, and the 4 columns in the door";
}

TEST(ReachablePositions, EachIsAskedOnceAndInAStableOrder) {
  const auto run = [](int threads) {
    tbb::task_arena arena(threads);
    std::atomic<int> asked{0};
    auto all = arena.execute([&] {
      return reachable_positions(room, 0.25, {0.03, 0, 0}, [&](const Eigen::Vector3d& p) {
        ++asked;
        return p.norm() < 1.5;
      });
    });
    EXPECT_LT(asked, 2 * static_cast<int>(all.size()));
    return all;
  };
  const auto one = run(1);
  EXPECT_GT(one.size(), 800u);
  EXPECT_EQ(run(2), one);
  EXPECT_EQ(run(8), one);
}

TEST(ReachablePositions, NothingOrRefused) {
  const auto yes = [](const Eigen::Vector3d&) { return true; };
  EXPECT_TRUE(reachable_positions(room, 0.5, {0, 0, 0}, [](const Eigen::Vector3d&) { return false; }).empty());
  EXPECT_THROW(static_cast<void>(reachable_positions(room, 0.5, {3, 0, 0}, yes)), Error);
  EXPECT_THROW(static_cast<void>(reachable_positions(room, 0.5, {nan, 0, 0}, yes)), Error);
  EXPECT_THROW(static_cast<void>(reachable_positions(room, 0, {0, 0, 0}, yes)), Error);
  EXPECT_THROW(static_cast<void>(reachable_positions(room, 1e-3, {0, 0, 0}, yes)), Error);
  EXPECT_THROW(static_cast<void>(reachable_positions(Box3(), 0.5, {0, 0, 0}, yes)), Error);
}

TEST(VisibleSurface, SphereSeenFromOnePoint) {
  // From a distance d, what is within acos(r / d) + acos(r) of the axis lies above the horizon of a sphere of radius r,
  // here a little smaller than that of the points: a share (1 - cos) / 2.
  const TriangleMesh mesh = test::sphere_mesh({0, 0, 0}, 1, 200);
  const SurfaceSamples s = sample_surface(mesh, 20'000, Rng(1));
  const std::vector<Eigen::Vector3d> eye{{0, 0, 2.5}};
  const auto seen = visible_surface(s, eye, {.far_m = 5}, past(test::Sphere{{0, 0, 0}, 0.999}));
  EXPECT_NEAR(static_cast<double>(std::ranges::count(seen, 1)) / 20'000,
              (1 - std::cos(std::acos(0.999 / 2.5) + std::acos(0.999))) / 2, 0.002);
  const auto near = visible_surface(s, eye, {.far_m = 1.7}, past(test::Sphere{{0, 0, 0}, 0.999}));
  EXPECT_NEAR(static_cast<double>(std::ranges::count(near, 1)) / 20'000, (1 - 0.872) / 2, 0.005)
      << "1.7^2 = 1 + 2.5^2 - 2 * 2.5 z at z = 0.872";
  const auto far = visible_surface(s, eye, {.near_m = 4, .far_m = 5}, past(test::Sphere{{0, 0, 0}, 0.999}));
  EXPECT_EQ(std::ranges::count(far, 1), 0);
}

TEST(VisibleSurface, FromManyPointsAndWithoutRegardToTheThreads) {
  const SurfaceSamples s = sample_surface(test::sphere_mesh({0, 0, 0}, 1, 50), 5000, Rng(1));
  const auto outside = [](const Eigen::Vector3d& p) { return p.norm() > 1.2; };
  const auto positions = reachable_positions(room, 0.5, {0, 0, 2}, outside);
  const auto run = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      return visible_surface(s, positions, {.far_m = 1}, past(test::Sphere{{0, 0, 0}, 0.99}));
    });
  };
  const auto one = run(1);
  for (std::size_t i = 0; i < s.size(); ++i) {  // by trying all
    const Eigen::Vector3d p = s.points[i].cast<double>();
    const bool seen = std::ranges::any_of(positions, [&](const Eigen::Vector3d& eye) {
      return (eye - p).norm() <= 1 && past(test::Sphere{{0, 0, 0}, 0.99})(eye, p);
    });
    ASSERT_EQ(one[i], seen ? 1 : 0);
  }
  EXPECT_EQ(run(8), one);
}

TEST(SurfaceCoverage, AFrameSeesWhatItMeasured) {
  // A wall at z = 3 behind a ball: the wall's points count in the image, where no ball is before them.
  const test::Sphere ball{{0, 0, 1.5}, 0.3};
  const test::Plane wall{Eigen::Vector3d::UnitZ(), 3};
  const Camera camera = Camera::from_fov(128, 128, deg(60));
  const View view;  // at the origin, along z
  const Frame frame = test::observe(test::all_of(ball, wall), view, camera, room);
  const SurfaceSamples s = sample_surface(test::rectangle(-3, -3, 3, 3, 3), 50'000, Rng(1));
  SurfaceCoverage by_depth(s), by_sight(s);
  const std::size_t fresh = by_depth.add(frame);
  const double half = 3 * std::tan(deg(30)), shadow_radius = 3 * std::tan(std::asin(0.3 / 1.5));
  const double expected = (4 * half * half - std::numbers::pi * shadow_radius * shadow_radius) / 36;
  EXPECT_NEAR(by_depth.coverage(), expected, 0.005);
  EXPECT_EQ(fresh, static_cast<std::size_t>(std::ranges::count(by_depth.seen(), 1)));
  EXPECT_EQ(by_depth.add(frame), 0u) << "nothing new";
  EXPECT_NEAR(by_depth.coverage(), expected, 0.005);
  by_sight.add(view, camera, {.far_m = 5}, past(ball));
  EXPECT_NEAR(by_sight.coverage(), expected, 0.002);
  SurfaceCoverage short_sighted(s);
  EXPECT_EQ(short_sighted.add(view, camera, {.far_m = 2.9}, past(ball)), 0u);
  EXPECT_EQ(short_sighted.add(view, camera, {.near_m = 3.1, .far_m = 5}, past(ball)), 0u);
}

TEST(SurfaceCoverage, IsTheUnionOfWhatWasSeen) {
  const test::Cuboid box{room};
  const Camera camera = Camera::from_fov(64, 64, deg(90));
  std::vector<Eigen::Vector3f> on_walls;
  Rng rng(3);
  for (int i = 0; i < 6000; ++i) {
    Eigen::Vector3d p(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2));
    p[i % 3] = i % 2 ? 2 : -2;
    on_walls.push_back(p.cast<float>());
  }
  SurfaceCoverage coverage(points(on_walls));
  double last = 0;
  for (const Eigen::Vector3d& to :
       {Eigen::Vector3d(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
    coverage.add(test::observe(box, look_at({0, 0, 0}, to), camera, room));
    EXPECT_NEAR(coverage.coverage() - last, 1.0 / 6, 0.01) << "one side each";
    last = coverage.coverage();
  }
  EXPECT_GT(last, 0.995);
}

TEST(SurfaceCoverage, ToleranceAndMissingDepth) {
  Frame frame;
  frame.camera = Camera::from_fov(2, 1, deg(90));
  frame.depth.resize(1, 2);
  frame.depth << 2.0F, std::numeric_limits<float>::quiet_NaN();
  const auto seen = [&](float x, float z, const SurfaceCoverage::Tolerance& t) {
    SurfaceCoverage c(points({{x, 0, z}}), t);
    return c.add(frame) == 1;
  };
  EXPECT_TRUE(seen(-0.5F, 2.04F, {0.01, 0.02}));
  EXPECT_FALSE(seen(-0.5F, 2.06F, {0.01, 0.02}));
  EXPECT_FALSE(seen(-0.5F, 1.94F, {0.01, 0.02}));
  EXPECT_FALSE(seen(0.5F, 2, {0.01, 0.02})) << "a pixel without a value saw nothing";
  EXPECT_FALSE(seen(-0.5F, -2, {0.01, 0.02})) << "behind the camera";
  EXPECT_FALSE(seen(-2.5F, 2, {0.01, 0.02})) << "outside of the image";
}

TEST(SurfaceCoverage, Refuses) {
  const auto bad = points({{0, 0, std::numeric_limits<float>::quiet_NaN()}}), good = points({{0, 0, 1}});
  const std::vector<Eigen::Vector3d> here{{0, 0, 0}}, nowhere, strange{{nan, 0, 0}};
  EXPECT_THROW(SurfaceCoverage{bad}, Error);
  EXPECT_THROW(SurfaceCoverage{points({})}, Error);
  EXPECT_THROW(SurfaceCoverage(good, {-1, 0}), Error);
  EXPECT_THROW(static_cast<void>(visible_surface(bad, here, {}, nothing_between)), Error);
  EXPECT_THROW(static_cast<void>(visible_surface(good, nowhere, {}, nothing_between)), Error);
  EXPECT_THROW(static_cast<void>(visible_surface(good, strange, {}, nothing_between)), Error);
  EXPECT_THROW(static_cast<void>(visible_surface(good, here, {.near_m = 2, .far_m = 1}, nothing_between)), Error);
  SurfaceCoverage c(good);
  Frame frame;
  frame.camera = Camera::from_fov(2, 2, deg(90));
  EXPECT_THROW(c.add(frame), Error) << "no depth";
  frame.depth = Image<float>::Ones(2, 2);
  frame.view.T_W_C(0, 3) = nan;
  EXPECT_THROW(c.add(frame), Error);
  EXPECT_EQ(c.coverage(), 0);
  EXPECT_THROW(c.add(frame.view, frame.camera, SensingRange{}, nothing_between), Error);
  frame.view = View();
  EXPECT_EQ(c.add(frame), 1u);
  EXPECT_EQ(c.coverage(), 1);
}

}  // namespace
}  // namespace vantage

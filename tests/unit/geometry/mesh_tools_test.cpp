// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/geometry/mesh_components.hpp>
#include <vantage/geometry/mesh_sampling.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "mesh_topology.hpp"

namespace vantage {
namespace {

// Meshes side by side in one, coloured by their number.
TriangleMesh together(const std::vector<TriangleMesh>& parts) {
  TriangleMesh all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), parts[i].vertices.begin(), parts[i].vertices.end());
    all.colours.resize(all.vertices.size(), Eigen::Vector3f::Constant(static_cast<float>(i) / 10));
    for (const auto& t : parts[i].triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

TEST(MeshComponents, CountsEachPart) {
  const TriangleMesh big = test::sphere_mesh({0, 0, 0}, 1, 12), small = test::sphere_mesh({5, 0, 0}, 1, 3),
                     sheet = test::rectangle(0, 0, 1, 1, 7);
  const MeshComponents parts = mesh_components(together({small, big, sheet}));
  EXPECT_EQ(parts.triangles, (std::vector<std::size_t>{small.triangles.size(), big.triangles.size(), 2}));
  EXPECT_EQ(parts.of_triangle.front(), 0u);
  EXPECT_EQ(parts.of_triangle[small.triangles.size()], 1u);
  EXPECT_EQ(parts.of_triangle.back(), 2u);
  EXPECT_TRUE(mesh_components({}).triangles.empty());
}

TEST(MeshComponents, DropsTheSmallOnes) {
  const TriangleMesh big = test::sphere_mesh({0, 0, 0}, 1, 12), small = test::sphere_mesh({5, 0, 0}, 1, 3),
                     sheet = test::rectangle(0, 0, 1, 1, 7);
  const TriangleMesh kept = without_small_components(together({small, big, sheet}));
  EXPECT_EQ(kept.vertices, big.vertices);
  EXPECT_EQ(kept.triangles, big.triangles);
  for (const Eigen::Vector3f& c : kept.colours) EXPECT_FLOAT_EQ(c.x(), 0.1F) << "colours move with their vertices";
  EXPECT_EQ(without_small_components(together({small, big, sheet}), 3).triangles.size(),
            small.triangles.size() + big.triangles.size());
  EXPECT_EQ(without_small_components(small, small.triangles.size()).triangles, small.triangles) << "fewer, not as many";
  EXPECT_TRUE(without_small_components(small, small.triangles.size() + 1).empty());
}

TEST(MeshComponents, ALongChainIsOnePart) {
  TriangleMesh strip;  // numbered so that sets meet at both ends
  const std::uint32_t n = 10'000;
  for (std::uint32_t i = 0; i < n + 2; ++i)
    strip.vertices.emplace_back(static_cast<float>(i), static_cast<float>(i % 2), 0.0F);
  const auto shuffled = [&](std::uint32_t i) { return (i * 7919) % (n + 2); };
  for (std::uint32_t i = 0; i < n; ++i) strip.triangles.push_back({shuffled(i), shuffled(i + 1), shuffled(i + 2)});
  EXPECT_EQ(mesh_components(strip).triangles, (std::vector<std::size_t>{n}));
}

TEST(SampleSurface, IsUniformByArea) {
  // Two rectangles of areas 1 and 3, cut into unequal triangles.
  const TriangleMesh mesh = together({test::rectangle(0, 0, 1, 1, 0), test::rectangle(0, 0, 3, 1, 5)});
  const SurfaceSamples s = sample_surface(mesh, 40'000, Rng(1));
  Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = first;
  std::size_t n_first = 0, left = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Eigen::Vector3d p = s.points[i].cast<double>();
    (s.triangles[i] < 2 ? first : second) += p;
    n_first += s.triangles[i] < 2;
    left += s.triangles[i] >= 2 && p.x() < 1;
    ASSERT_EQ(p.z(), s.triangles[i] < 2 ? 0 : 5);
  }
  EXPECT_NEAR(static_cast<double>(n_first), 10'000, 1) << "stratified by area";
  EXPECT_NEAR(static_cast<double>(left), 10'000, 5 * std::sqrt(30'000 * 2 / 9.0));
  EXPECT_TRUE((first / static_cast<double>(n_first)).isApprox(Eigen::Vector3d(0.5, 0.5, 0), 0.02));
  EXPECT_TRUE((second / static_cast<double>(s.size() - n_first)).isApprox(Eigen::Vector3d(1.5, 0.5, 5), 0.02));
}

TEST(SampleSurface, PointsLieOnTheirTriangles) {
  const TriangleMesh mesh = test::sphere_mesh({1, 2, 3}, 0.5, 9);
  const SurfaceSamples s = sample_surface(mesh, 5000, Rng(2));
  for (std::size_t i = 0; i < s.size(); ++i) {
    const auto [a, b, c] = mesh.corners(s.triangles[i]);
    const Eigen::Vector3d p = s.points[i].cast<double>(), n = (b - a).cross(c - a).normalized();
    ASSERT_NEAR((p - a).dot(n), 0, 1e-6);
    for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      ASSERT_GE((v - u).cross(p - u).dot(n), -1e-6);
  }
}

TEST(SampleSurface, SeededAndWithoutRegardToTheThreads) {
  const TriangleMesh mesh = test::sphere_mesh({1, 2, 3}, 0.5, 20);
  const auto run = [&](int threads, std::uint64_t seed) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return sample_surface(mesh, 30'000, Rng(seed)).points; });
  };
  EXPECT_EQ(run(1, 5), run(8, 5));
  EXPECT_NE(run(1, 5), run(1, 6));
}

TEST(SampleSurface, DegenerateTrianglesGetNothing) {
  TriangleMesh mesh = test::rectangle(0, 0, 1, 1, 0);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  mesh.triangles.push_back({2, 2, 2});
  for (const std::uint32_t t : sample_surface(mesh, 10'000, Rng(1)).triangles) ASSERT_TRUE(t == 1 || t == 2);
}

TEST(SampleSurface, Refuses) {
  TriangleMesh mesh = test::rectangle(0, 0, 1, 1, 0);
  EXPECT_THROW(static_cast<void>(sample_surface(mesh, 0, Rng(1))), Error);
  EXPECT_THROW(static_cast<void>(sample_surface({}, 10, Rng(1))), Error);
  mesh.triangles = {{0, 1, 1}};
  EXPECT_THROW(static_cast<void>(sample_surface(mesh, 10, Rng(1))), Error) << "no area";
  mesh.triangles = {{0, 1, 4}};
  EXPECT_THROW(static_cast<void>(sample_surface(mesh, 10, Rng(1))), Error) << "no such vertex";
  mesh = test::rectangle(0, 0, 1, 1, 0);
  mesh.vertices[2].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(sample_surface(mesh, 10, Rng(1))), Error);
  EXPECT_THROW(static_cast<void>(mesh_components(mesh)), Error);
  const SurfaceSamples two{{{0, 0, 0}, {1, 0, 0}}, {0, 1}};
  EXPECT_THROW(static_cast<void>(two.where({1})), Error);
  EXPECT_EQ(two.where({0, 1}).triangles, std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/geometry/marching_cubes.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <vantage/core/rng.hpp>

#include "mesh_topology.hpp"

namespace vantage {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// f at every sample of an n_x x n_y x n_z grid from (-1, -1, -1) with spacing 2 / (n - 1) along the longest side.
template <class F>
ScalarGrid grid(const Eigen::Vector3i& n, F&& f) {
  const double h = 2.0 / (n.maxCoeff() - 1);
  std::vector<float> values;
  for (int z = 0; z < n.z(); ++z)
    for (int y = 0; y < n.y(); ++y)
      for (int x = 0; x < n.x(); ++x)
        values.push_back(static_cast<float>(f(Eigen::Vector3d(-1 + h * x, -1 + h * y, -1 + h * z))));
  return {n, Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(h), values};
}
// Random values inside, a frame of `outside` around them: whatever surface there is, is closed.
ScalarGrid noise(const Eigen::Vector3i& n, std::uint64_t seed, float outside) {
  Rng rng(seed);
  std::vector<float> values;
  for (int z = 0; z < n.z(); ++z)
    for (int y = 0; y < n.y(); ++y)
      for (int x = 0; x < n.x(); ++x) {
        const Eigen::Array3i at(x, y, z);
        const bool edge = (at == 0).any() || (at == n.array() - 1).any();
        values.push_back(edge ? outside : static_cast<float>(rng.uniform(-1, 1)));
      }
  return {n, Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), values};
}

TEST(MarchingCubesTable, EveryCutEdgeIsUsedAndNoOther) {
  for (std::size_t inside = 0; inside < 256; ++inside) {
    std::set<std::size_t> cut, used;
    for (std::size_t e = 0; e < 12; ++e) {
      const std::size_t a = marching::edge_start[e], b = a | std::size_t{1} << e / 4;
      if ((inside >> a & 1) != (inside >> b & 1)) cut.insert(e);
    }
    const auto& cell = marching::table[inside];
    for (std::size_t i = 0; i < std::size_t{3} * cell.triangles; ++i) used.insert(cell.edges[i]);
    EXPECT_EQ(used, cut) << inside;
    EXPECT_LE(cell.triangles, 5) << inside;
  }
}

TEST(MarchingCubes, EveryPairOfNeighbouringCellsFitsTogether) {
  // All 2^12 signs of two cells side by side, the outside around them: 6 x 6 x 6 samples hold them at every phase of a
  // brick in the next test; here one.
  for (unsigned signs = 0; signs < 1u << 12; ++signs) {
    std::vector<float> values(5 * 4 * 4, 1);
    for (unsigned i = 0; i < 12; ++i)
      if ((signs >> i & 1) != 0)
        values[(i / 6 + 1) * 20 + (i / 3 % 2 + 1) * 5 + i % 3 + 1] = -0.5F - 0.01F * static_cast<float>(i);
    const TriangleMesh mesh = marching_cubes(ScalarGrid({5, 4, 4}, {0, 0, 0}, {1, 1, 1}, values));
    ASSERT_TRUE(test::topology(mesh).closed()) << signs;
    if (signs != 0) { ASSERT_GT(test::volume(mesh), 0) << signs; }
  }
}

TEST(MarchingCubes, NoiseGivesClosedMeshesAcrossBricks) {
  // Sizes that are and are not multiples of a brick's edge; half of all cells are cut, in all 256 ways.
  for (const Eigen::Vector3i& n : {Eigen::Vector3i(16, 16, 16), Eigen::Vector3i(17, 25, 9), Eigen::Vector3i(8, 31, 23)})
    for (const float outside : {1.0F, -1.0F}) {
      const TriangleMesh mesh = marching_cubes(noise(n, 7, outside));
      const test::Topology t = test::topology(mesh);
      EXPECT_EQ(t.open, 0u);
      EXPECT_EQ(t.branching, 0u);
      EXPECT_EQ(t.unused, 0u);
      EXPECT_GT(test::volume(mesh) * outside, 0) << "a hollow has its normals inwards";
      std::set<std::array<float, 3>> places;
      for (const Eigen::Vector3f& v : mesh.vertices) places.insert({v.x(), v.y(), v.z()});
      EXPECT_EQ(places.size(), mesh.vertices.size()) << "no vertex twice";
    }
}

TEST(MarchingCubes, Sphere) {
  const double radius = 0.7;
  for (const int n : {32, 64}) {
    const TriangleMesh mesh =
        marching_cubes(grid(Eigen::Vector3i::Constant(n), [&](const Eigen::Vector3d& p) { return p.norm() - radius; }));
    const test::Topology t = test::topology(mesh);
    EXPECT_TRUE(t.closed());
    EXPECT_EQ(t.euler, 2);
    const double h = 2.0 / (n - 1);
    for (const Eigen::Vector3f& v : mesh.vertices)
      ASSERT_NEAR(v.cast<double>().norm(), radius, h * h / (4 * radius)) << "linear along an edge";
    // A chord's sagitta is h^2 / (8 r) at most a cell's edge, three times that across its diagonal.
    EXPECT_NEAR(test::volume(mesh), 4.0 / 3 * std::numbers::pi * std::pow(radius, 3),
                4 * std::numbers::pi * radius * h * h / 2);
    EXPECT_NEAR(test::area(mesh), 4 * std::numbers::pi * radius * radius, 8 * h * h);
  }
}

TEST(MarchingCubes, TorusHasAHole) {
  const TriangleMesh mesh = marching_cubes(grid(Eigen::Vector3i::Constant(48), [](const Eigen::Vector3d& p) {
    return std::hypot(std::hypot(p.x(), p.y()) - 0.6, p.z()) - 0.2;
  }));
  const test::Topology t = test::topology(mesh);
  EXPECT_TRUE(t.closed());
  EXPECT_EQ(t.euler, 0);
  EXPECT_NEAR(test::volume(mesh), 2 * std::numbers::pi * std::numbers::pi * 0.6 * 0.04, 0.01);
}

TEST(MarchingCubes, APlaneIsExact) {
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, -0.5).normalized();
  const TriangleMesh mesh =
      marching_cubes(grid({20, 17, 33}, [&](const Eigen::Vector3d& p) { return normal.dot(p) + 0.4137; }));
  ASSERT_FALSE(mesh.empty());
  for (const Eigen::Vector3f& v : mesh.vertices) ASSERT_NEAR(normal.dot(v.cast<double>()), -0.4137, 3e-7);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    ASSERT_GE(mesh.area_normal(i).dot(normal), 0) << "seen from where the values are positive";
  EXPECT_EQ(test::topology(mesh).branching, 0u);
}

TEST(MarchingCubes, LevelAndSide) {
  const auto density = grid(Eigen::Vector3i::Constant(32), [](const Eigen::Vector3d& p) { return 1 / (1 + p.norm()); });
  const TriangleMesh solid =
      marching_cubes(density, {.level = 0.625F, .inside = IsoSurface::Inside::above});  // radius 0.6
  EXPECT_NEAR(test::volume(solid), 4.0 / 3 * std::numbers::pi * 0.216, 0.01);
  const TriangleMesh hollow = marching_cubes(density, {.level = 0.625F});
  EXPECT_NEAR(test::volume(hollow), -4.0 / 3 * std::numbers::pi * 0.216, 0.01);
}

TEST(MarchingCubes, UnknownSamplesLeaveHolesAndNoLooseVertices) {
  ScalarGrid whole = grid(Eigen::Vector3i::Constant(24), [](const Eigen::Vector3d& p) { return p.norm() - 0.7; });
  std::vector<float> values = whole.values();
  Rng rng(3);
  for (float& v : values)
    if (rng.uniform() < 0.1) v = nan;
  const TriangleMesh mesh = marching_cubes(ScalarGrid(whole.size(), whole.origin(), whole.spacing_m(), values));
  mesh.validate("test");
  const test::Topology t = test::topology(mesh);
  EXPECT_GT(t.open, 0u);
  EXPECT_EQ(t.branching, 0u);
  EXPECT_EQ(t.unused, 0u);
  EXPECT_LT(mesh.triangles.size(), marching_cubes(whole).triangles.size());
}

TEST(MarchingCubes, NothingThere) {
  for (const float value : {1.0F, -1.0F, nan}) {
    const TriangleMesh mesh = marching_cubes(grid({9, 9, 9}, [&](const Eigen::Vector3d&) { return value; }));
    EXPECT_TRUE(mesh.empty());
    EXPECT_TRUE(mesh.vertices.empty());
  }
}

TEST(MarchingCubes, DoesNotDependOnTheThreads) {
  const ScalarGrid field = noise({40, 33, 50}, 11, 1);
  const auto run = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return marching_cubes(field); });
  };
  const TriangleMesh one = run(1);
  for (const int threads : {2, 8}) {
    const TriangleMesh many = run(threads);
    EXPECT_EQ(many.vertices, one.vertices);
    EXPECT_EQ(many.triangles, one.triangles);
  }
}

TEST(MarchingCubes, Refuses) {
  EXPECT_THROW(static_cast<void>(marching_cubes(noise({4, 4, 4}, 1, 1), {.level = nan})), Error);
  EXPECT_THROW(ScalarGrid({4, 4, 4}, {0, 0, 0}, {1, 1, 1}, std::vector<float>(63)), Error);
  EXPECT_THROW(ScalarGrid({1, 8, 8}, {0, 0, 0}, {1, 1, 1}, std::vector<float>(64)), Error);
  EXPECT_THROW(ScalarGrid({2, 2, 2}, {0, 0, 0}, {1, 0, 1}, std::vector<float>(8)), Error);
}

}  // namespace
}  // namespace vantage

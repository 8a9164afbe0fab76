// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/geometry/grid_ray.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

namespace vantage {
namespace {

const VoxelGrid grid = VoxelGrid::dividing({Eigen::Vector3d(-1, -2, 0), Eigen::Vector3d(3.1, 2, 2.6)}, 0.21);

Eigen::Vector3d random_point(Rng& rng, double reach) {
  return {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-reach, reach)};
}
/// Directions of all kinds: any, along axes, along diagonals.
Eigen::Vector3d random_direction(Rng& rng) {
  Eigen::Vector3d d = random_point(rng, 1);
  const auto kind = rng.index(3);
  for (double& x : d)
    if (kind == 1)
      x = std::round(1.4 * x);
    else if (kind == 2 && rng.index(2) == 0)
      x = 0;
  return d.isZero() ? Eigen::Vector3d(0, 0, -1) : d;
}

struct Met {
  Eigen::Vector3i voxel;
  double enter;
};
std::vector<Met> walk(GridRay ray) {
  std::vector<Met> met;
  for (; ray; ray.step()) {
    met.push_back({ray.voxel(), ray.enter()});
    EXPECT_EQ(ray.local(), local_of(ray.voxel()));
    EXPECT_EQ(ray.block(), block_of(ray.voxel()));
  }
  return met;
}

TEST(GridRay, MeetsEveryVoxelThatTheRayCutsAndNoOther) {
  Rng rng(1);
  for (int n = 0; n < 500; ++n) {
    const Eigen::Vector3d from = random_point(rng, 4), direction = random_point(rng, 1);
    const std::vector<Met> met = walk(GridRay(grid, from, direction));
    std::size_t cut = 0;
    // Slow and obvious: the slabs of every voxel.
    for (int z = 0; z < grid.size().z(); ++z)
      for (int y = 0; y < grid.size().y(); ++y)
        for (int x = 0; x < grid.size().x(); ++x) {
          const Box3 box = grid.box_of({x, y, z});
          const Eigen::Array3d a = (box.min() - from).array() / direction.array(),
                               b = (box.max() - from).array() / direction.array();
          const double enter = std::max(0.0, a.min(b).maxCoeff()), leave = a.max(b).minCoeff();
          if (leave - enter < 1e-9) continue;
          ++cut;
          bool found = false;
          for (const Met& m : met)
            found = found || (m.voxel == Eigen::Vector3i(x, y, z) && std::abs(m.enter - enter) < 1e-9);
          ASSERT_TRUE(found) << x << " " << y << " " << z;
        }
    ASSERT_LE(met.size(), cut + 3);  // some that it only touches
    for (std::size_t i = 1; i < met.size(); ++i) {
      ASSERT_EQ((met[i].voxel - met[i - 1].voxel).cwiseAbs().sum(), 1);
      ASSERT_GE(met[i].enter, met[i - 1].enter);
    }
  }
}

TEST(GridRay, LeavesABlockAsStepsWould) {
  Rng rng(2);
  const VoxelGrid cubes = VoxelGrid::on_lattice({Eigen::Vector3d(-2, -2, -2), Eigen::Vector3d(3, 2.25, 2)}, 0.25);
  for (int n = 0; n < 20'000; ++n) {
    Eigen::Vector3d from = random_point(rng, 2);
    if (rng.index(3) == 0) from = (from / 0.25).array().round() * 0.25;  // on borders, where many are crossed at once
    const VoxelGrid& g = rng.index(2) == 0 ? grid : cubes;
    GridRay jumping(g, from, random_direction(rng)), stepping = jumping;
    while (jumping) {
      const Eigen::Vector3i block = stepping.block();
      while (stepping && stepping.block() == block) stepping.step();
      jumping.leave_block();
      ASSERT_EQ(static_cast<bool>(jumping), static_cast<bool>(stepping));
      if (!jumping) break;
      ASSERT_EQ(jumping.voxel(), stepping.voxel());
      ASSERT_EQ(jumping.enter(), stepping.enter());
      ASSERT_EQ(jumping.leave(), stepping.leave());
    }
  }
}

TEST(GridRay, EndsWhereItShould) {
  const VoxelGrid g = VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(10, 10, 10)}, 1);
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), middle(0.5, 0.5, 0.5);
  EXPECT_EQ(walk(GridRay(g, middle, x)).size(), 10u);
  EXPECT_EQ(walk(GridRay(g, middle, x, 4)).size(), 5u);
  EXPECT_EQ(walk(GridRay(g, middle, 2 * x, 4)).size(), 9u);
  EXPECT_EQ(walk(GridRay(g, middle, x, 0)).size(), 1u);
  EXPECT_EQ(walk(GridRay(g, middle, -x)).size(), 1u);
  EXPECT_EQ(walk(GridRay(g, middle - 3 * x, x)).size(), 10u);
  EXPECT_EQ(walk(GridRay(g, middle - 3 * x, x)).front().enter, 2.5);
  EXPECT_FALSE(GridRay(g, middle - 3 * x, -x));
  EXPECT_FALSE(GridRay(g, middle - 3 * x, x, 2));
  EXPECT_FALSE(GridRay(g, {0.5, 10.5, 0.5}, x));
  EXPECT_FALSE(GridRay(g, {-5, -5, -5}, {1, 1, -1}));
  EXPECT_EQ(walk(GridRay(g, {-5, -5, -5}, {1, 1, 1})).size(), 28u);
}

}  // namespace
}  // namespace vantage

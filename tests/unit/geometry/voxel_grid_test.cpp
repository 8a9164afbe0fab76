// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

#include "drawn_voxels.hpp"
#include "message_of.hpp"

namespace vantage {
namespace {

static_assert(NavigableMap<test::DrawnVoxels>);

TEST(VoxelGrid, CubesOnTheLatticeHoldTheBox) {
  const Box3 box(Eigen::Vector3d(-0.95, 0.2, 0.05), Eigen::Vector3d(1.0, 0.8, 2.41));
  const VoxelGrid grid = VoxelGrid::on_lattice(box, 0.2);
  EXPECT_EQ(grid.size(), Eigen::Vector3i(10, 3, 13));
  EXPECT_TRUE(grid.box().contains(box));
  EXPECT_TRUE(grid.origin().isApprox(Eigen::Vector3d(-1, 0.2, 0)));
  EXPECT_EQ(grid.voxel_m(), Eigen::Vector3d::Constant(0.2));
  EXPECT_EQ(grid.count(), 390U);
}

TEST(VoxelGrid, DividingABoxKeepsIt) {
  const Box3 box(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0.6, 0.45));
  const VoxelGrid grid = VoxelGrid::dividing(box, 0.2);
  EXPECT_EQ(grid.size(), Eigen::Vector3i(5, 3, 3));
  EXPECT_TRUE(grid.box().isApprox(box));
  EXPECT_NEAR(grid.voxel_m().z(), 0.15, 1e-12);
}

TEST(VoxelGrid, PointsFindTheirVoxels) {
  const VoxelGrid grid = VoxelGrid::on_lattice({Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, 1, 1)}, 0.25);
  Rng rng(1);
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector3d p(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-1, 2));
    const Eigen::Vector3i v = grid.voxel_at(p);
    EXPECT_EQ(grid.contains(v), grid.box().contains(p));
    EXPECT_TRUE(grid.box_of(v).contains(p));
    EXPECT_EQ(grid.voxel_at(grid.centre(v)), v);
  }
}

TEST(VoxelGrid, RefusesWhatIsNoGrid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Box3 box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
  EXPECT_REFUSED(VoxelGrid::on_lattice(Box3(), 0.1), "box");
  EXPECT_REFUSED(VoxelGrid::on_lattice(box, nan), "edge_m");
  EXPECT_REFUSED(VoxelGrid::dividing(box, 1e-5), "larger voxels");
  EXPECT_REFUSED(VoxelGrid::dividing(Box3(box.min(), box.min()), 0.1), "volume");
}

TEST(VoxelBits, AreASetOfVoxels) {
  Rng rng(2);
  VoxelBits a, b;
  std::vector<std::size_t> in_both;
  for (std::size_t local = 0; local < 512; ++local) {
    const bool in_a = rng.uniform() < 0.5, in_b = rng.uniform() < 0.5;
    if (in_a) a.set(local);
    if (in_b) b.set(local);
    if (in_a && in_b) in_both.push_back(local);
    EXPECT_EQ(a[local], in_a);
    EXPECT_EQ(local_of(voxel_of({3, 1, 4}, local)), local);
    EXPECT_EQ(block_of(voxel_of({3, 1, 4}, local)), Eigen::Vector3i(3, 1, 4));
  }
  std::vector<std::size_t> listed;
  (a & b).for_each([&](std::size_t local) { listed.push_back(local); });
  EXPECT_EQ(listed, in_both);
  EXPECT_EQ((a & b).count(), static_cast<int>(in_both.size()));
  EXPECT_EQ((a | b).count() + (a & b).count(), a.count() + b.count());
  EXPECT_EQ((a | ~a), VoxelBits::all());
  EXPECT_FALSE((a & ~a).any());
  b.reset(in_both.front());
  EXPECT_FALSE(b[in_both.front()]);
}

TEST(VoxelBits, InsideOfTheGrid) {
  const VoxelGrid grid =
      VoxelGrid::on_lattice({Eigen::Vector3d::Zero(), Eigen::Vector3d(1.0, 1.9, 0.3)}, 0.1);  // 10 x 19 x 3
  int total = 0;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 2; ++z) {
        const Eigen::Vector3i block(x, y, z);
        const VoxelBits bits = VoxelBits::inside(grid, block);
        for (std::size_t local = 0; local < 512; ++local) EXPECT_EQ(bits[local], grid.contains(voxel_of(block, local)));
        total += bits.count();
      }
  EXPECT_EQ(total, 570);
}

}  // namespace
}  // namespace vantage

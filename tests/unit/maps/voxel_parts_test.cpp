// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/maps/voxel/class_counts.hpp>
#include <vantage/maps/voxel/clearance.hpp>
#include <vantage/maps/voxel/frontier_bits.hpp>
#include <vantage/maps/voxel/ray_cast.hpp>
#include <vantage/maps/voxel/voxel_blocks.hpp>

#include "message_of.hpp"

namespace vantage {
namespace {

// Random bits in 7 x 7 x 7 blocks around one.
struct Surroundings {
  Surroundings(Rng rng, double density) {
    for (VoxelBits& b : blocks)
      for (std::size_t i = 0; i < 512; ++i)
        if (rng.uniform() < density) b.set(i);
  }
  VoxelBits operator()(int x, int y, int z) const {
    return blocks[static_cast<std::size_t>(((z + 3) * 7 + y + 3) * 7 + x + 3)];
  }
  /// By the distance from voxel 0 of the block in the middle.
  [[nodiscard]] bool at(const Eigen::Vector3i& v) const {
    const Eigen::Vector3i shifted = v + Eigen::Vector3i::Constant(24);
    const Eigen::Vector3i block = block_of(shifted) - Eigen::Vector3i::Constant(3);
    return (*this)(block.x(), block.y(), block.z())[local_of(shifted)];
  }
  std::vector<VoxelBits> blocks = std::vector<VoxelBits>(343);
};

TEST(VoxelParts, BesideIsTheSixNeighbours) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Surroundings bits(Rng(seed), 0.1);
    const VoxelBits found = beside(bits);
    for (std::size_t local = 0; local < 512; ++local) {
      bool expected = false;
      for (int a = 0; a < 3; ++a)
        expected |= bits.at(voxel_of({0, 0, 0}, local) + Eigen::Vector3i::Unit(a)) ||
                    bits.at(voxel_of({0, 0, 0}, local) - Eigen::Vector3i::Unit(a));
      ASSERT_EQ(found[local], expected) << local;
    }
  }
}

template <class Rule>
void expect_dilated(const Eigen::Vector3d& voxel_m, double clearance_m, double density) {
  const Surroundings bits(Rng(9), density);
  const Dilation dilation(Rule{}, voxel_m, clearance_m);
  const VoxelBits grown = dilation(bits);
  const int reach = static_cast<int>(clearance_m / voxel_m.minCoeff() + 1);
  for (std::size_t local = 0; local < 512; ++local) {
    bool expected = false;
    for (int z = -reach; z <= reach && !expected; ++z)
      for (int y = -reach; y <= reach && !expected; ++y)
        for (int x = -reach; x <= reach && !expected; ++x)
          expected = Rule::reaches(Eigen::Vector3d(x, y, z), voxel_m, clearance_m) &&
                     bits.at(voxel_of({0, 0, 0}, local) + Eigen::Vector3i(x, y, z));
    ASSERT_EQ(grown[local], expected) << local << " at " << clearance_m;
  }
}

TEST(VoxelParts, DilationIsWhatTheRuleReaches) {
  for (const double clearance_m : {0.0, 0.04, 0.1, 0.25, 0.31, 0.8, 1.27, 2.3})
    for (const double density : {2e-5, 1e-3, 0.02}) {
      expect_dilated<BallInFreeVoxels>({0.1, 0.1, 0.1}, clearance_m, density);
      expect_dilated<NoOccupiedCentreInBall>({0.11, 0.1, 0.13}, clearance_m, density);
    }
  EXPECT_REFUSED(Dilation(BallInFreeVoxels{}, Eigen::Vector3d::Constant(0.1), 3), "24 voxels");
  EXPECT_REFUSED(Dilation(BallInFreeVoxels{}, Eigen::Vector3d::Constant(0.1), 1e300), "24 voxels");
}

TEST(VoxelParts, TouchingIsNotReaching) {
  const Eigen::Vector3d cube = Eigen::Vector3d::Constant(0.2);
  EXPECT_FALSE(BallInFreeVoxels::reaches({2, 0, 0}, cube, 0.3));  // its face is 0.3 m away
  EXPECT_TRUE(BallInFreeVoxels::reaches({2, 0, 0}, cube, 0.301));
  EXPECT_TRUE(BallInFreeVoxels::reaches({1, 1, 1}, cube, 0.3));
  EXPECT_TRUE(BallInFreeVoxels::reaches({0, 0, 0}, cube, 0));
  EXPECT_FALSE(BallInFreeVoxels::reaches({1, 0, 0}, cube, 0));
}

// Step by step from the voxel of `from` to that of `to`, face by face, and through what the segment crosses.
TEST(VoxelParts, AWalkCrossesTheVoxelsOfItsSegment) {
  const Eigen::Vector3i size(9, 14, 6);
  Rng rng(3);
  for (int trial = 0; trial < 300; ++trial) {
    const double spread = trial % 2 == 0 ? 1 : 3;  // from inside and from outside
    Eigen::Vector3d from, to;
    for (int a = 0; a < 3; ++a) {
      from[a] = size[a] * (0.5 + spread * rng.uniform(-0.5, 0.5));
      to[a] = 0.5 + static_cast<double>(rng.index(static_cast<std::uint64_t>(size[a])));
    }
    std::vector<Eigen::Vector3i> cells;
    VoxelWalk(from, to, size)([&](int x, int y, int z) { cells.emplace_back(x, y, z); });
    cells.push_back(to.cast<int>());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      ASSERT_TRUE((cells[i].array() >= 0).all() && (cells[i].array() < size.array()).all());
      if (i > 0) { ASSERT_EQ((cells[i] - cells[i - 1]).cwiseAbs().sum(), 1); }
      const Eigen::Vector3d along = to - from;
      const Eigen::Array3d a = (cells[i].cast<double>() - from).array() / along.array(),
                           b = (cells[i].cast<double>() + Eigen::Vector3d::Ones() - from).array() / along.array();
      ASSERT_LE(a.min(b).maxCoeff(), a.max(b).minCoeff() + 1e-9) << "the segment crosses it";
    }
    if (spread == 1) { EXPECT_EQ(cells.front(), Eigen::Vector3i(from.cast<int>())); }
  }
}

TEST(VoxelParts, AWalkAlongAnAxisAndToItself) {
  int steps = 0;
  const auto count = [&](int, int, int) { ++steps; };
  VoxelWalk({0.5, 2.5, 2.5}, {4.5, 2.5, 2.5}, {5, 5, 5})(count);
  EXPECT_EQ(steps, 4);
  VoxelWalk({2.5, 2.5, 2.5}, {2.5, 2.5, 2.5}, {5, 5, 5})(count);
  EXPECT_EQ(steps, 4);
  VoxelWalk({2.5, 1e7, 2.5}, {2.5, 2.5, 2.5}, {5, 5, 5})(count);
  EXPECT_EQ(steps, 6) << "no step outside";
}

TEST(VoxelParts, BlocksStayWhereTheyAre) {
  const VoxelGrid grid = VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(80, 80, 8)}, 0.1);
  VoxelBlocks<VoxelBlock> blocks(grid, std::size_t{1} << 30);
  EXPECT_EQ(blocks.size(), Eigen::Vector3i(100, 100, 10));
  const std::size_t empty = blocks.bytes();
  EXPECT_LT(empty, 5U * 100000);
  blocks.reserve(1);
  blocks.make({3, 4, 5});
  const VoxelBlock* first = blocks.find({3, 4, 5});
  ASSERT_NE(first, nullptr);
  blocks.reserve(5000);
  for (int i = 0; i < 5000; ++i) blocks.make({i % 100, i / 100, 9});
  EXPECT_EQ(blocks.find({3, 4, 5}), first);
  EXPECT_EQ(blocks.count(), 5001U);
  EXPECT_EQ(blocks.known()[0], Eigen::Vector3i(3, 4, 5));
  EXPECT_EQ(blocks.find({4, 4, 5}), nullptr);
  for (const Eigen::Vector3i& outside : {Eigen::Vector3i(-1, 0, 0), Eigen::Vector3i(0, 100, 0)})
    EXPECT_EQ(blocks.slot(outside), -1);
  const auto bytes_a_voxel = [&] {
    return static_cast<double>(blocks.bytes() - empty) / static_cast<double>(512 * blocks.count());
  };
  EXPECT_NEAR(bytes_a_voxel(), 4.65, 0.1) << "the last slab is not full";
  while (blocks.count() % 64 != 0) blocks.make({static_cast<int>(blocks.count() % 64), 99, 9});
  EXPECT_NEAR(bytes_a_voxel(), 4.65, 0.02) << "what VoxelMap says";

  VoxelBlocks<VoxelBlock> tight(grid, empty + 100000);
  EXPECT_REFUSED((tight.reserve(1000), 0), "max_bytes");
  EXPECT_EQ(tight.bytes(), empty);
  EXPECT_REFUSED((VoxelBlocks<VoxelBlock>(grid, 1000)), "max_bytes");
}

TEST(VoxelParts, LargeBlocksComeInSmallSlabs) {
  const VoxelGrid grid = VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(8, 8, 8)}, 0.1);
  const auto of_one = []<class Block>(const VoxelGrid& g, Block*) {
    VoxelBlocks<Block> blocks(g, std::size_t{1} << 30);
    const std::size_t empty = blocks.bytes();
    blocks.reserve(1);
    return (blocks.bytes() - empty) / sizeof(Block);
  };
  EXPECT_EQ(of_one(grid, static_cast<ClassCounts<100>::Block*>(nullptr)), 64U);
  EXPECT_EQ(of_one(grid, static_cast<ClassCounts<1024>::Block*>(nullptr)), 8U);
  EXPECT_EQ(of_one(grid, static_cast<ClassCounts<20000>::Block*>(nullptr)), 1U);
}

TEST(VoxelParts, ClassCountsKeepTheirProportions) {
  ClassCounts<3>::Block block;
  for (int i = 0; i < 5; ++i) block.add(17, 2);
  block.add(17, 1);
  EXPECT_EQ(block.of(17)[2], 5U);
  EXPECT_EQ(block.of(17)[1], 1U);
  EXPECT_EQ(block.of(18)[2], 0U);
  block.settle();
  EXPECT_EQ(block.of(17)[2], 5U);
  block.counts[17 * 3 + 2] = 1U << 30;
  block.counts[17 * 3 + 1] = 1U << 20;
  block.settle();
  EXPECT_EQ(block.of(17)[2], 1U << 29);
  EXPECT_EQ(block.of(17)[1], 1U << 19);
}

}  // namespace
}  // namespace vantage

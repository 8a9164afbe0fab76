// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The voxel map of chapter 6 against numbers of the published code: a toy room of 13 x 11 x 8 voxels after each of
// three frames. Log-odds to 2e-6 (ours are floats, and the poses are rotations to 1e-8); every mask exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include <vantage/io/csv.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

#include "golden.hpp"

namespace {

using namespace vantage;
using Published = VoxelMap<Projective, NoClasses, NoOccupiedCentreInBall>;

using GoldenVoxels = test::ToyRoom;

TEST_F(GoldenVoxels, LogOddsAfterEachFrame) {
  for (int k = 0; k < 3; ++k) {
    const Published map = after<Published>(k + 1);
    const CsvTable t = read_csv(file(concat("after", k, ".csv")));
    ASSERT_EQ(map.grid().size(), Eigen::Vector3i(13, 11, 8));
    ASSERT_EQ(t.rows(), map.grid().count());
    for (std::size_t row = 0; row < t.rows(); ++row) {
      const Eigen::Vector3i voxel = voxel_in(row);
      EXPECT_NEAR(map.log_odds(voxel), t.column("log_odds")[row], 2e-6) << k << ": " << voxel.transpose();
      EXPECT_EQ(map.explored(voxel), t.column("unexplored")[row] == 0) << k << ": " << voxel.transpose();
    }
  }
}

// A fresh map of one frame knows what that frame hits (log-odds > 0) and passes (< 0).
TEST_F(GoldenVoxels, HitsAndPassesOfEachFrame) {
  for (int k = 0; k < 3; ++k) {
    auto map = unknown<Published>(k == 0 ? 1.95 : 5);
    map.integrate(frame(k));
    const CsvTable t = read_csv(file(concat("after", k, ".csv")));
    for (std::size_t row = 0; row < t.rows(); ++row) {
      const Eigen::Vector3i voxel = voxel_in(row);
      EXPECT_EQ(map.log_odds(voxel) > 0, t.column("hit")[row] == 1) << k << ": " << voxel.transpose();
      EXPECT_EQ(map.log_odds(voxel) < 0, t.column("pass")[row] == 1) << k << ": " << voxel.transpose();
    }
  }
}

TEST_F(GoldenVoxels, StatesFrontierAndMarginAfterAllFrames) {
  const Published map = after<Published>(3);
  const CsvTable t = read_csv(file("masks.csv"));
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const Eigen::Vector3i voxel = voxel_in(row);
    EXPECT_NEAR(map.probability(voxel), t.column("prob")[row], 1e-6);
    EXPECT_EQ(map.state(voxel) == Space::free, t.column("free")[row] == 1) << voxel.transpose();
    EXPECT_EQ(map.state(voxel) == Space::occupied, t.column("occ")[row] == 1) << voxel.transpose();
    EXPECT_EQ(map.frontier_in(block_of(voxel))[local_of(voxel)], t.column("frontier")[row] == 1) << voxel.transpose();
    EXPECT_EQ(map.navigable(voxel), t.column("free_margin_ball0.3m")[row] == 1) << voxel.transpose();
  }
  EXPECT_EQ(map.counts().frontier, 120U);
  EXPECT_EQ(map.counts().navigable, 106U);
}

TEST_F(GoldenVoxels, NormalsOfTheFrontier) {
  const Published map = after<Published>(3);
  const CsvTable t = read_csv(file("masks.csv"));
  std::size_t compared = 0;
  for (const Region& region : map.regions(frontier{})) {
    const Eigen::Vector3i v = map.grid().voxel_at(region.centre);
    const std::size_t row = row_of(v);
    if (t.column("lowconf")[row] == 1) continue;  // has the normal of its surfels
    EXPECT_LT((region.normal - test::xyz(t, "roi_n", row)).norm(), 1e-6) << v.transpose();
    ++compared;
  }
  EXPECT_GT(compared, 60U);
}

}  // namespace

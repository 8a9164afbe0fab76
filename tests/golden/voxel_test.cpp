// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The voxel map of chapter 6 against numbers of the published code: a toy room of 13 x 11 x 8 voxels after each of
// three frames. Log-odds to 2e-6 (ours are floats, and the poses are rotations to 1e-8); every mask exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include <Eigen/Core>

#include <vantage/core/bytes.hpp>
#include <vantage/core/units.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/io/npy.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

#ifndef VANTAGE_GOLDEN_DIR
#define VANTAGE_GOLDEN_DIR ""
#endif

namespace {

using namespace vantage;
using Published = VoxelMap<Projective, NoClasses, NoOccupiedCentreInBall>;

std::filesystem::path golden(const std::string& file) {
  return std::filesystem::path(VANTAGE_GOLDEN_DIR) / "surfel" / "voxel" / file;
}

class GoldenVoxels : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(VANTAGE_GOLDEN_DIR).empty() || !std::filesystem::exists(golden("grid.csv")))
      GTEST_SKIP() << "VANTAGE_GOLDEN_DIR has no surfel/voxel/ (now \"" << VANTAGE_GOLDEN_DIR << "\")";
  }
};

Published::Config config(double max_m) {
  Published::Config c;
  c.bounds = {Eigen::Vector3d(-0.1, -0.05, 0), Eigen::Vector3d(2.45, 2.05, 1.5)};
  c.range.max_m = max_m;
  return c;
}

// Pixels out of range (-1) clear as far as the sensor sees, missing ones (-2) say nothing.
Frame frame(int k) {
  Frame f;
  f.camera = Camera::from_fov(64, 64, deg(60));
  std::ifstream file(golden(concat("pose", k, "_c2w.csv")));  // four rows without a header
  const CsvTable pose = parse_csv("x,y,z,t\n" + std::string(std::istreambuf_iterator<char>(file), {}));
  for (Eigen::Index r = 0; r < 4; ++r)
    for (Eigen::Index c = 0; c < 4; ++c)
      f.view.T_W_C.matrix()(r, c) = pose.column(static_cast<std::size_t>(c))[static_cast<std::size_t>(r)];
  const auto depth = read_npy(golden(concat("depth", k, ".npy"))).values<double>("depth");
  f.depth.resize(64, 64);
  for (std::size_t i = 0; i < depth.size(); ++i)
    f.depth.data()[i] = depth[i] == -1   ? 100.0F
                        : depth[i] == -2 ? std::numeric_limits<float>::quiet_NaN()
                                         : static_cast<float>(depth[i]);
  return f;
}

// f(voxel, row of the tables)
template <class F>
void for_rows(const VoxelGrid& grid, F&& f) {
  std::size_t row = 0;
  for (int x = 0; x < grid.size().x(); ++x)
    for (int y = 0; y < grid.size().y(); ++y)
      for (int z = 0; z < grid.size().z(); ++z) f(Eigen::Vector3i(x, y, z), row++);
}

// The first frame was cleared to 1.95 m where it saw nothing, the others to 5 m.
Published after(int frames) {
  Published near(config(1.95)), map(config(5));
  near.integrate(frame(0));
  Sink sink;
  near.save(sink);
  Source source(sink.bytes());
  map.load(source);
  for (int k = 1; k < frames; ++k) map.integrate(frame(k));
  return map;
}

TEST_F(GoldenVoxels, LogOddsAfterEachFrame) {
  for (int k = 0; k < 3; ++k) {
    const Published map = after(k + 1);
    const CsvTable t = read_csv(golden(concat("after", k, ".csv")));
    ASSERT_EQ(map.grid().size(), Eigen::Vector3i(13, 11, 8));
    ASSERT_EQ(t.rows(), map.grid().count());
    for_rows(map.grid(), [&](const Eigen::Vector3i& voxel, std::size_t row) {
      EXPECT_NEAR(map.log_odds(voxel), t.column("log_odds")[row], 2e-6) << k << ": " << voxel.transpose();
      EXPECT_EQ(map.explored(voxel), t.column("unexplored")[row] == 0) << k << ": " << voxel.transpose();
    });
  }
}

// A fresh map of one frame knows what that frame hits (log-odds > 0) and passes (< 0).
TEST_F(GoldenVoxels, HitsAndPassesOfEachFrame) {
  for (int k = 0; k < 3; ++k) {
    Published map(config(k == 0 ? 1.95 : 5));
    map.integrate(frame(k));
    const CsvTable t = read_csv(golden(concat("after", k, ".csv")));
    for_rows(map.grid(), [&](const Eigen::Vector3i& voxel, std::size_t row) {
      EXPECT_EQ(map.log_odds(voxel) > 0, t.column("hit")[row] == 1) << k << ": " << voxel.transpose();
      EXPECT_EQ(map.log_odds(voxel) < 0, t.column("pass")[row] == 1) << k << ": " << voxel.transpose();
    });
  }
}

TEST_F(GoldenVoxels, StatesFrontierAndMarginAfterAllFrames) {
  const Published map = after(3);
  const CsvTable t = read_csv(golden("masks.csv"));
  for_rows(map.grid(), [&](const Eigen::Vector3i& voxel, std::size_t row) {
    EXPECT_NEAR(map.probability(voxel), t.column("prob")[row], 1e-6);
    EXPECT_EQ(map.state(voxel) == Space::free, t.column("free")[row] == 1) << voxel.transpose();
    EXPECT_EQ(map.state(voxel) == Space::occupied, t.column("occ")[row] == 1) << voxel.transpose();
    EXPECT_EQ(map.frontier_in(block_of(voxel))[local_of(voxel)], t.column("frontier")[row] == 1) << voxel.transpose();
    EXPECT_EQ(map.navigable(voxel), t.column("free_margin_ball0.3m")[row] == 1) << voxel.transpose();
  });
  EXPECT_EQ(map.counts().frontier, 120U);
  EXPECT_EQ(map.counts().navigable, 106U);
}

TEST_F(GoldenVoxels, NormalsOfTheFrontier) {
  const Published map = after(3);
  const CsvTable t = read_csv(golden("masks.csv"));
  std::size_t compared = 0;
  for (const Region& region : map.regions(frontier{})) {
    const Eigen::Vector3i v = map.grid().voxel_at(region.centre);
    const auto row = static_cast<std::size_t>((v.x() * 11 + v.y()) * 8 + v.z());
    if (t.column("lowconf")[row] == 1) continue;  // has the normal of its surfels
    const Eigen::Vector3d normal(t.column("roi_nx")[row], t.column("roi_ny")[row], t.column("roi_nz")[row]);
    EXPECT_LT((region.normal - normal).norm(), 1e-6) << v.transpose();
    ++compared;
  }
  EXPECT_GT(compared, 60U);
}

}  // namespace

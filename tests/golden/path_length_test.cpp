// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/planning/a_star.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/io/csv.hpp>

#include "drawn_voxels.hpp"

namespace vantage {
namespace {

/// Free where the published code says so, navigable where its own mask with the margin does.
class Masked : public test::DrawnVoxels {
 public:
  using DrawnVoxels::DrawnVoxels;
  std::vector<Eigen::Vector3i> open;
  [[nodiscard]] bool navigable(const Eigen::Vector3i& v) const {
    return std::find(open.begin(), open.end(), v) != open.end();
  }
  [[nodiscard]] VoxelBits navigable_in(const Eigen::Vector3i& block) const {
    VoxelBits bits;
    for (const Eigen::Vector3i& v : open)
      if (block_of(v) == block) bits.set(local_of(v));
    return bits;
  }
};

/// One column with a title; "inf" where there is no path, which read_csv() does not take for a number.
std::vector<double> read_lengths(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<double> lengths;
  while (std::getline(in, line)) lengths.push_back(std::stod(line));
  return lengths;
}

TEST(GoldenPathLength, ThePublishedCodesLengths) {
  if (std::string(VANTAGE_GOLDEN_DIR).empty()) GTEST_SKIP() << "VANTAGE_GOLDEN_DIR is not set";
  const std::string folder = std::string(VANTAGE_GOLDEN_DIR) + "/surfel/voxel/";
  const VoxelGrid grid = VoxelGrid::dividing({Eigen::Vector3d(-0.1, -0.05, 0), Eigen::Vector3d(2.45, 2.05, 1.5)}, 0.2);
  ASSERT_EQ(grid.size(), Eigen::Vector3i(13, 11, 8));
  const CsvTable masks = read_csv(folder + "masks.csv");
  const std::vector<double> expected_m = read_lengths(folder + "path_length.csv");
  ASSERT_EQ(masks.rows(), 13u * 11 * 8);
  ASSERT_EQ(expected_m.size(), masks.rows());

  Masked map(grid, 0.3);
  std::vector<View> goals;
  for (std::size_t i = 0; i < masks.rows(); ++i) {  // z runs fastest
    const auto k = static_cast<int>(i);
    const Eigen::Vector3i voxel(k / 88, k / 8 % 11, k % 8);
    map.draw(voxel, masks.column("free")[i] != 0  ? Space::free
                    : masks.column("occ")[i] != 0 ? Space::occupied
                                                  : Space::unknown);
    if (masks.column("free_margin_ball0.3m")[i] != 0) map.open.push_back(voxel);
    const Eigen::Vector3d centre = grid.centre(voxel);
    goals.push_back(nadir(centre.x(), centre.y(), centre.z()));
  }
  const std::vector<double> lengths_m = AStar({.own_ball_m = 0.3}).lengths_m(map, goals[283], goals);
  std::size_t reachable = 0;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    reachable += std::isfinite(expected_m[i]);
    if (std::isfinite(expected_m[i]))
      EXPECT_NEAR(lengths_m[i], expected_m[i], 1e-9) << i;
    else
      EXPECT_EQ(lengths_m[i], expected_m[i]) << i;
  }
  EXPECT_EQ(reachable, 120u);
}

}  // namespace
}  // namespace vantage

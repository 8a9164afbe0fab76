// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include <vantage/geometry/visible_voxels.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/npy.hpp>

// The visible unexplored voxels that the published code counts from eight views, given what it rendered there.
namespace vantage {
namespace {

TEST(GoldenUnexplored, ThePublishedCodesCounts) {
  if (std::string(VANTAGE_GOLDEN_DIR).empty()) GTEST_SKIP() << "VANTAGE_GOLDEN_DIR is not set";
  const std::string folder = std::string(VANTAGE_GOLDEN_DIR) + "/surfel/voxel/";
  // What grid.csv says.
  const Box3 box(Eigen::Vector3d(-0.1, -0.05, 0), Eigen::Vector3d(2.45, 2.05, 1.5));
  const VoxelGrid grid = VoxelGrid::dividing(box, 0.2);
  ASSERT_EQ(grid.size(), Eigen::Vector3i(13, 11, 8));
  const Camera camera{64, 64, 55.42562584220408, 55.42562584220408, 32, 32};

  const CsvTable after = read_csv(folder + "after2.csv");
  ASSERT_EQ(after.rows(), grid.count());
  const auto unexplored_in = [&](const Eigen::Vector3i& block) {
    VoxelBits bits;
    VoxelBits::inside(grid, block).for_each([&](std::size_t local) {
      const Eigen::Vector3i v = voxel_of(block, local);
      const int row = (v.x() * 11 + v.y()) * 8 + v.z();
      if (after.column("unexplored")[static_cast<std::size_t>(row)] == 1) bits.set(local);
    });
    return bits;
  };
  std::string names = "p0";  // the file has no header
  for (int k = 1; k < 16; ++k) names += concat(",p", k);
  const CsvTable poses = parse_csv(names + "\n" + read_file(folder + "candidates_c2w.csv", 1 << 20)),
                 expected = read_csv(folder + "utility.csv");
  ASSERT_EQ(expected.rows(), 8u);
  for (std::size_t i = 0; i < expected.rows(); ++i) {
    View view;
    for (std::size_t k = 0; k < 16; ++k)
      view.T_W_C.matrix()(static_cast<int>(k / 4), static_cast<int>(k % 4)) = poses.column(k)[i];
    const Tensor tensor = read_npy(folder + "cand" + std::to_string(i) + "_D.npy");
    const auto values = tensor.values<double>("depth");
    ASSERT_EQ(values.size(), 64u * 64u);
    Image<float> depth(64, 64);
    for (Eigen::Index p = 0; p < depth.size(); ++p) {
      const auto d = static_cast<float>(values[static_cast<std::size_t>(p)]);
      depth(p) = d > 0 ? d : std::numeric_limits<float>::quiet_NaN();  // 0: nothing was rendered
    }
    const VisibleVoxels visible(grid, view, camera, depth, 5);
    std::uint64_t count = 0;
    visible.for_each_block([&](const Eigen::Vector3i& block) {
      count += static_cast<std::uint64_t>(visible(block, unexplored_in(block)).count());
    });
    EXPECT_EQ(static_cast<double>(count), expected.column("N_visible_unexplored")[i]) << "view " << i;
    EXPECT_NEAR(static_cast<double>(count) / static_cast<double>(grid.count()), expected.column("psi_V")[i], 1e-15);
  }
}

}  // namespace
}  // namespace vantage

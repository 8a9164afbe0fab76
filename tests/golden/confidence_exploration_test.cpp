// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/utility/confidence_exploration.hpp>

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/npy.hpp>

// The utilities (eq. 6.10) that the published code gives eight views, from the images that it rendered there.
namespace vantage {
namespace {

const Camera camera{64, 64, 55.42562584220408, 55.42562584220408, 32, 32};

/// What the published code knew: voxels of grid.csv, some unexplored, and images from eight views.
struct Published : archetype::Map {
  VoxelGrid grid =
      VoxelGrid::dividing({Eigen::Vector3d(-0.1, -0.05, 0), Eigen::Vector3d(2.45, 2.05, 1.5)}, 0.2);  // grid.csv
  std::vector<double> unexplored;
  std::vector<View> views;
  std::vector<Rendering<channel::Depth, channel::Confidence>> images;

  explicit Published(const std::string& folder) {
    const CsvTable after = read_csv(folder + "after2.csv");
    unexplored.assign(after.column("unexplored").begin(), after.column("unexplored").end());
    std::string names = "p0";  // the file has no header
    for (int k = 1; k < 16; ++k) names += concat(",p", k);
    const CsvTable poses = parse_csv(names + "\n" + read_file(folder + "candidates_c2w.csv", 1 << 20));
    for (std::size_t i = 0; i < poses.rows(); ++i) {
      View view;
      for (std::size_t k = 0; k < 16; ++k)
        view.T_W_C.matrix()(static_cast<int>(k / 4), static_cast<int>(k % 4)) = poses.column(k)[i];
      views.push_back(view);
      const auto image = [&](const char* kind) {
        const auto values = read_npy(concat(folder, "cand", i, kind)).values<double>("pixels");
        return Image<float>(Eigen::Map<const Image<double>>(values.data(), 64, 64).cast<float>());
      };
      auto& drawn = images.emplace_back();
      drawn.depth = image("_D.npy");
      drawn.depth = (drawn.depth > 0).select(drawn.depth, std::numeric_limits<float>::quiet_NaN());
      drawn.confidence = image("_K.npy");
    }
  }
  [[nodiscard]] Box3 bounds() const { return grid.box(); }
  [[nodiscard]] Space at(const Eigen::Vector3d& p) const {
    const Eigen::Vector3i v = grid.voxel_at(p), n = grid.size();
    const int row = (v.x() * n.y() + v.y()) * n.z() + v.z();
    return unexplored[static_cast<std::size_t>(row)] == 1 ? Space::unknown : Space::free;
  }
  void render(const View& view, const Camera&, Rendering<channel::Depth, channel::Confidence>& out) const {
    for (std::size_t i = 0; i < views.size(); ++i)
      if (views[i].T_W_C.matrix() == view.T_W_C.matrix()) out = images[i];
  }
};

template <class Exploitation>
void expect_utilities(const Published& map, const std::vector<double>& expected) {
  const ConfidenceExploration<Exploitation> utility({.camera = camera, .far_m = 5, .voxel_m = 0.2});
  const auto score = utility.prepare(map, Situation{}, Rng(1));
  std::vector<double> out(map.views.size());
  score({}, map.views, out);
  ASSERT_EQ(out.size(), expected.size());
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_NEAR(out[i], expected[i], 1e-6) << "view " << i;
}

TEST(GoldenConfidenceExploration, ThePublishedCodesUtilitiesAndTheTexts) {
  if (std::string(VANTAGE_GOLDEN_DIR).empty()) GTEST_SKIP() << "VANTAGE_GOLDEN_DIR is not set";
  const std::string folder = std::string(VANTAGE_GOLDEN_DIR) + "/surfel/voxel/";
  const Published map(folder);
  const CsvTable expected = read_csv(folder + "utility.csv");
  const auto column = [&](const char* name) {
    return std::vector<double>(expected.column(name).begin(), expected.column(name).end());
  };
  ASSERT_EQ(map.views.size(), 8u);
  expect_utilities<UnsureSurface>(map, column("util_code"));
  expect_utilities<LeastConfidence>(map, column("util_thesis"));
}

}  // namespace
}  // namespace vantage

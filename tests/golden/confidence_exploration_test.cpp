// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/utility/confidence_exploration.hpp>

#include <vector>

#include <gtest/gtest.h>

#include <vantage/concepts/archetypes.hpp>

#include "golden.hpp"

// The utilities (eq. 6.10) that the published code gives eight views, from the images that it rendered there.
namespace vantage {
namespace {

using test::ToyRoom;
using GoldenConfidenceExploration = ToyRoom;

/// What the published code knew: voxels of which some are unexplored, and images from eight views.
struct Published : archetype::Map {
  std::vector<double> unexplored = ToyRoom::column("after2.csv", "unexplored");
  std::vector<View> views = ToyRoom::candidates();
  std::vector<Rendering<channel::Depth, channel::Confidence>> images;

  Published() {
    for (std::size_t i = 0; i < views.size(); ++i) {
      auto& drawn = images.emplace_back();
      drawn.depth = ToyRoom::rendered_depth(i);
      drawn.confidence = ToyRoom::rendered(i, 'K').cast<float>();
    }
  }
  [[nodiscard]] Box3 bounds() const { return ToyRoom::grid.box(); }
  [[nodiscard]] Space at(const Eigen::Vector3d& p) const {
    return unexplored[ToyRoom::row_of(ToyRoom::grid.voxel_at(p))] == 1 ? Space::unknown : Space::free;
  }
  void render(const View& view, const Camera&, Rendering<channel::Depth, channel::Confidence>& out) const {
    for (std::size_t i = 0; i < views.size(); ++i)
      if (views[i].T_W_C.matrix() == view.T_W_C.matrix()) out = images[i];
  }
};

template <class Exploitation>
void expect_utilities(const Published& map, const std::vector<double>& expected) {
  const ConfidenceExploration<Exploitation> utility({.camera = ToyRoom::camera, .far_m = 5, .voxel_m = 0.2});
  const auto score = utility.prepare(map, Situation{}, Rng(1));
  std::vector<double> out(map.views.size());
  score({}, map.views, out);
  ASSERT_EQ(out.size(), expected.size());
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_NEAR(out[i], expected[i], 1e-6) << "view " << i;
}

TEST_F(GoldenConfidenceExploration, ThePublishedCodesUtilitiesAndTheTexts) {
  const Published map;
  ASSERT_EQ(map.views.size(), 8u);
  expect_utilities<UnsureSurface>(map, column("utility.csv", "util_code"));
  expect_utilities<LeastConfidence>(map, column("utility.csv", "util_thesis"));
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The published code's planning step in the toy room of the voxel map's golden numbers: what it renders from eight
// candidates, and which of them it flies to. Their utilities are in confidence_exploration_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/npy.hpp>
#include <vantage/maps/surfel/reference_rasteriser.hpp>
#include <vantage/selector/travel_tradeoff.hpp>

#ifndef VANTAGE_GOLDEN_DIR
#define VANTAGE_GOLDEN_DIR ""
#endif

namespace vantage {
namespace {

std::filesystem::path golden(const std::string& file) {
  return std::filesystem::path(VANTAGE_GOLDEN_DIR) / "surfel" / "voxel" / file;
}

class GoldenPlanning : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(VANTAGE_GOLDEN_DIR).empty() || !std::filesystem::exists(golden("map_surfels.csv")))
      GTEST_SKIP() << "VANTAGE_GOLDEN_DIR has no surfel/voxel/ (now \"" << VANTAGE_GOLDEN_DIR << "\")";
  }
};

std::vector<View> candidates() {
  std::string names = "p0";  // the file has no header
  for (int k = 1; k < 16; ++k) names += concat(",p", k);
  const CsvTable poses = parse_csv(names + "\n" + read_file(golden("candidates_c2w.csv"), 1 << 20));
  std::vector<View> views(poses.rows());
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t k = 0; k < 16; ++k)
      views[i].T_W_C.matrix()(static_cast<Eigen::Index>(k / 4), static_cast<Eigen::Index>(k % 4)) = poses.column(k)[i];
  return views;
}
Surfels surfels() {
  const CsvTable t = read_csv(golden("map_surfels.csv"));
  Surfels s;
  s.scale = {.unit_m = 1, .max_m = std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i < t.rows(); ++i) {
    Surfel one;
    for (std::size_t p = 0; p < surfel::parameters; ++p) one.parameter[p] = static_cast<float>(t.column(p)[i]);
    one.confidence = static_cast<float>(t.column("confidence")[i]);
    s.push_back(one);
  }
  return s;
}
std::vector<double> pixels(std::size_t candidate, const char* kind) {
  return read_npy(golden(concat("cand", candidate, kind))).values<double>("pixels");
}

TEST_F(GoldenPlanning, RendersDepthAndConfidence) {
  using Raster = ReferenceRasteriser<double, LinearDepth, PublishedTiles>;
  const Surfels s = surfels();
  ASSERT_EQ(s.size(), 700U);
  const std::vector<View> views = candidates();
  ASSERT_EQ(views.size(), 8U);
  RasterView from;
  from.camera = {64, 64, 55.42562584220408, 55.42562584220408, 32, 32};  // grid.csv
  for (std::size_t i = 0; i < views.size(); ++i) {
    from.view = views[i];
    Raster::Pass pass;
    Rendering<channel::Depth, channel::Confidence> drawn;
    Raster().forward(s, from, pass, drawn);
    const std::vector<double> depth = pixels(i, "_D.npy"), confidence = pixels(i, "_K.npy");
    ASSERT_EQ(depth.size(), static_cast<std::size_t>(drawn.depth.size()));
    ASSERT_EQ(confidence.size(), depth.size());
    for (std::size_t k = 0; k < depth.size(); ++k) {
      const float d = drawn.depth.data()[k];
      ASSERT_NEAR(std::isnan(d) ? 0.0 : static_cast<double>(d), depth[k], 2e-4) << "view " << i << ", pixel " << k;
      ASSERT_NEAR(drawn.confidence.data()[k], confidence[k], 2e-5) << "view " << i << ", pixel " << k;
    }
  }
}

/// Ways of given lengths to the candidates.
struct Lengths {
  std::vector<double> metres;

  template <Map M>
  std::vector<double> lengths_m(const M&, const View&, Views) const {
    return metres;
  }
  template <Map M>
  std::vector<View> path(const M&, const View& from, const View& goal) const {
    return {from, goal};
  }
};

// score_code is eq. 6.11 with delta 0.5; all of it can be computed from the columns of the file.
TEST_F(GoldenPlanning, FliesToTheBestScore) {
  const CsvTable t = read_csv(golden("utility.csv"));
  const auto column = [&](const char* name) {
    return std::vector<double>(t.column(name).begin(), t.column(name).end());
  };
  const std::vector<double> utility = column("util_code"), path_m = column("path_m"), score = column("score_code");
  const double sum_utility = std::accumulate(utility.begin(), utility.end(), 0.0),
               sum_m = std::accumulate(path_m.begin(), path_m.end(), 0.0);
  const double delta = TravelTradeoffConfig{}.delta;
  for (std::size_t i = 0; i < score.size(); ++i)
    EXPECT_NEAR(utility[i] / sum_utility - delta * path_m[i] / sum_m, score[i], 1e-12) << "candidate " << i;

  const Candidates all{.views = candidates(), .utilities = utility};
  ASSERT_EQ(all.views.size(), score.size());
  const auto best = static_cast<std::size_t>(std::max_element(score.begin(), score.end()) - score.begin());
  const auto scorer = [](Views, Views, std::span<double>) {};
  Rng rng;
  const auto decision = TravelTradeoff(Lengths{path_m}).select(archetype::Map{}, Situation{}, all, Score(scorer), rng);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->index, best);
  EXPECT_EQ(decision->travel_m, path_m[best]);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The published code's planning step in the toy room of the voxel map's golden numbers: what it renders from eight
// candidates, and which of them it flies to. Their utilities are in confidence_exploration_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/maps/surfel/reference_rasteriser.hpp>
#include <vantage/selector/travel_tradeoff.hpp>

#include "golden.hpp"
#include "surfel_scenes.hpp"

namespace vantage {
namespace {

using GoldenPlanning = test::ToyRoom;

TEST_F(GoldenPlanning, RendersDepthAndConfidence) {
  using Raster = ReferenceRasteriser<double, LinearDepth, PublishedTiles>;
  Surfels s = test::surfels_of(read_csv(file("map_surfels.csv")));
  s.scale = {.unit_m = 1, .max_m = std::numeric_limits<float>::infinity()};
  ASSERT_EQ(s.size(), 700U);
  const std::vector<View> views = candidates();
  ASSERT_EQ(views.size(), 8U);
  RasterView from;
  from.camera = camera;
  for (std::size_t i = 0; i < views.size(); ++i) {
    from.view = views[i];
    Raster::Pass pass;
    Rendering<channel::Depth, channel::Confidence> drawn;
    Raster().forward(s, from, pass, drawn);
    const Image<double> depth = rendered(i, 'D'), confidence = rendered(i, 'K');
    ASSERT_EQ(depth.size(), drawn.depth.size());
    ASSERT_EQ(confidence.size(), depth.size());
    for (Eigen::Index k = 0; k < depth.size(); ++k) {
      const float d = drawn.depth(k);
      ASSERT_NEAR(std::isnan(d) ? 0.0 : static_cast<double>(d), depth(k), 2e-4) << "view " << i << ", pixel " << k;
      ASSERT_NEAR(drawn.confidence(k), confidence(k), 2e-5) << "view " << i << ", pixel " << k;
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
  const std::vector<double> utility = column("utility.csv", "util_code"), path_m = column("utility.csv", "path_m"),
                            score = column("utility.csv", "score_code");
  const double sum_utility = std::accumulate(utility.begin(), utility.end(), 0.0),
               sum_m = std::accumulate(path_m.begin(), path_m.end(), 0.0);
  const double delta = TravelTradeoffConfig{}.delta;
  for (std::size_t i = 0; i < score.size(); ++i)
    EXPECT_NEAR(utility[i] / sum_utility - delta * path_m[i] / sum_m, score[i], 1e-12) << "candidate " << i;

  const Candidates all{.views = candidates(), .utilities = utility};
  ASSERT_EQ(all.views.size(), score.size());
  const auto best = static_cast<std::size_t>(std::max_element(score.begin(), score.end()) - score.begin());
  Rng rng;
  const auto decision =
      TravelTradeoff(Lengths{path_m}).select(archetype::Map{}, Situation{}, all, Score(unscored), rng);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->index, best);
  EXPECT_EQ(decision->travel_m, path_m[best]);
}

}  // namespace
}  // namespace vantage

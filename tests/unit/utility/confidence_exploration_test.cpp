// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/utility/confidence_exploration.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/utility/unexplored.hpp>

#include "message_of.hpp"

namespace vantage {
namespace {

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
constexpr double far_m = 5;
const Camera camera = Camera::from_fov(40, 30, deg(60));

/// Knows the half of its bounds with x < 0, and sees the same in every pixel from everywhere.
struct HalfKnown : archetype::Map {
  float depth_m = 3, confidence = 0.25F;

  [[nodiscard]] Space at(const Eigen::Vector3d& p) const { return p.x() < 0 ? Space::free : Space::unknown; }
  void render(const View&, const Camera& c, Rendering<channel::Depth>& out) const {
    out.depth.setConstant(c.height, c.width, depth_m);
  }
  void render(const View&, const Camera& c, Rendering<channel::Depth, channel::Confidence>& out) const {
    out.depth.setConstant(c.height, c.width, depth_m);
    out.confidence.setConstant(c.height, c.width, confidence);
  }
};

template <class Exploitation = UnsureSurface>
std::vector<double> utilities(const HalfKnown& map, Views views, Views given = {}, double weight = 1000) {
  const ConfidenceExploration<Exploitation> utility(
      {.exploration_weight = weight, .camera = camera, .far_m = far_m, .voxel_m = 0.2});
  std::vector<double> out(views.size());
  utility.prepare(map, Situation{}, Rng(1))(given, views, out);
  return out;
}
std::vector<double> shares(const HalfKnown& map, Views views, Views given = {}) {
  std::vector<double> out(views.size());
  Unexplored({.camera = camera, .far_m = far_m, .voxel_m = 0.2}).prepare(map, Situation{}, Rng(1))(given, views, out);
  return out;
}
/// From the known half across the unknown one, along its border, and away from it.
std::vector<View> some_views() {
  return {look_at({-0.5, 0, 0.5}, {1, 0, 0.5}), look_at({-0.1, -0.9, 0.5}, {0.1, 1, 0.4}),
          look_at({-0.5, 0, 0.5}, {-1, 0, 0.5})};
}

TEST(ConfidenceExploration, TheGainOfAnImage) {
  Image<float> confidence(1, 4), depth(1, 4);
  depth << 1, nothing, 5, 6;  // near, no surface, as far as the sensor sees, beyond
  confidence << 0.25F, 0.5F, 0.5F, 0;
  EXPECT_DOUBLE_EQ(UnsureSurface{}(confidence, depth, far_m), (0.75 * 1 + 0.5 * 2.5 + 0.5 * 5 + 0) / (4 * far_m));
  EXPECT_DOUBLE_EQ(LeastConfidence{}(confidence, depth, far_m), -1.25 / 4);
  EXPECT_EQ(UnsureSurface{}(Image<float>(), Image<float>(), far_m), 0);
}

TEST(ConfidenceExploration, IsTheWeightedSumOfBothGains) {
  const HalfKnown map;
  const std::vector<View> views = some_views();
  const std::vector<double> psi_V = shares(map, views);
  EXPECT_GT(psi_V[0], 0.05);
  EXPECT_GT(psi_V[1], 0);
  EXPECT_EQ(psi_V[2], 0);
  for (const double weight : {0.0, 1.0, 1000.0}) {
    const std::vector<double> unsure = utilities(map, views, {}, weight);
    const std::vector<double> least = utilities<LeastConfidence>(map, views, {}, weight);
    for (std::size_t i = 0; i < views.size(); ++i) {
      EXPECT_NEAR(unsure[i], weight * psi_V[i] + 0.75 * 3 / far_m, 1e-9) << i;
      EXPECT_NEAR(least[i], weight * psi_V[i] - 0.25, 1e-9) << i;
    }
  }
}

TEST(ConfidenceExploration, BeyondTheSensorNothingIsUnsure) {
  HalfKnown map;
  const std::vector<View> views = some_views();
  map.depth_m = 7;
  EXPECT_EQ(utilities(map, views, {}, 0), (std::vector<double>{0, 0, 0}));
  EXPECT_GT(utilities(map, views)[0], 0) << "but space is seen up to there";
}

TEST(ConfidenceExploration, WhereThereIsNoSurfaceAPixelCountsHalfWay) {
  HalfKnown map;
  const std::vector<View> views = some_views();
  map.depth_m = nothing;
  map.confidence = 0;
  for (const double u : utilities(map, views, {}, 0)) EXPECT_DOUBLE_EQ(u, 0.5);
  const double open = utilities(map, views)[0];
  map.depth_m = 0.6F;  // a wall a little behind the border
  EXPECT_LT(utilities(map, views)[0], open - 1);
}

TEST(ConfidenceExploration, GivenViewsHaveSeenWhatTheySee) {
  const HalfKnown map;
  const std::vector<View> views = some_views(), given = {views[0]};
  const std::vector<double> alone = utilities(map, views), after = utilities(map, views, given),
                            psi_V = shares(map, views, given);
  const double psi_G = 0.75 * 3 / far_m;  // of surfaces nothing is foretold
  EXPECT_NEAR(after[0], psi_G, 1e-9);
  EXPECT_GT(alone[0], psi_G + 1);
  EXPECT_LE(after[1], alone[1]);
  for (std::size_t i = 0; i < views.size(); ++i) EXPECT_NEAR(after[i], 1000 * psi_V[i] + psi_G, 1e-9) << i;
}

TEST(ConfidenceExploration, BadConfigsAreRefused) {
  for (const char* member : {"exploration_weight", "far_m", "voxel_m"})
    EXPECT_REFUSED(ConfidenceExploration<>({.exploration_weight = -1, .far_m = 0, .voxel_m = -1}), member);
  EXPECT_REFUSED(ConfidenceExploration<>({.exploration_weight = std::nan("")}), "exploration_weight");
  EXPECT_REFUSED(ConfidenceExploration<>({.far_m = std::numeric_limits<double>::infinity()}), "far_m");
  EXPECT_THROW(ConfidenceExploration<>({.camera = {}}), Error);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/sampler/hemisphere.hpp>

namespace vantage {
namespace {

std::vector<View> sample(const Hemisphere& hemisphere, const View& here, std::uint64_t seed) {
  const auto scorer = [](Views, Views, std::span<double>) {};
  Rng rng(seed);
  return hemisphere.sample(archetype::Map{}, Situation{.here = here}, Score(scorer), rng).views;
}
const Eigen::Vector3d centre(1, 2, 0.5);

TEST(Hemisphere, LooksAtTheCentreFromTheRadius) {
  const Hemisphere h({.centre = centre, .radius_m = 3, .max_polar_rad = deg(60)});
  for (const View& v : sample(h, nadir(1, 2, 3.5), 1)) {
    const Eigen::Vector3d d = v.position() - centre;
    EXPECT_NEAR(d.norm(), 3, 1e-12);
    EXPECT_TRUE(v.forward().isApprox(-d.normalized(), 1e-12));
    EXPECT_LE(std::acos(d.z() / 3), deg(60) + 1e-9);
  }
}

TEST(Hemisphere, IsUniformByArea) {
  const Hemisphere h({.centre = centre, .radius_m = 3, .max_polar_rad = deg(60), .candidates = 50000});
  const std::vector<View> views = sample(h, View{}, 2);
  ASSERT_EQ(views.size(), 50000u);
  // On a cap, height and azimuth are independent and uniform: chi-square over 10 x 12 cells.
  std::vector<int> count(120);
  for (const View& v : views) {
    const Eigen::Vector3d d = (v.position() - centre) / 3;
    const double height = (1 - d.z()) / (1 - std::cos(deg(60))),
                 azimuth = std::atan2(d.y(), d.x()) / (2 * std::numbers::pi) + 0.5;
    ++count[static_cast<std::size_t>(std::min(height, 0.999999) * 10) * 12 +
            static_cast<std::size_t>(std::min(azimuth, 0.999999) * 12)];
  }
  double chi_square = 0;
  const double expected = 50000.0 / 120;
  for (const int c : count) chi_square += (c - expected) * (c - expected) / expected;
  EXPECT_LT(chi_square, 119 + 4 * std::sqrt(2.0 * 119));
  EXPECT_GT(chi_square, 119 - 4 * std::sqrt(2.0 * 119));
}

TEST(Hemisphere, TurnsNoFartherThanAllowed) {
  Hemisphere::Config config = Hemisphere::chapter4();
  config.candidates = 2000;
  const Hemisphere h(config);
  const View here = look_at({2 * std::sin(deg(70)), 0, 2 * std::cos(deg(70))}, {0, 0, 0});
  const std::vector<View> views = sample(h, here, 3);
  ASSERT_EQ(views.size(), 2000u);
  double widest_rad = 0, lowest_m = 2;
  int left = 0;
  for (const View& v : views) {
    widest_rad =
        std::max(widest_rad, std::acos(std::min(1.0, v.position().normalized().dot(here.position().normalized()))));
    lowest_m = std::min(lowest_m, v.position().z());
    left += v.position().y() > 0;
  }
  EXPECT_LE(widest_rad, deg(60) + 1e-9);
  EXPECT_GT(widest_rad, deg(58));
  EXPECT_GE(lowest_m, 0.3 - 1e-9);
  EXPECT_LT(lowest_m, 0.33);
  EXPECT_NEAR(left, 1000, 4 * std::sqrt(500));
}

TEST(Hemisphere, UniformInTheTwoCapsTogether) {
  // Against rejection from the whole sphere: the shares above the middle height must agree.
  const Hemisphere h({.radius_m = 1, .max_polar_rad = deg(80), .max_turn_rad = deg(50), .candidates = 20000});
  const View here = look_at({std::sin(deg(60)), 0, std::cos(deg(60))}, {0, 0, 0});
  double high = 0;
  for (const View& v : sample(h, here, 4)) high += v.position().z() > 0.5;
  Rng rng(5);
  double in = 0, in_high = 0;
  for (int i = 0; i < 400000; ++i) {
    const Eigen::Vector3d d = Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
    if (d.z() < std::cos(deg(80)) || d.dot(here.position()) < std::cos(deg(50))) continue;
    ++in, in_high += d.z() > 0.5;
  }
  EXPECT_NEAR(high / 20000, in_high / in, 0.02);
}

TEST(Hemisphere, AnotherSeedOtherViews) {
  const Hemisphere h;
  EXPECT_FALSE(same_place(sample(h, View{}, 1)[0], sample(h, View{}, 2)[0]));
  const auto scorer = [](Views, Views, std::span<double>) {};
  Rng rng(1);  // and again within one stream
  const auto first = h.sample(archetype::Map{}, {}, Score(scorer), rng),
             second = h.sample(archetype::Map{}, {}, Score(scorer), rng);
  EXPECT_FALSE(same_place(first.views[0], second.views[0]));
}

TEST(Hemisphere, NothingWhereTheCapsDoNotMeet) {
  const Hemisphere h({.max_polar_rad = deg(60), .max_turn_rad = deg(20)});
  EXPECT_TRUE(sample(h, look_at({0.1, 0, -2}, {0, 0, 0}), 1).empty());
  EXPECT_EQ(sample(h, View{}, 1).size(), 50u);  // at the centre: anywhere
}

TEST(Hemisphere, RefusesBadConfigs) {
  EXPECT_THROW(Hemisphere({.radius_m = 0}), Error);
  EXPECT_THROW(Hemisphere({.max_polar_rad = deg(91)}), Error);
  EXPECT_THROW(Hemisphere({.max_turn_rad = 0}), Error);
  EXPECT_THROW(Hemisphere({.candidates = 0}), Error);
  EXPECT_THROW(Hemisphere({.centre = {std::numeric_limits<double>::infinity(), 0, 0}}), Error);
}

}  // namespace
}  // namespace vantage

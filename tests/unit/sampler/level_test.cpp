// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/sampler/hemisphere.hpp>
#include <vantage/sampler/level.hpp>
#include <vantage/sampler/local.hpp>
#include <vantage/sampler/pool.hpp>
#include <vantage/sampler/utility_weighted.hpp>

#include "sampler_maps.hpp"

namespace vantage {
namespace {

double pitch_rad(const View& v) { return std::asin(std::clamp(v.forward().z(), -1.0, 1.0)); }
double yaw_rad(const View& v) { return std::atan2(v.forward().y(), v.forward().x()); }

TEST(Level, KeepsPlaceAndHeadingAndLimitsThePitch) {
  for (const double limit : {0.0, 0.4, std::numbers::pi / 2}) {
    const test::DrawnFrontiers map = test::two_rooms();
    const View here = look_at({1.5, 1.5, 1}, {3, 1.5, 1});
    const auto before = test::sample(Local{}, map, {.here = here}, 1).views,
               after = test::sample(Level(Local{}, {.max_pitch_rad = limit}), map, {.here = here}, 1).views;
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_TRUE(same_place(before[i], after[i]));
      EXPECT_NEAR(std::remainder(yaw_rad(before[i]) - yaw_rad(after[i]), 2 * std::numbers::pi), 0, 1e-9);
      EXPECT_NEAR(pitch_rad(after[i]), std::clamp(pitch_rad(before[i]), -limit, limit), 1e-7);
      EXPECT_NEAR(after[i].T_W_C.linear()(2, 0), 0, 1e-12);
      EXPECT_NO_THROW(check_view(after[i], "levelled"));
    }
  }
}

TEST(Level, StraightUpAndDownKeepTheHeadingOfTheImage) {
  // Pitched from a level heading until the view is vertical, the camera comes back to that heading.
  const Level<Local> level;
  for (const double yaw : {-2.0, 0.3, 1.9})
    for (const double turn : {-0.5, 0.5}) {
      const View ahead = look_at({1, 2, 3}, Eigen::Vector3d(1 + std::cos(yaw), 2 + std::sin(yaw), 3));
      View vertical = ahead;
      vertical.T_W_C.rotate(Eigen::AngleAxisd(turn * std::numbers::pi, Eigen::Vector3d::UnitX()));
      ASSERT_NEAR(std::abs(vertical.forward().z()), 1, 1e-12);
      EXPECT_TRUE(level.level(vertical).T_W_C.isApprox(ahead.T_W_C, 1e-9)) << yaw << " " << turn;
    }
}

TEST(Level, TheBaseIsToldTheUtilityOfLevelViews) {
  // Utility is how far a view looks down; level ones do not.
  const auto down = [](Views, Views views, std::span<double> out) {
    for (std::size_t i = 0; i < views.size(); ++i) out[i] = -views[i].forward().z();
  };
  Level sampler(UtilityWeighted(Pool({nadir(0, 0, 1), nadir(1, 0, 1)})));
  Rng rng(1);
  const Candidates c = sampler.sample(archetype::Map{}, {}, Score(down), rng);
  ASSERT_EQ(c.utilities.size(), 2u);
  for (const double u : c.utilities) EXPECT_NEAR(u, 0, 1e-12);
  for (const View& v : c.views) EXPECT_NEAR(v.forward().z(), 0, 1e-12);
}

TEST(Level, RefusesBadConfigs) {
  EXPECT_THROW(Level<Hemisphere>({.max_pitch_rad = -0.1}), Error);
  EXPECT_THROW(Level<Hemisphere>({.max_pitch_rad = 1.6}), Error);
}

}  // namespace
}  // namespace vantage

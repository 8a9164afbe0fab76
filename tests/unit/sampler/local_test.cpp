// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <tuple>
#include <vector>

#include <vantage/sampler/local.hpp>

#include "sampler_maps.hpp"

namespace vantage {
namespace {

const View here = look_at({1.47, 1.52, 1.04}, {3, 1.5, 1});

TEST(Local, StaysNearbyWhereTheRobotFits) {
  const test::DrawnFrontiers map = test::two_rooms();
  const std::vector<View> views =
      test::sample(Local({.radius_m = 0.5, .candidates = 400}), map, {.here = here}, 1).views;
  ASSERT_EQ(views.size(), 400u);
  EXPECT_TRUE(same_place(views.back(), here));
  std::map<std::tuple<int, int, int>, int> count;
  for (const View& v : std::span(views).first(399)) {
    EXPECT_LE(distance_m(v, here), 0.5 + 1e-9);
    const Eigen::Vector3i voxel = map.grid().voxel_at(v.position());
    EXPECT_TRUE(map.navigable(voxel));
    EXPECT_TRUE(v.position().isApprox(map.grid().centre(voxel), 1e-12));
    EXPECT_NEAR(v.T_W_C.linear()(2, 0), 0, 1e-12);  // no roll: the image's rows are horizontal
    EXPECT_LE(v.T_W_C.linear()(2, 1), 1e-12);       // and it stands upright
    ++count[{voxel.x(), voxel.y(), voxel.z()}];
  }
  std::size_t around = 0;
  for (std::uint64_t i = 0; i < map.grid().count(); ++i) {
    const Eigen::Vector3i n = map.grid().size(), v(static_cast<int>(i) % n.x(), static_cast<int>(i) / n.x() % n.y(),
                                                   static_cast<int>(i) / n.x() / n.y());
    around += map.navigable(v) && (map.grid().centre(v) - here.position()).norm() <= 0.5;
  }
  EXPECT_GT(around, 50u);
  EXPECT_GT(count.size(), around * 9 / 10);
  EXPECT_LE(count.size(), around);
}

TEST(Local, LooksInAllDirectionsAlike) {
  const std::vector<View> views =
      test::sample(Local({.candidates = 50000}), test::two_rooms(), {.here = here}, 2).views;
  std::vector<int> count(120);  // height and azimuth on a sphere are independent and uniform
  for (const View& v : views) {
    const double height = v.forward().z() / 2 + 0.5,
                 azimuth = std::atan2(v.forward().y(), v.forward().x()) / (2 * std::numbers::pi) + 0.5;
    ++count[static_cast<std::size_t>(std::min(height, 0.999999) * 10) * 12 +
            static_cast<std::size_t>(std::min(azimuth, 0.999999) * 12)];
  }
  double chi_square = 0;
  for (const int c : count) chi_square += (c - 50000.0 / 120) * (c - 50000.0 / 120) / (50000.0 / 120);
  EXPECT_LT(std::abs(chi_square - 119), 4 * std::sqrt(2.0 * 119));
}

TEST(Local, TurnsOnTheSpotWhereItDoesNotFit) {
  const test::DrawnFrontiers map = test::two_rooms();
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(5.7, 2.7, 1.8), Eigen::Vector3d(-20, 4e5, 1e7)}) {
    const View lost = look_at(place, {3, 1.5, 1});
    const std::vector<View> views = test::sample(Local{}, map, {.here = lost}, 3).views;
    ASSERT_EQ(views.size(), 100u);
    for (const View& v : views) EXPECT_TRUE(same_place(v, lost));
    EXPECT_FALSE(views[0].forward().isApprox(views[1].forward(), 0.01));
  }
}

TEST(Local, RefusesBadConfigs) {
  EXPECT_THROW(Local({.radius_m = 0}), Error);
  EXPECT_THROW(Local({.radius_m = std::numeric_limits<double>::infinity()}), Error);
  EXPECT_THROW(Local({.candidates = 0}), Error);
}

}  // namespace
}  // namespace vantage

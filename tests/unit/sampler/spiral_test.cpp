// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <vantage/core/units.hpp>
#include <vantage/sampler/spiral.hpp>

namespace vantage {
namespace {

const Eigen::Vector3d centre(1, 2, 0.5);

TEST(Spiral, GoesFromTheTopDown) {
  const Spiral spiral({.centre = centre, .radius_m = 2, .max_polar_rad = deg(80), .views = 10});
  const std::vector<View>& v = spiral.views();
  ASSERT_EQ(v.size(), 10u);
  EXPECT_TRUE(v[0].position().isApprox(centre + Eigen::Vector3d(0, 0, 2), 1e-12));
  EXPECT_NEAR(v[9].position().z() - centre.z(), 2 * std::cos(deg(80)), 1e-12);
  for (std::size_t i = 0; i < v.size(); ++i) {
    EXPECT_NEAR((v[i].position() - centre).norm(), 2, 1e-12);
    EXPECT_TRUE(v[i].forward().isApprox((centre - v[i].position()).normalized(), 1e-12));
    EXPECT_TRUE(i == 0 || v[i].position().z() < v[i - 1].position().z());
  }
}

TEST(Spiral, SpreadsEvenly) {
  for (const int n : {10, 50, 300}) {
    const Spiral spiral({.radius_m = 1, .max_polar_rad = deg(90), .views = n});
    const double even_m = std::sqrt(2 * std::numbers::pi / n);  // side of a square of each view's share
    for (std::size_t i = 0; i < spiral.views().size(); ++i) {
      double nearest_m = 9;
      for (std::size_t j = 0; j < spiral.views().size(); ++j)
        if (i != j) nearest_m = std::min(nearest_m, distance_m(spiral.views()[i], spiral.views()[j]));
      EXPECT_GT(nearest_m, 0.5 * even_m) << n << " " << i;  // the two at the top are the closest
      EXPECT_LT(nearest_m, 1.4 * even_m) << n << " " << i;
    }
  }
}

TEST(Spiral, RefusesBadConfigs) {
  EXPECT_THROW(Spiral({.radius_m = -1}), Error);
  EXPECT_THROW(Spiral({.max_polar_rad = 0}), Error);
  EXPECT_THROW(Spiral({.views = 0}), Error);
  EXPECT_THROW(Spiral({.reached = 0}), Error);
  EXPECT_EQ(Spiral({.views = 1}).views().size(), 1u);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/look_around.hpp>

namespace vantage {
namespace {

const View start = look_at({1, 2, 1.5}, {2, 4, 1});

/// Whether some view holds a direction.
bool seen(const std::vector<View>& views, double field_of_view_rad, const Eigen::Vector3d& direction) {
  const Camera camera = Camera::from_fov(100, 100, field_of_view_rad);
  for (const View& v : views) {
    const Eigen::Vector3d p = v.T_C_W().linear() * direction;
    const double u = camera.fx * p.x() / p.z() + camera.cx, w = camera.fy * p.y() / p.z() + camera.cy;
    if (p.z() > 0 && u >= 0 && u <= 100 && w >= 0 && w <= 100) return true;
  }
  return false;
}

TEST(LookAround, BeginsWithItsOwnHeadingAndLeavesNoneOut) {
  for (const double degrees : {40.0, 60.0, 75.0, 90.0, 179.0}) {
    const std::vector<View> views = turn_around(start, deg(degrees));
    ASSERT_EQ(views.size(), static_cast<std::size_t>(std::ceil(360 / degrees)));
    EXPECT_TRUE(views[0].forward().isApprox(Eigen::Vector3d(1, 2, 0).normalized(), 1e-12));
    for (const View& v : views) EXPECT_EQ(v.position(), start.position());
    for (int k = 0; k < 360; ++k)
      EXPECT_TRUE(seen(views, deg(degrees + 1e-6), {std::cos(deg(k)), std::sin(deg(k)), 0})) << degrees << ", " << k;
  }
}

TEST(LookAround, AllAroundLeavesOutStraightUpAndDownOnly) {
  Rng rng(1);
  const std::vector<View> views = look_all_around(start, deg(60));
  EXPECT_EQ(views.size(), 18u);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d d = Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
    if (std::abs(d.z()) < std::sin(deg(70))) { EXPECT_TRUE(seen(views, deg(60 + 1e-6), d)) << d.transpose(); }
  }
}

TEST(LookAround, RefusesWhatIsNoFieldOfViewOrNoPose) {
  for (const double bad : {0.0, -1.0, 4.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(static_cast<void>(turn_around(start, bad)), Error);
  EXPECT_THROW(static_cast<void>(look_all_around(nadir(std::nan(""), 0, 0), 1)), Error);
}

}  // namespace
}  // namespace vantage

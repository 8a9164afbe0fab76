// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <vantage/core/units.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/field_image.hpp>

namespace vantage {
namespace {

TEST(Box, AreaOfNothingIsZero) {
  EXPECT_EQ(area(Box2()), 0);
  EXPECT_EQ(area(Box2(Eigen::Vector2d(0, 1), Eigen::Vector2d(2, 4))), 6);
  EXPECT_EQ(area(Box2(Eigen::Vector2d(0, 1), Eigen::Vector2d(2, 1))), 0);
}

TEST(NadirSensor, SeesASquareBelow) {
  const NadirSensor sensor;
  const Box2 f = sensor.footprint(nadir(10, 5, 2.5));
  EXPECT_TRUE(f.min().isApprox(Eigen::Vector2d(7.5, 2.5), 1e-12));
  EXPECT_TRUE(f.max().isApprox(Eigen::Vector2d(12.5, 7.5), 1e-12));
  EXPECT_NEAR((NadirSensor{.half_angle_rad = deg(30), .pixels = 20}.footprint(nadir(0, 0, 3)).sizes().x()),
              2 * 3 / std::sqrt(3.0), 1e-12);
}

TEST(NadirSensor, IgnoresYaw) {
  View v = nadir(10, 5, 2.5);
  v.T_W_C.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(NadirSensor{}.footprint(v).isApprox(NadirSensor{}.footprint(nadir(10, 5, 2.5)), 1e-12));
}

TEST(NadirSensor, RefusesOtherViews) {
  const NadirSensor sensor;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)sensor.footprint(nadir(0, 0, 0)), Error);
  EXPECT_THROW((void)sensor.footprint(nadir(0, 0, -1)), Error);
  EXPECT_THROW((void)sensor.footprint(nadir(0, nan, 1)), Error);
  EXPECT_THROW((void)sensor.footprint(look_at({0, 0, 5}, {1, 0, 0})), Error);
  EXPECT_THROW((NadirSensor{.half_angle_rad = deg(90), .pixels = 20}).validate(), Error);
  EXPECT_THROW((NadirSensor{.half_angle_rad = 0, .pixels = 20}).validate(), Error);
  EXPECT_THROW((NadirSensor{.half_angle_rad = 1, .pixels = 0}).validate(), Error);
  EXPECT_NO_THROW(sensor.validate());
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>

namespace vantage {
namespace {

TEST(Camera, FromFovSeesTheAngle) {
  const Camera c = Camera::from_fov(400, 300, deg(90));
  EXPECT_NEAR(c.fx, 200, 1e-9);
  EXPECT_EQ(c.fx, c.fy);
  EXPECT_TRUE(c.ray(0, 150).isApprox(Eigen::Vector3d(-1, 0, 1), 1e-12));
  EXPECT_TRUE(c.ray(400, 150).isApprox(Eigen::Vector3d(1, 0, 1), 1e-12));
  EXPECT_TRUE(c.ray(200, 150).isApprox(Eigen::Vector3d(0, 0, 1), 1e-12));
}

TEST(Camera, NamesEveryBadMember) {
  try {
    Camera{.width = 0, .height = 1 << 20, .fx = -1, .fy = std::numeric_limits<double>::infinity(), .cx = 0, .cy = 0}
        .validate();
    FAIL();
  } catch (const Error& e) {
    for (const char* name : {"width", "height", "fx", "fy"})
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << name;
    EXPECT_EQ(std::string(e.what()).find("cx"), std::string::npos);
    EXPECT_EQ(std::string(e.what()).find("Camera: "), 0U);
  }
  for (const double angle : {0.0, -1.0, std::numbers::pi, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(Camera::from_fov(10, 10, angle), Error) << angle;
  EXPECT_THROW(Camera::from_fov(0, 10, 1), Error);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/planning/heading.hpp>

#include <gtest/gtest.h>

#include <vantage/core/units.hpp>

namespace vantage {
namespace {

TEST(Heading, IsTheSameAtEveryPitch) {
  // Pitched about its own x axis from straight down to straight up, a camera keeps its heading.
  const View ahead = look_at({1, 1, 1}, {3, 2, 1});
  for (const double pitch : {deg(-90), deg(-89.9999), deg(-30), 0.0, deg(60), deg(89.9999), deg(90)}) {
    View v = ahead;
    v.T_W_C.rotate(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()));
    EXPECT_TRUE(heading(v).isApprox(Eigen::Vector3d(2, 1, 0).normalized(), 1e-9)) << pitch;
  }
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include <vantage/core/srgb.hpp>

namespace vantage {
namespace {

TEST(Srgb, HalfTheLightIsStoredAs188) {
  EXPECT_EQ(std::lround(255 * srgb_encoded(0.5)), 188);
  EXPECT_NEAR(srgb_linear(0.5), 0.21404, 1e-5);
}

TEST(Srgb, GoesThereAndBack) {
  for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(srgb_linear(srgb_encoded(i / 1000.0)), i / 1000.0, 1e-7);
  EXPECT_EQ(srgb_encoded(0), 0);
  EXPECT_NEAR(srgb_encoded(1), 1, 1e-12);
}

TEST(Srgb, ClampsWhatIsNoLight) {
  EXPECT_EQ(srgb_encoded(-1), 0);
  EXPECT_EQ(srgb_linear(7), 1);
}

}  // namespace
}  // namespace vantage

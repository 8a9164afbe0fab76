// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vantage/mission/palette.hpp>
#include <vector>

namespace {

using namespace vantage;

double lightness(const Rgb& c) { return detail::oklab(c).l; }
double distance(const Rgb& p, const Rgb& q) {
  const detail::Oklab a = detail::oklab(p), b = detail::oklab(q);
  return std::hypot(a.l - b.l, a.a - b.a, a.b - b.b);
}

TEST(Palette, OklabThereAndBack) {
  for (int r = 0; r < 256; r += 15)
    for (int g = 0; g < 256; g += 15)
      for (int b = 0; b < 256; b += 15) {
        const Rgb c = {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)};
        EXPECT_EQ(detail::srgb(detail::oklab(c)), c);
      }
  EXPECT_NEAR(lightness({255, 255, 255}), 1, 1e-6);
  EXPECT_NEAR(lightness({0, 0, 0}), 0, 1e-6);
}

TEST(Palette, LightnessRisesEvenly) {
  for (const Palette palette : {plum, viridis}) {
    const std::vector<Rgb> c = colours_of(palette, 33);
    const double step = (lightness(c.back()) - lightness(c.front())) / 32;
    for (std::size_t i = 1; i < c.size(); ++i)
      EXPECT_NEAR(lightness(c[i]) - lightness(c[i - 1]), step, 0.6 * step) << i;
  }
}

TEST(Palette, StepsLookAlike) {
  const std::vector<Rgb> c = colours_of(plum, 17);
  double least = 1, most = 0;
  for (std::size_t i = 1; i < c.size(); ++i) {
    least = std::min(least, distance(c[i], c[i - 1]));
    most = std::max(most, distance(c[i], c[i - 1]));
  }
  EXPECT_LT(most / least, 1.5);
}

TEST(Palette, ErrorsAreSymmetric) {
  for (const double d : {0.0, 0.1, 0.25, 0.5})
    EXPECT_NEAR(lightness(blue_white_red(0.5 - d)), lightness(blue_white_red(0.5 + d)), 0.01);
  const Rgb low = blue_white_red(0), middle = blue_white_red(0.5), high = blue_white_red(1);
  EXPECT_GT(low[2], low[0]);
  EXPECT_GT(high[0], high[2]);
  EXPECT_TRUE(middle[0] == middle[1] && middle[1] == middle[2] && middle[0] > 240);
}

TEST(Palette, ClampsAndShowsNaNGrey) {
  for (const Palette palette : {plum, blue_white_red, viridis}) {
    EXPECT_EQ(palette(-3), palette(0));
    EXPECT_EQ(palette(7), palette(1));
    EXPECT_EQ(palette(std::numeric_limits<double>::quiet_NaN()), (Rgb{224, 224, 224}));
    EXPECT_EQ(palette(std::numeric_limits<double>::infinity()), palette(1));
  }
}

}  // namespace

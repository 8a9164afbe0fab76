// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/gaussian_pixels.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace vantage {
namespace {

std::vector<float> row_of(const GaussianPixels& noise, std::uint32_t row, std::uint32_t channel, std::size_t n) {
  std::vector<float> values(n);
  noise.normals(row, channel, values);
  return values;
}

TEST(GaussianPixels, IsAFunctionOfStreamRowAndChannel) {
  const GaussianPixels noise(Rng(5));
  const auto values = row_of(noise, 3, 1, 200);
  EXPECT_EQ(row_of(GaussianPixels(Rng(5)), 3, 1, 200), values);
  for (const std::size_t n : {0U, 1U, 63U, 64U, 65U, 199U})  // whatever is asked for at once
    EXPECT_EQ(row_of(noise, 3, 1, n), std::vector<float>(values.begin(), values.begin() + static_cast<long>(n)));
  for (const auto& other : {row_of(noise, 4, 1, 200), row_of(noise, 3, 2, 200), row_of(noise, 1, 3, 200),
                            row_of(GaussianPixels(Rng(6)), 3, 1, 200)})
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NE(other[i], values[i]);
}

TEST(GaussianPixels, IsStandardNormal) {
  const GaussianPixels noise(Rng(11));
  std::vector<float> all;
  for (std::uint32_t row = 0; row < 1000; ++row) {
    const auto values = row_of(noise, row, 0, 512);
    all.insert(all.end(), values.begin(), values.end());
  }
  const auto n = static_cast<double>(all.size());
  double moment[5] = {};
  for (const float x : all)
    for (int k = 1; k <= 4; ++k) moment[k] += std::pow(static_cast<double>(x), k) / n;
  const double sigmas = 5 / std::sqrt(n);  // five standard errors
  EXPECT_NEAR(moment[1], 0, sigmas);
  EXPECT_NEAR(moment[2], 1, sigmas * std::sqrt(2.0));
  EXPECT_NEAR(moment[3], 0, sigmas * std::sqrt(15.0));
  EXPECT_NEAR(moment[4], 3, sigmas * std::sqrt(96.0));
  // Kolmogorov and Smirnov: the largest distance between the distributions is below 1.95 / sqrt(n) in 999 of 1000.
  std::sort(all.begin(), all.end());
  double largest = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    largest =
        std::max(largest, std::abs(0.5 * std::erfc(-all[i] / std::sqrt(2.0)) - (static_cast<double>(i) + 0.5) / n));
  EXPECT_LT(largest, 1.95 / std::sqrt(n));
  EXPECT_GT(all.back(), 4);  // expected beyond 4: 16 of half a million
  EXPECT_LT(all.back(), 7);
}

TEST(GaussianPixels, NeighboursRowsAndChannelsAreUncorrelated) {
  const GaussianPixels noise(Rng(2));
  double next = 0, far = 0, below = 0, channel = 0;  // lane to lane, cosine to sine, row to row, channel to channel
  constexpr std::size_t width = 512, rows = 500;
  for (std::uint32_t row = 0; row < rows; ++row) {
    const auto a = row_of(noise, row, 0, width), b = row_of(noise, row + 1, 0, width), c = row_of(noise, row, 1, width);
    for (std::size_t i = 0; i + 16 < width; ++i) {
      next += static_cast<double>(a[i]) * static_cast<double>(a[i + 1]);
      far += static_cast<double>(a[i]) * static_cast<double>(a[i + 16]);
      below += static_cast<double>(a[i]) * static_cast<double>(b[i]);
      channel += static_cast<double>(a[i]) * static_cast<double>(c[i]);
    }
  }
  const double n = static_cast<double>(rows * (width - 16));
  for (const double product : {next, far, below, channel}) EXPECT_NEAR(product / n, 0, 5 / std::sqrt(n));
}

}  // namespace
}  // namespace vantage

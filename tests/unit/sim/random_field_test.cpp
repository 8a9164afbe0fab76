// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/random_field.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace vantage {
namespace {

RandomFieldConfig size(int columns, int rows) { return {.columns = columns, .rows = rows}; }

// The same field by the obvious sums, from the same noise.
Image<double> slow(const Rng& rng, int columns, int rows, double exponent) {
  using Complex = std::complex<double>;
  const Complex turn(0, -2 * std::numbers::pi);
  Image<double> noise(rows, columns), out(rows, columns);
  for (int r = 0; r < rows; ++r) {
    Rng line = rng.fork(static_cast<std::uint64_t>(r));
    for (int c = 0; c < columns; ++c) noise(r, c) = line.normal();
  }
  out.setZero();
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u) {
      Complex f = 0;
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
          f += noise(r, c) * std::exp(turn * (double(u * c) / columns + double(v * r) / rows));
      const double kx = std::min(u, columns - u), ky = std::min(v, rows - v), k = std::hypot(kx, ky);
      f *= k > 0 ? std::pow(k, -exponent) : 0.0;
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
          out(r, c) += (f * std::exp(-turn * (double(u * c) / columns + double(v * r) / rows))).real();
    }
  return (out - out.minCoeff()) / (out.maxCoeff() - out.minCoeff());
}

TEST(RandomField, IsTheFilteredNoise) {
  for (const auto& [columns, rows] : {std::pair{8, 8}, std::pair{15, 15}, std::pair{14, 14}}) {
    const ScalarField f = random_field(Rng(5), size(columns, rows));
    EXPECT_LT((f.values() - slow(Rng(5), columns, rows, 3)).abs().maxCoeff(), 1e-12) << columns;
  }
}

TEST(RandomField, ReachesBothEndsOfTheUnitRange) {
  for (const int n : {2, 3, 64, 97, 400, 500}) {
    const ScalarField f = random_field(Rng(1), size(n, n));
    EXPECT_EQ(f.minimum(), 0) << n;
    EXPECT_EQ(f.maximum(), 1) << n;
    EXPECT_EQ(f.valid_pixels(), n * n);
  }
}

TEST(RandomField, FollowsTheSeedOnly) {
  const auto make = [](std::uint64_t seed, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return random_field(Rng(seed), size(120, 120)).values();
  };
  const Image<double> one = make(7, 1);
  EXPECT_TRUE((one == make(7, 2)).all());
  EXPECT_TRUE((one == make(7, 8)).all());
  EXPECT_GT((one - make(8, 1)).abs().maxCoeff(), 0.1);
}

TEST(RandomField, IsPeriodicAndSmooth) {
  const Image<double> f = random_field(Rng(2)).values();
  const Eigen::Index n = f.rows();
  const double inside = (f.topRows(n - 1) - f.bottomRows(n - 1)).abs().maxCoeff();
  EXPECT_LE((f.row(0) - f.row(n - 1)).abs().maxCoeff(), 1.01 * inside);
  EXPECT_LT(inside, 0.05);
}

// The power of a ring of wavenumbers falls with k^-6 times the ring's length.
TEST(RandomField, SpectrumFallsAsStated) {
  std::vector<double> power(40, 0.0), count(40, 0.0);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    detail::Spectrum s = random_field(Rng(seed), size(128, 128)).values().cast<std::complex<double>>();
    detail::transform(s, true);
    for (int v = 0; v < 128; ++v)
      for (int u = 0; u < 128; ++u) {
        const auto k = static_cast<std::size_t>(std::lround(std::hypot(std::min(u, 128 - u), std::min(v, 128 - v))));
        if (k > 0 && k < power.size()) power[k] += std::norm(s(v, u)), ++count[k];
      }
  }
  const auto mean = [&](std::size_t k) { return std::log(power[k] / count[k]); };
  EXPECT_NEAR((mean(32) - mean(8)) / std::log(4.0), -6, 0.3);
}

TEST(RandomField, IsIsotropicInMetresOnAnyRectangle) {
  const RandomFieldConfig wide{
      .area_m = {Eigen::Vector2d(0, 0), Eigen::Vector2d(40, 10)}, .columns = 256, .rows = 64, .exponent = 1};
  double along_x = 0, along_y = 0;  // mean squared differences over a metre
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Image<double> f = random_field(Rng(seed), wide).values();
    along_x += (f.leftCols(249) - f.middleCols(6, 249)).square().mean();
    along_y += (f.topRows(58) - f.bottomRows(58)).square().mean();
  }
  EXPECT_NEAR(along_y / along_x, 1, 0.1);
}

TEST(RandomField, RefusesBadConfig) {
  EXPECT_THROW(random_field(Rng(1), size(1, 10)), Error);
  EXPECT_THROW(random_field(Rng(1), size(10, 1 << 20)), Error);
  EXPECT_THROW(random_field(Rng(1), {.exponent = std::nan("")}), Error);
  EXPECT_THROW(random_field(Rng(1), {.area_m = Box2()}), Error);
}

}  // namespace
}  // namespace vantage

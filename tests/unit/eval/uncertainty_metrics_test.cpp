// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/eval/uncertainty_metrics.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "eval_reference.hpp"

namespace vantage {
namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

TEST(UncertaintyMetrics, AgreeWithScipyAndTheDefinition) {
  for (const auto& c : test::reference("uncertainty")) {
    const std::size_t n = c.at("n");
    const std::uint32_t seed = c.at("seed");
    const double correlation = c.at("correlation");
    const auto e = test::hashed(n, seed), other = test::hashed(n, seed + 1);
    std::vector<double> error(n), magnitude(n), uncertainty(n), levels(n), magnitude_levels(n);
    for (std::size_t i = 0; i < n; ++i) {
      error[i] = 2 * e[i] - 1;
      magnitude[i] = std::abs(error[i]);
      uncertainty[i] = correlation * magnitude[i] + (1 - correlation) * other[i];
      levels[i] = std::floor(8 * uncertainty[i]);
      magnitude_levels[i] = std::floor(16 * magnitude[i]);
    }
    EXPECT_NEAR(spearman(uncertainty, magnitude), c.at("spearman").get<double>(), 1e-12);
    EXPECT_NEAR(spearman(levels, magnitude_levels), c.at("spearman_ties").get<double>(), 1e-12);
    double squares = 0;
    for (const double r : ranks(levels)) squares += r * r;
    EXPECT_NEAR(squares, c.at("rank_sum_of_squares").get<double>(), 1e-6);
    EXPECT_NEAR(ause(uncertainty, error), c.at("ause").get<double>(), 1e-12);
  }
}

TEST(Spearman, ClosedForms) {
  const std::vector<double> a{1, 2, 3, 4, 5}, squares{1, 4, 9, 16, 25}, down{9, 7, 5, 1, 0}, flat{2, 2, 2, 2, 2};
  EXPECT_DOUBLE_EQ(spearman(a, squares), 1);
  EXPECT_DOUBLE_EQ(spearman(a, down), -1);
  EXPECT_TRUE(std::isnan(spearman(a, flat)));
  const std::vector<double> swapped{2, 1, 4, 3, 5};  // 1 - 6 sum d^2 / (n (n^2 - 1))
  EXPECT_DOUBLE_EQ(spearman(a, swapped), 1 - 6.0 * 4 / (5 * 24));
  EXPECT_EQ(ranks(std::vector<double>{3, 1, 3, 2}), (std::vector<double>{3.5, 1, 3.5, 2}));
}

TEST(Ause, ClosedForms) {
  const std::size_t n = 1000;
  std::vector<double> error(n), flat(n, 0.5), opposite(n);
  for (std::size_t i = 0; i < n; ++i) {
    error[i] = (i % 2 ? -1.0 : 1.0) * static_cast<double>(i + 1);
    opposite[i] = -static_cast<double>(i);
  }
  std::vector<double> perfect(n);
  for (std::size_t i = 0; i < n; ++i) perfect[i] = std::exp(std::abs(error[i]) / 100);
  EXPECT_NEAR(ause(perfect, error), 0, 1e-12) << "only the order counts";
  // A constant uncertainty leaves a mean sample: the curve stays at 1, the oracle's falls as the kept share s.
  const Sparsification s = sparsification(flat, error);
  for (std::size_t k = 0; k < 100; ++k) {
    EXPECT_NEAR(s.by_uncertainty[k], 1, 1e-12);
    EXPECT_NEAR(s.oracle[k], 1 - static_cast<double>(k) / 100, 2e-3) << "the RMSE of i = 1 .. s n is s n / sqrt(3)";
  }
  EXPECT_NEAR(s.ause, 0.99 * 0.99 / 2, 2e-3);
  EXPECT_GT(ause(opposite, error), s.ause);
  EXPECT_EQ(ause(flat, std::vector<double>(n, 0.0)), 0);
  EXPECT_NEAR(ause(opposite, std::vector<double>(n, -3.0)), 0, 1e-12);
}

TEST(Ause, TiesDoNotDependOnTheOrderOfPixels) {
  std::vector<double> error{1, 5, 2, 8, 3, 9, 4, 7}, uncertainty{1, 1, 1, 1, 2, 2, 2, 2};
  const double before = ause(uncertainty, error);
  std::swap(error[0], error[3]);
  std::swap(error[4], error[7]);
  EXPECT_NEAR(ause(uncertainty, error), before, 1e-12);
}

TEST(UncertaintyMetrics, Refuse) {
  const std::vector<double> two{1, 2}, three{1, 2, 3}, bad{1, nan};
  EXPECT_THROW(static_cast<void>(spearman(two, three)), Error);
  EXPECT_THROW(static_cast<void>(spearman(two, bad)), Error);
  EXPECT_THROW(static_cast<void>(spearman({}, {})), Error);
  EXPECT_THROW(static_cast<void>(ause(two, three)), Error);
  EXPECT_THROW(static_cast<void>(ause({}, {})), Error);
  EXPECT_THROW(static_cast<void>(ause(bad, two)), Error);
  EXPECT_THROW(static_cast<void>(ause(two, bad)), Error);
  EXPECT_THROW(static_cast<void>(ause(two, two, 1)), Error);
}

}  // namespace
}  // namespace vantage

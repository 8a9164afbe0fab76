// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/maps/field/matern.hpp>

namespace {

using namespace vantage;

Interval random_interval(Rng& rng) {
  const double low = rng.uniform(0, 20);
  return {low, low + std::exp(rng.uniform(std::log(0.01), std::log(10.0)))};
}

TEST(GaussLegendre, IsExactForPolynomialsOfDegreeTwiceItsPointsLessOne) {
  constexpr GaussLegendre<16> rule{};
  static_assert(rule.node[0] < -0.98 && rule.weight[0] > 0);
  for (int degree = 0; degree < 32; ++degree) {
    double sum = 0;
    for (std::size_t i = 0; i < 16; ++i) sum += rule.weight[i] * std::pow(rule.node[i], degree);
    EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0, 4e-15) << "degree " << degree;
  }
  double sum = 0;
  for (std::size_t i = 0; i < 16; ++i) sum += rule.weight[i] * std::pow(rule.node[i], 32);
  EXPECT_GT(std::abs(sum - 2.0 / 33), 1e-12);  // and not beyond
}

TEST(QuadratureAverage, AgreesWithTheClosedFormOfTheSquaredExponential) {
  Rng rng(1);
  const SquaredExponential kernel{.variance = 3, .length_m = 2.36};
  for (int k = 0; k < 2000; ++k) {
    const Interval a = random_interval(rng), b = random_interval(rng);
    const double closed = kernel.average(a, b), numerical = quadrature_average(kernel, a, b);
    EXPECT_NEAR(numerical, closed, 1e-13) << a.low << " " << a.high << " " << b.low << " " << b.high;
    if (numerical > 1e-8) { EXPECT_NEAR(closed / numerical, 1, 1e-11); }
  }
}

TEST(QuadratureAverage, AgreesWithADoubleIntegral) {
  // The definition, by a two-dimensional midpoint rule that does not know about kinks.
  const auto slow = [](const auto& kernel, const Interval& a, const Interval& b) {
    const int n = 2000;
    double sum = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        sum += kernel.correlation(a.low + a.length() * (i + 0.5) / n - b.low - b.length() * (j + 0.5) / n);
    return sum / (n * n);
  };
  const auto check = [&](const auto& kernel) {
    for (const auto& [a, b] : std::vector<std::pair<Interval, Interval>>{
             {{0, 1}, {0, 1}}, {{0, 1}, {0.5, 4}}, {{0, 5}, {1, 2}}, {{0, 2}, {2, 3}}, {{0, 2}, {7, 9}}})
      EXPECT_NEAR(kernel.average(a, b), slow(kernel, a, b), 1e-6) << kernel.name;
  };
  check(SquaredExponential{1, 0.9});
  check(Matern12{1, 0.9});
  check(Matern32{1, 0.9});
  check(Matern52{1, 0.9});
}

// With F'' = c, F(d) = l^2 exp(-d / l) + l d, the average of the Matern 1/2 is a second difference.
TEST(Matern, OneHalfHasTheClosedFormOfTheExponential) {
  Rng rng(2);
  const Matern12 kernel{.variance = 1, .length_m = 1.7};
  const double l = kernel.length_m;
  const auto f = [&](double d) { return l * l * std::exp(-std::abs(d) / l) + l * std::abs(d); };
  for (int k = 0; k < 2000; ++k) {
    const Interval a = random_interval(rng), b = random_interval(rng);
    const double integral = f(a.high - b.low) - f(a.low - b.low) - f(a.high - b.high) + f(a.low - b.high);
    const double cancelled = 1e-14 * (20 * l) / (a.length() * b.length());  // what the difference loses
    EXPECT_NEAR(kernel.average(a, b), integral / (a.length() * b.length()), 1e-13 + cancelled);
  }
}

template <class K>
struct AnyKernel : testing::Test {};
using Kernels = testing::Types<SquaredExponential, Matern12, Matern32, Matern52>;
TYPED_TEST_SUITE(AnyKernel, Kernels);

TYPED_TEST(AnyKernel, AverageIsAMean) {
  Rng rng(3);
  const TypeParam kernel{.variance = 2, .length_m = 2.36};
  static_assert(SeparableKernel<TypeParam>);
  EXPECT_DOUBLE_EQ(kernel.correlation(0), 1);
  for (int k = 0; k < 300; ++k) {
    const Interval a = random_interval(rng), b = random_interval(rng);
    const double middle = 0.3 * a.low + 0.7 * a.high;
    const Interval left{a.low, middle}, right{middle, a.high};
    EXPECT_NEAR(kernel.average(a, b), kernel.average(b, a), 1e-14);
    // Additive in the interval: the average over a is the weighted average over its parts.
    EXPECT_NEAR(kernel.average(a, b), 0.7 * kernel.average(left, b) + 0.3 * kernel.average(right, b), 2e-13);
    // Thin intervals: the kernel at the centres.
    const Interval p{a.low, a.low + 1e-9}, q{b.low, b.low + 1e-9};
    EXPECT_NEAR(kernel.average(p, q), kernel.correlation(p.centre() - q.centre()), 1e-8);
    EXPECT_LE(kernel.average(a, b), 1);
    EXPECT_GE(kernel.average(a, b), 0);
  }
}

TYPED_TEST(AnyKernel, AverageKeepsItsRelativeAccuracyFarAway) {
  const TypeParam kernel{.variance = 1, .length_m = 1};
  const Interval a{0, 1}, b{15, 16};
  double slow = 0;  // Gauss-Legendre over the square: smooth there
  constexpr GaussLegendre<16> rule{};
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t j = 0; j < 16; ++j)
      slow += 0.25 * rule.weight[i] * rule.weight[j] * kernel.correlation(15 + 0.5 * (rule.node[j] - rule.node[i]));
  EXPECT_NEAR(kernel.average(a, b) / slow, 1, 1e-12);
}

TYPED_TEST(AnyKernel, CovarianceOfCellsIsPositiveDefinite) {
  const TypeParam kernel{.variance = 1, .length_m = 2.36};
  Eigen::MatrixXd k(24, 24);
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j) k(i, j) = kernel.average({i * 0.8, (i + 1) * 0.8}, {j * 0.8, (j + 1) * 0.8});
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues()[0], -1e-14);
}

TYPED_TEST(AnyKernel, RefusesBadParameters) {
  EXPECT_THROW((TypeParam{.variance = 0, .length_m = 1}.validate()), Error);
  EXPECT_THROW((TypeParam{.variance = 1, .length_m = std::nan("")}.validate()), Error);
  try {
    TypeParam{.variance = -1, .length_m = -2}.validate();
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("variance"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("length_m"), std::string::npos);
  }
}

}  // namespace

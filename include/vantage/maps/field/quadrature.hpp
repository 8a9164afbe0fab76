// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace vantage {

/// A stretch of one axis [m].
struct Interval {
  double low = 0, high = 0;
  [[nodiscard]] double length() const { return high - low; }
  [[nodiscard]] double centre() const { return 0.5 * (low + high); }
};

/// Nodes and weights of the N-point Gauss-Legendre rule on [-1, 1], exact for polynomials of degree 2 N - 1.
template <std::size_t N>
struct GaussLegendre {
  std::array<double, N> node{}, weight{};

  /// Newton's method on P_N from Chebyshev's guesses; at compile time, hence a cosine of our own.
  constexpr GaussLegendre() {
    for (std::size_t i = 0; i < N; ++i) {
      double x = -cosine(std::numbers::pi * (static_cast<double>(i) + 0.75) / (static_cast<double>(N) + 0.5)),
             slope = 0;
      for (int iteration = 0; iteration < 8; ++iteration) {
        double p = 1, before = 0;
        for (std::size_t k = 0; k < N; ++k) {
          const auto n = static_cast<double>(k);
          const double next = ((2 * n + 1) * x * p - n * before) / (n + 1);
          before = p;
          p = next;
        }
        slope = static_cast<double>(N) * (x * p - before) / (x * x - 1);
        x -= p / slope;
      }
      node[i] = x;
      weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
  }

 private:
  static constexpr double cosine(double x) {
    double term = 1, sum = 1;
    for (int k = 1; k < 20; ++k) sum += term *= -x * x / ((2 * k - 1) * (2 * k));
    return sum;
  }
};

/// Mean of c(u - v) over u in a, v in b, for a function c that is smooth but for a kink at 0 and varies over lengths of
/// about `scale`: one factor of eq. 3.3 by numerical integration.
///
/// The double integral is a single one, of c(d) against the length of a that meets b + d: a trapezoid in d. 16-point
/// Gauss-Legendre between its corners and the kink, in panels of at most 3 scales. It is a weighted mean of values of c
/// (the weights' sum is |a| |b|, and taken from the same rule), so that distant and thin intervals keep their relative
/// accuracy, about 1e-14.
template <class Correlation>
double average_over(const Interval& a, const Interval& b, double scale, Correlation&& c) {
  static constexpr GaussLegendre<16> rule{};
  std::array<double, 5> corner = {a.low - b.high, std::min(a.low - b.low, a.high - b.high),
                                  std::max(a.low - b.low, a.high - b.high), a.high - b.low, 0.0};
  const double first = corner[0], last = corner[3], plateau = std::min(a.length(), b.length());
  corner[4] = std::clamp(0.0, first, last);
  std::sort(corner.begin(), corner.end());
  double integral = 0, total = 0;
  for (std::size_t k = 0; k + 1 < corner.size(); ++k) {
    const double width = corner[k + 1] - corner[k];
    if (!(width > 0)) continue;
    const auto panels = static_cast<std::size_t>(std::clamp(std::ceil(width / (3 * scale)), 1.0, 1e6));
    const double half = 0.5 * width / static_cast<double>(panels);
    for (std::size_t p = 0; p < panels; ++p) {
      const double middle = corner[k] + half * static_cast<double>(2 * p + 1);
      for (std::size_t i = 0; i < rule.node.size(); ++i) {
        const double d = middle + half * rule.node[i];
        const double w = half * rule.weight[i] * std::min({d - first, plateau, last - d});
        integral += w * c(d);
        total += w;
      }
    }
  }
  return integral / total;
}

}  // namespace vantage

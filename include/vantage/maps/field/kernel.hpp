// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <numbers>
#include <string_view>

#include <vantage/core/error.hpp>
#include <vantage/maps/field/quadrature.hpp>

namespace vantage {

/// A stationary kernel that is a product over the axes, k(x, x') = variance c(x1 - x1') c(x2 - x2'), with
/// `correlation(d)` = c(d), c(0) = 1, and `average(a, b)` = the mean of c over a x b (one factor of eq. 3.3).
template <class K>
concept SeparableKernel = std::copyable<K> && requires(const K k, double d, const Interval& a) {
  { k.variance } -> std::convertible_to<double>;
  { k.length_m } -> std::convertible_to<double>;
  { k.correlation(d) } -> std::convertible_to<double>;
  { k.average(a, a) } -> std::convertible_to<double>;
  { K::name } -> std::convertible_to<std::string_view>;
  k.validate();
};

/// The average of a kernel that has no closed form, or a check of one that has: eq. 3.3 by numerical integration.
template <SeparableKernel K>
double quadrature_average(const K& kernel, const Interval& a, const Interval& b) {
  return average_over(a, b, kernel.length_m, [&](double d) { return kernel.correlation(d); });
}

/// Squared exponential, eq. 3.4, whose average over two rectangles (eq. 3.3) has a closed form. Immutable; thread-safe.
struct SquaredExponential {
  static constexpr std::string_view name = "squared_exponential";
  double variance = 1.0;   ///< sigma^2 > 0, in the field's unit squared
  double length_m = 2.36;  ///< l > 0

  void validate() const {
    Check check("SquaredExponential");
    check.positive("variance", variance);
    check.positive("length_m", length_m);
    check.done();
  }
  [[nodiscard]] double correlation(double d) const { return std::exp(-0.5 * (d / length_m) * (d / length_m)); }

  /// With F'' = c, the double integral is the second difference F(a1-b0) - F(a0-b0) - F(a1-b1) + F(a0-b1). Where the
  /// intervals do not overlap, F's asymptote is left out (it cancels), so that far pairs keep their relative accuracy.
  /// Small intervals, where the difference itself cancels (by about l^2 / (|a| |b|) digits' worth), are integrated.
  [[nodiscard]] double average(const Interval& a, const Interval& b) const {
    if (a.length() * b.length() < 0.1 * length_m * length_m) return quadrature_average(*this, a, b);
    const bool apart = a.low >= b.high || b.low >= a.high;
    const auto f = [&](double d) { return apart ? tail(std::abs(d)) : tail(std::abs(d)) + slope() * std::abs(d); };
    const double integral = f(a.high - b.low) - f(a.low - b.low) - f(a.high - b.high) + f(a.low - b.high);
    return integral / (a.length() * b.length());
  }

 private:
  [[nodiscard]] double slope() const { return std::sqrt(std::numbers::pi / 2) * length_m; }
  // F(d) less its asymptote, d >= 0.
  [[nodiscard]] double tail(double d) const {
    return length_m * length_m * correlation(d) - slope() * d * std::erfc(d / (std::numbers::sqrt2 * length_m));
  }
};

/// What a cell's value stands for: the field's average over the cell, eq. 3.1.
struct CellAverage {
  static constexpr std::string_view name = "cell_average";
  template <SeparableKernel K>
  static double correlation(const K& kernel, const Interval& a, const Interval& b) {
    return kernel.average(a, b);
  }
};

/// What a cell's value stands for: the field at the cell's centre (GP fusion before integral kernels).
struct CellCentre {
  static constexpr std::string_view name = "cell_centre";
  template <SeparableKernel K>
  static double correlation(const K& kernel, const Interval& a, const Interval& b) {
    return kernel.correlation(a.centre() - b.centre());
  }
};

}  // namespace vantage

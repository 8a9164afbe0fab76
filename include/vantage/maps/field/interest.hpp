// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <string_view>

#include <vantage/core/error.hpp>

namespace vantage {

/// Which part of a field matters, one policy for merging, planning and metrics: `hot(value)` for known values,
/// `interesting(mean, variance)` for beliefs, with a margin (its complement may be merged), `target(mean, variance)`
/// for the region whose variance the planner reduces.
template <class I>
concept Interest = std::copyable<I> && requires(const I i, double x) {
  { i.hot(x) } -> std::same_as<bool>;
  { i.interesting(x, x) } -> std::same_as<bool>;
  { i.target(x, x) } -> std::same_as<bool>;
  i.validate();
};

/// <thesis>, eq. 3.8: interesting unless mean + gamma variance <= threshold, in merging and in planning.
struct VarianceMargin {
  static constexpr std::string_view name = "variance_margin";
  double gamma = 2;
  [[nodiscard]] bool interesting(double excess, double variance) const { return !(excess + gamma * variance <= 0); }
  [[nodiscard]] bool target(double excess, double variance) const { return interesting(excess, variance); }
};

/// <reference>: merged only where mean + gamma deviation < threshold; planned for where mean >= threshold.
struct DeviationMargin {
  static constexpr std::string_view name = "deviation_margin";
  double gamma = 1;
  [[nodiscard]] bool interesting(double excess, double variance) const {
    return !(excess + gamma * std::sqrt(variance) < 0);
  }
  [[nodiscard]] bool target(double excess, double) const { return excess >= 0; }
};

/// Interested in values above (Sign = +1) or below (Sign = -1) a threshold in the field's unit.
template <int Sign, class Margin>
struct Beyond {
  static_assert(Sign == 1 || Sign == -1);
  double threshold = 0.7;
  Margin margin = {};

  [[nodiscard]] bool hot(double value) const { return Sign * (value - threshold) > 0; }
  [[nodiscard]] bool interesting(double mean, double variance) const {
    return margin.interesting(Sign * (mean - threshold), variance);
  }
  [[nodiscard]] bool target(double mean, double variance) const {
    return margin.target(Sign * (mean - threshold), variance);
  }
  void validate() const {
    Check check("Interest");
    check.finite("threshold", threshold);
    check.not_negative("margin.gamma", margin.gamma);
    check.done();
  }
};
template <class Margin = VarianceMargin>
using Above = Beyond<1, Margin>;
template <class Margin = VarianceMargin>
using Below = Beyond<-1, Margin>;

}  // namespace vantage

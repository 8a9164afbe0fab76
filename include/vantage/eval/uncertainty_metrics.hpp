// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include <vantage/core/error.hpp>

// Whether uncertainty tells where the error is (section 4.2.2).
namespace vantage {

namespace uncertainty_metrics {

inline void check_finite(std::string_view where, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) throw Error(where, concat("value ", i, " is ", values[i]), "finite numbers");
}

/// Indices in ascending order of their values.
inline std::vector<std::size_t> ascending(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(
      order, [&](std::size_t a, std::size_t b) { return values[a] < values[b] || (values[a] == values[b] && a < b); });
  return order;
}

/// f(begin, end) for the runs of equal values in that order.
template <class F>
void for_ties(std::span<const double> values, const std::vector<std::size_t>& order, F&& f) {
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    f(begin, end);
  }
}

}  // namespace uncertainty_metrics

/// Ranks 1 to n, equal values get the mean of theirs. Throws Error for values that are not finite. O(n log n).
inline std::vector<double> ranks(std::span<const double> values) {
  uncertainty_metrics::check_finite("ranks", values);
  const auto order = uncertainty_metrics::ascending(values);
  std::vector<double> rank(values.size());
  uncertainty_metrics::for_ties(values, order, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) rank[order[i]] = static_cast<double>(begin + end + 1) / 2;
  });
  return rank;
}

/// Spearman's rank correlation coefficient in [-1, 1]: Pearson's of the ranks; NaN if one side is constant. Throws
/// Error for fewer than two pairs, sides of different lengths, or values that are not finite.
inline double spearman(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size() || a.size() < 2)
    throw Error("spearman", concat(a.size(), " and ", b.size(), " values"), "as many of both, and two at least");
  const std::vector<double> x = ranks(a), y = ranks(b);
  const double mean = (static_cast<double>(a.size()) + 1) / 2;
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
    xy += (x[i] - mean) * (y[i] - mean);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : std::numeric_limits<double>::quiet_NaN();
}

/// Sparsification (Ilg et al., "Uncertainty estimates and multi-hypotheses networks for optical flow", ECCV 2018): the
/// RMSE of the pixels that are left after the share k / n of the most uncertain ones (or, for the oracle, of those with
/// the largest errors) was removed, k = 0 to n - 1, as a share of the RMSE of all.
struct Sparsification {
  std::vector<double> by_uncertainty, oracle;  ///< by_uncertainty[0] = oracle[0] = 1
  double ause = 0;  ///< area between the two over the removed share in [0, 1 - 1 / n], by the trapezoidal rule; >= 0
};

/// `error`: per pixel, its sign does not count (for colours: the root of the mean square over the channels). Of N
/// pixels, floor((1 - k / n) N), and one at least, are left. Pixels of equal uncertainty are removed in no particular
/// order: each counts with the mean square error of all of them. If all errors are zero, both curves are 0. Throws
/// Error for no pixels, sides of different lengths, values that are not finite, or n < 2. O(N log N).
inline Sparsification sparsification(std::span<const double> uncertainty, std::span<const double> error,
                                     std::size_t n = 100) {
  using namespace uncertainty_metrics;
  const std::size_t pixels = error.size();
  if (uncertainty.size() != pixels || pixels == 0)
    throw Error("sparsification", concat(uncertainty.size(), " uncertainties and ", pixels, " errors"),
                "as many of both, and one at least");
  if (n < 2) throw Error("sparsification", concat("n = ", n), "two shares at least");
  check_finite("sparsification", uncertainty);
  check_finite("sparsification", error);
  std::vector<double> squared(pixels);
  std::ranges::transform(error, squared.begin(), [](double e) { return e * e; });

  // Sums of squares of the pixels that would stay longest, one pixel more at a time.
  std::vector<double> kept(pixels + 1), kept_oracle(pixels + 1);
  const auto order = ascending(uncertainty);
  for_ties(uncertainty, order, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += squared[order[i]];
    for (std::size_t i = begin; i < end; ++i) kept[i + 1] = kept[i] + sum / static_cast<double>(end - begin);
  });
  std::ranges::sort(squared);
  std::partial_sum(squared.begin(), squared.end(), kept_oracle.begin() + 1);

  Sparsification s{.by_uncertainty = std::vector<double>(n), .oracle = std::vector<double>(n)};
  const double all = std::sqrt(kept_oracle[pixels] / static_cast<double>(pixels));
  for (std::size_t k = 0; k < n && all > 0; ++k) {
    const std::size_t left = std::max<std::size_t>(1, (n - k) * pixels / n);
    s.by_uncertainty[k] = std::sqrt(kept[left] / static_cast<double>(left)) / all;
    s.oracle[k] = std::sqrt(kept_oracle[left] / static_cast<double>(left)) / all;
  }
  for (std::size_t k = 0; k + 1 < n; ++k)
    s.ause +=
        (s.by_uncertainty[k] - s.oracle[k] + s.by_uncertainty[k + 1] - s.oracle[k + 1]) / static_cast<double>(2 * n);
  return s;
}

/// Area under the sparsification error: 0 if uncertainty ranks the pixels as their errors do.
inline double ause(std::span<const double> uncertainty, std::span<const double> error, std::size_t n = 100) {
  return sparsification(uncertainty, error, n).ause;
}

}  // namespace vantage

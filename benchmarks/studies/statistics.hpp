// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <vantage/core/error.hpp>

namespace study {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Mean and sample deviation (n - 1) of the values that are not NaN; NaN for none, deviation 0 for one.
struct Summary {
  double mean = nan, deviation = nan;
  std::size_t count = 0;

  static Summary of(std::span<const double> values) {
    Summary s;
    double sum = 0, squares = 0;
    for (const double v : values)
      if (!std::isnan(v)) {
        sum += v;
        ++s.count;
      }
    if (s.count == 0) return s;
    s.mean = sum / static_cast<double>(s.count);
    for (const double v : values)
      if (!std::isnan(v)) squares += (v - s.mean) * (v - s.mean);
    s.deviation = s.count > 1 ? std::sqrt(squares / static_cast<double>(s.count - 1)) : 0;
    return s;
  }
  [[nodiscard]] double standard_error() const { return deviation / std::sqrt(static_cast<double>(count)); }
};

/// Of a - b, pair by pair: the same field under two methods. Pairs with a NaN do not count.
inline Summary difference(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size())
    throw vantage::Error("difference", vantage::concat(a.size(), " and ", b.size(), " values"), "pairs");
  std::vector<double> d(a.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = a[i] - b[i];
  return Summary::of(d);
}

inline double median(std::vector<double> values) {
  if (values.empty()) return nan;
  const std::size_t half = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Times from 0 to `end_s`, both included, `step_s` apart.
inline std::vector<double> time_grid(double end_s, double step_s) {
  std::vector<double> t;
  for (std::size_t i = 0; static_cast<double>(i) * step_s <= end_s * (1 + 1e-12); ++i)
    t.push_back(static_cast<double>(i) * step_s);
  return t;
}

namespace detail {

inline void check_history(const char* where, std::span<const double> time, std::span<const double> value) {
  if (time.size() != value.size())
    throw vantage::Error(where, vantage::concat(time.size(), " times, ", value.size(), " values"), "as many of each");
  if (!std::is_sorted(time.begin(), time.end())) throw vantage::Error(where, "the times do not ascend", "a history");
}

}  // namespace detail

/// A quantity that changes at each of `time` (ascending) and holds its value until the next, on a grid; NaN before the
/// first: what is known of a map at a time is what the last measurement before it left.
inline std::vector<double> held(std::span<const double> time, std::span<const double> value,
                                std::span<const double> grid) {
  detail::check_history("held", time, value);
  std::vector<double> out;
  for (const double t : grid) {
    const auto after = std::upper_bound(time.begin(), time.end(), t);
    out.push_back(after == time.begin() ? nan : value[static_cast<std::size_t>(after - time.begin()) - 1]);
  }
  return out;
}

/// A quantity that was looked at at each of `time` (ascending) and changed in between, on a grid: straight lines
/// between the looks, the last value after them; NaN before the first.
inline std::vector<double> between_looks(std::span<const double> time, std::span<const double> value,
                                         std::span<const double> grid) {
  detail::check_history("between_looks", time, value);
  std::vector<double> out;
  for (const double t : grid) {
    const auto after = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
    if (after == 0 || after == time.size())
      out.push_back(after == 0 ? nan : value.back());
    else
      out.push_back(std::lerp(value[after - 1], value[after], (t - time[after - 1]) / (time[after] - time[after - 1])));
  }
  return out;
}

}  // namespace study

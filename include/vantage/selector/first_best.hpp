// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <limits>
#include <optional>

namespace vantage {

/// "Not to be chosen."
inline constexpr double excluded = -std::numeric_limits<double>::infinity();

/// The index in [0, n) with the largest score(i), the lowest one at a tie; none if all are `excluded`.
template <class F>
std::optional<std::size_t> first_best(std::size_t n, F&& score) {
  std::optional<std::size_t> best;
  double highest = excluded;
  for (std::size_t i = 0; i < n; ++i)
    if (const double s = score(i); s > highest) {
      highest = s;
      best = i;
    }
  return best;
}

}  // namespace vantage

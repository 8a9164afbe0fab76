// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// Which of the distances to the views measured so far counts.
struct Nearest {};
struct Mean {};
struct Sum {};

/// How far a view is from those measured so far [m], whatever the map: the baseline "Max. View Distance" of chapters 4
/// and 5. Needs no map. 0 for every view while nothing has been measured. Orientation does not count. Views already in
/// the sequence count as measured.
template <class Which = Nearest>
struct ViewDistance {
  static_assert(std::same_as<Which, Nearest> || std::same_as<Which, Mean> || std::same_as<Which, Sum>,
                "vantage: ViewDistance<Which> takes Nearest, Mean or Sum");

  template <Map M>
  auto prepare(const M&, const Situation& q, Rng) const {
    return [visited = q.visited](Views given, Views views, std::span<double> out) {
      for (std::size_t i = 0; i < views.size(); ++i) out[i] = distance(views[i], visited, given);
    };
  }

 private:
  static double distance(const View& view, Views visited, Views given) {
    const std::size_t n = visited.size() + given.size();
    if (n == 0) return 0;
    double nearest = std::numeric_limits<double>::infinity(), sum = 0;
    for (const Views& set : {visited, given})
      for (const View& v : set) {
        const double d = distance_m(view, v);
        nearest = std::min(nearest, d);
        sum += d;
      }
    if constexpr (std::same_as<Which, Nearest>)
      return nearest;
    else if constexpr (std::same_as<Which, Mean>)
      return sum / static_cast<double>(n);
    else
      return sum;
  }
};

}  // namespace vantage

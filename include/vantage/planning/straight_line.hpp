// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// The router of free space: every goal is reached on a straight line, as a UAV above a field reaches it.
struct StraightLine {
  template <Map M>
  std::vector<double> lengths_m(const M&, const View& from, Views goals) const {
    std::vector<double> lengths;
    lengths.reserve(goals.size());
    for (const View& goal : goals) lengths.push_back(distance_m(from, goal));
    return lengths;
  }
  template <Map M>
  std::vector<View> path(const M&, const View& from, const View& goal) const {
    return {from, goal};
  }
};

}  // namespace vantage

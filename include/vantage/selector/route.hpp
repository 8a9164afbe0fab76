// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>

// What the selectors that take any Router share.
namespace vantage {

/// Path lengths to the candidates [m], infinity where there is none. Throws Error if the router breaks its promise.
template <Map M, RouterFor<M> Router>
std::vector<double> checked_lengths_m(const Router& router, const M& map, const View& from, Views goals) {
  std::vector<double> lengths = router.lengths_m(map, from, goals);
  if (lengths.size() != goals.size())
    throw Error("Router::lengths_m", concat(lengths.size(), " lengths"), concat(goals.size(), ", one per goal"));
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if (!(lengths[i] >= 0))
      throw Error("Router::lengths_m", concat("length ", i, " is ", lengths[i]),
                  ">= 0, infinity where there is no path");
  return lengths;
}

/// The decision to follow the router's path to candidate `index`.
template <Map M, RouterFor<M> Router>
Decision follow_route(const Router& router, const M& map, const View& from, const Candidates& c, std::size_t index,
                      double length_m, double speed_m_s) {
  return {.index = index,
          .path = router.path(map, from, c.views[index]),
          .travel_s = length_m / speed_m_s,
          .travel_m = length_m};
}

}  // namespace vantage

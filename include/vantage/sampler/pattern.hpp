// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// A fixed sequence of views: proposes the first that has not been visited yet, and nothing once all have been. It
/// keeps no state, so it goes on after a crash by itself. A view counts as visited when a measurement was taken within
/// `reached_m` of it: robots do not arrive to the millimetre.
class Pattern {
 public:
  template <Map M>
  Candidates sample(const M&, const Situation& q, const Score&, Rng&) const {
    for (const View& v : views_)
      if (std::none_of(q.visited.begin(), q.visited.end(),
                       [&](const View& p) { return distance_m(p, v) <= reached_m_; }))
        return {.views = {v}};
    return {};
  }
  /// The whole sequence, in order.
  [[nodiscard]] const std::vector<View>& views() const& { return views_; }
  // So that `for (v : Spiral(...).views())` works.
  [[nodiscard]] std::vector<View> views() && { return std::move(views_); }

 protected:
  Pattern(std::vector<View> views, double reached_m) : views_(std::move(views)), reached_m_(reached_m) {}

 private:
  std::vector<View> views_;
  double reached_m_;
};

}  // namespace vantage

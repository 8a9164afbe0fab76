// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/selector/first_best.hpp>

namespace vantage {

/// The best view, whatever it costs to get there: eq. 2.19 without its cost term. Travel is counted along the straight
/// line; for another way there see MinusCost.
class ArgMax {
 public:
  struct Config {
    double speed_m_s = 1;  ///< > 0
  };
  ArgMax() = default;
  explicit ArgMax(const Config& config) : config_(config) {
    Check check("ArgMax::Config");
    check.positive("speed_m_s", config.speed_m_s);
    check.done();
  }
  template <Map M>
  std::optional<Decision> select(const M&, const Situation& q, const Candidates& c, const Score&, Rng&) const {
    const auto best = first_best(c.views.size(), [&](std::size_t i) { return c.utilities[i]; });
    if (!best) return std::nullopt;
    const double travel_m = distance_m(q.here, c.views[*best]);
    return Decision{.index = *best, .travel_s = travel_m / config_.speed_m_s, .travel_m = travel_m};
  }

 private:
  Config config_{};
};

}  // namespace vantage

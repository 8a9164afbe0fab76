// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// The first candidate, whatever its utility: follows the order of a Lawnmower, a Spiral or a Pool. Travel is counted
/// along the straight line.
class InOrder {
 public:
  struct Config {
    double speed_m_s = 1;  ///< > 0
  };
  InOrder() = default;
  explicit InOrder(const Config& config) : config_(config) {
    Check check("InOrder::Config");
    check.positive("speed_m_s", config.speed_m_s);
    check.done();
  }
  template <Map M>
  std::optional<Decision> select(const M&, const Situation& q, const Candidates& c, const Score&, Rng&) const {
    if (c.views.empty()) return std::nullopt;
    const double travel_m = distance_m(q.here, c.views.front());
    return Decision{.index = 0, .travel_s = travel_m / config_.speed_m_s, .travel_m = travel_m};
  }

 private:
  Config config_{};
};

}  // namespace vantage

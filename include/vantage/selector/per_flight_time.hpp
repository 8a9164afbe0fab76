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

/// The most utility per second of flight (eq. 3.14), along the straight line at constant speed:
///
///     v* = arg max over v of psi(v) / T(v, v_current)
///
/// A candidate at the current position is never chosen: its flight takes no time, so staying would always win. Ratios
/// mean something only for utilities >= 0: throws Error for others.
class PerFlightTime {
 public:
  struct Config {
    double speed_m_s = 1;  ///< > 0
    double epsilon_s = 0;  ///< added to T, >= 0; the published code (`reference`) adds 1e-5
    static Config thesis() { return {}; }
    static Config reference() { return {.epsilon_s = 1e-5}; }
  };
  PerFlightTime() = default;
  explicit PerFlightTime(const Config& config) : config_(config) {
    Check check("PerFlightTime::Config");
    check.positive("speed_m_s", config.speed_m_s);
    check.not_negative("epsilon_s", config.epsilon_s);
    check.done();
  }
  template <Map M>
  std::optional<Decision> select(const M&, const Situation& q, const Candidates& c, const Score&, Rng&) const {
    const auto flight_s = [&](std::size_t i) { return distance_m(q.here, c.views[i]) / config_.speed_m_s; };
    const auto best = first_best(c.views.size(), [&](std::size_t i) {
      const double psi = c.utilities[i];
      if (psi < 0)
        throw Error("PerFlightTime", concat("the utility of candidate ", i, " is ", psi),
                    ">= 0; take MinusCost or TravelTradeoff for a utility that may be negative");
      return same_place(q.here, c.views[i]) ? excluded : psi / (flight_s(i) + config_.epsilon_s);
    });
    if (!best) return std::nullopt;
    return Decision{.index = *best, .travel_s = flight_s(*best), .travel_m = distance_m(q.here, c.views[*best])};
  }

 private:
  Config config_{};
};

}  // namespace vantage

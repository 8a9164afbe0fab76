// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/planning/straight_line.hpp>
#include <vantage/selector/first_best.hpp>
#include <vantage/selector/route.hpp>

namespace vantage {

struct MinusCostConfig {
  double weight_per_m = 1;  ///< in the utility's unit per metre, >= 0
  double speed_m_s = 1;     ///< > 0
};

/// The best utility minus the cost of the way there (eq. 2.19), which is the router's path length L times a weight:
///
///     v* = arg max over v of psi(M, v) - weight L(v_current, v)
///
/// Candidates without a path are never chosen. With weight 0 it is ArgMax along the router's paths.
template <class Router = StraightLine>
class MinusCost {
 public:
  using RouterType = Router;
  using MapNeeds = NeedsOf<Router>;
  using Config = MinusCostConfig;
  MinusCost() = default;
  explicit MinusCost(Router r) : MinusCost(std::move(r), MinusCostConfig{}) {}
  explicit MinusCost(const MinusCostConfig& config) : MinusCost(Router{}, config) {}
  MinusCost(Router r, const MinusCostConfig& config) : router_(std::move(r)), config_(config) {
    Check check("MinusCost::Config");
    check.not_negative("weight_per_m", config.weight_per_m);
    check.positive("speed_m_s", config.speed_m_s);
    check.done();
  }
  template <Map M>
  requires RouterFor<Router, M> std::optional<Decision> select(const M& map, const Situation& q, const Candidates& c,
                                                               const Score&, Rng&)
  const {
    const std::vector<double> lengths_m = checked_lengths_m(router_, map, q.here, c.views);
    const auto best = first_best(c.views.size(), [&](std::size_t i) {
      return std::isfinite(lengths_m[i]) ? c.utilities[i] - config_.weight_per_m * lengths_m[i] : excluded;
    });
    if (!best) return std::nullopt;
    return follow_route(router_, map, q.here, c, *best, lengths_m[*best], config_.speed_m_s);
  }

 private:
  Router router_{};
  Config config_{};
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
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

struct TravelTradeoffConfig {
  double delta = 0.5;    ///< weight of travel, >= 0
  double speed_m_s = 1;  ///< > 0
};

/// A candidate's share of all utility against its share of all travel (eq. 6.11), L the router's path lengths:
///
///     v* = arg max over v_i of psi(v_i) / sum_j psi(v_j) - delta L(v_i) / sum_j L(v_j)
///
/// The sums run over the candidates that have a path; the others are never chosen. As it stands the equation turns the
/// ranking round when the sum of utilities is negative, and is 0 / 0 when it vanishes; so, if any utility is negative,
/// all are first raised by the same amount until the least is 0, and a share of nothing is 0. For utilities >= 0 with
/// any above 0 this is the equation itself.
template <class Router = StraightLine>
class TravelTradeoff {
 public:
  using RouterType = Router;
  using MapNeeds = NeedsOf<Router>;
  using Config = TravelTradeoffConfig;
  TravelTradeoff() = default;
  explicit TravelTradeoff(Router r) : TravelTradeoff(std::move(r), TravelTradeoffConfig{}) {}
  explicit TravelTradeoff(const TravelTradeoffConfig& config) : TravelTradeoff(Router{}, config) {}
  TravelTradeoff(Router r, const TravelTradeoffConfig& config) : router_(std::move(r)), config_(config) {
    Check check("TravelTradeoff::Config");
    check.not_negative("delta", config.delta);
    check.positive("speed_m_s", config.speed_m_s);
    check.done();
  }
  template <Map M>
  requires RouterFor<Router, M> std::optional<Decision> select(const M& map, const Situation& q, const Candidates& c,
                                                               const Score&, Rng&)
  const {
    const std::vector<double> lengths_m = checked_lengths_m(router_, map, q.here, c.views);
    const auto reachable = [&](std::size_t i) { return std::isfinite(lengths_m[i]); };
    double least = 0, sum_length_m = 0, sum_psi = 0;
    for (std::size_t i = 0; i < lengths_m.size(); ++i)
      if (reachable(i)) least = std::min(least, c.utilities[i]);
    for (std::size_t i = 0; i < lengths_m.size(); ++i)
      if (reachable(i)) {
        sum_psi += c.utilities[i] - least;
        sum_length_m += lengths_m[i];
      }
    const auto share = [](double part, double sum) { return sum > 0 ? part / sum : 0.0; };
    const auto best = first_best(c.views.size(), [&](std::size_t i) {
      if (!reachable(i)) return excluded;
      return share(c.utilities[i] - least, sum_psi) - config_.delta * share(lengths_m[i], sum_length_m);
    });
    if (!best) return std::nullopt;
    return follow_route(router_, map, q.here, c, *best, lengths_m[*best], config_.speed_m_s);
  }

 private:
  Router router_{};
  Config config_{};
};

}  // namespace vantage

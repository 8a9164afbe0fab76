// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/concepts/world.hpp>
#include <vantage/core/error.hpp>

// When a mission ends. The loop asks before planning and again after it, with the best utility known; the first,
// unplanned views are always measured. A rule that knows how much time is left tells the policies (Situation).
namespace vantage {

/// When the mission's clock has reached a budget: computing and travel together (section 3.2.3).
class MissionTime {
 public:
  /// Throws Error unless the budget is finite and >= 0 [s].
  explicit MissionTime(double budget_s) : budget_s_(budget_s) {
    Check check("MissionTime");
    check.not_negative("budget_s", budget_s);
    check.done();
  }
  template <Map M>
  bool operator()(const M&, const Situation& q) const {
    return q.elapsed_s >= budget_s_;
  }
  [[nodiscard]] double remaining_s(const Situation& q) const { return std::max(0.0, budget_s_ - q.elapsed_s); }

 private:
  double budget_s_;
};

/// When so many measurements have been taken, the first ones included.
class Measurements {
 public:
  explicit Measurements(std::uint64_t budget) : budget_(budget) {}
  template <Map M>
  bool operator()(const M&, const Situation& q) const {
    return q.step >= budget_;
  }

 private:
  std::uint64_t budget_;
};

/// When the robot has travelled so far.
class Travel {
 public:
  /// Throws Error unless the budget is finite and >= 0 [m].
  explicit Travel(double budget_m) : budget_m_(budget_m) {
    Check check("Travel");
    check.not_negative("budget_m", budget_m);
    check.done();
  }
  template <Map M>
  bool operator()(const M&, const Situation& q) const {
    return q.travelled_m >= budget_m_;
  }

 private:
  double budget_m_;
};

/// When such a share of the map has been seen.
class CoverageReached {
 public:
  using MapNeeds = Needs<need::Coverage>;
  /// Throws Error unless the share is in (0, 1].
  explicit CoverageReached(double share) : share_(share) {
    Check check("CoverageReached");
    check(share > 0 && share <= 1, "share", share, "in (0, 1]");
    check.done();
  }
  template <CoverageMap M>
  bool operator()(const M& map, const Situation&) const {
    return map.coverage() >= share_;
  }

 private:
  double share_;
};

/// When no candidate promises as much as `bound`: nothing is left that is worth the trip.
class UtilityBelow {
 public:
  /// Throws Error unless the bound is finite; in the utility's unit.
  explicit UtilityBelow(double bound) : bound_(bound) {
    Check check("UtilityBelow");
    check.finite("bound", bound);
    check.done();
  }
  template <Map M>
  bool operator()(const M&, const Situation& q) const {
    return q.best_utility < bound_;
  }

 private:
  double bound_;
};

/// When any of several rules holds: `AnyOf{MissionTime{300}, CoverageReached{0.95}}`.
template <class... Rules>
class AnyOf {
 public:
  using MapNeeds = NeedsOf<Rules...>;
  explicit AnyOf(Rules... rules) : rules_(std::move(rules)...) {}

  template <Map M>
  requires(StopRuleFor<Rules, M>&&...) bool operator()(const M& map, const Situation& q) const {
    return std::apply([&](const Rules&... rule) { return (static_cast<bool>(rule(map, q)) || ...); }, rules_);
  }
  /// The least that any of them leaves; infinity if none knows.
  [[nodiscard]] double remaining_s(const Situation& q) const {
    double least = std::numeric_limits<double>::infinity();
    const auto ask = [&](const auto& rule) {
      if constexpr (requires { rule.remaining_s(q); })
        least = std::min(least, static_cast<double>(rule.remaining_s(q)));
    };
    std::apply([&](const Rules&... rule) { (ask(rule), ...); }, rules_);
    return least;
  }

 private:
  std::tuple<Rules...> rules_;
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <optional>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/selector/first_best.hpp>

namespace vantage {

/// For sequences, of which the robot goes one step and plans anew (section 2.2.3): finds the best candidate, whose
/// utility is that of the whole sequence which ends there, and decides for the first view of the sequence, straight
/// from where the robot is. Candidates without parents are sequences of one view: then it is ArgMax.
class FirstOfBranch {
 public:
  struct Config {
    double speed_m_s = 1;  ///< > 0
  };
  FirstOfBranch() = default;
  explicit FirstOfBranch(const Config& config) : config_(config) {
    Check check("FirstOfBranch::Config");
    check.positive("speed_m_s", config.speed_m_s);
    check.done();
  }
  template <Map M>
  std::optional<Decision> select(const M&, const Situation& q, const Candidates& c, const Score&, Rng&) const {
    std::optional<std::size_t> at = first_best(c.views.size(), [&](std::size_t i) { return c.utilities[i]; });
    if (!at) return std::nullopt;
    while (!c.parent.empty() && c.parent[*at] >= 0) {
      const auto before = static_cast<std::size_t>(c.parent[*at]);
      if (before >= *at)
        throw Error("FirstOfBranch", concat("candidate ", *at, " comes after candidate ", before), "a lower index");
      at = before;
    }
    const double travel_m = distance_m(q.here, c.views[*at]);
    return Decision{
        .index = *at, .path = {q.here, c.views[*at]}, .travel_s = travel_m / config_.speed_m_s, .travel_m = travel_m};
  }

 private:
  Config config_{};
};

}  // namespace vantage

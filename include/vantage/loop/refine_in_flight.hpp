// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>

namespace vantage {

/// An observer of NbvLoop that trains the map on while the robot flies, so many steps for every second of the flight:
/// as many as its computer manages there. The mission's clock does not count them, since the flight takes that time
/// anyway; the number does not depend on any measured time, so that a run by the modelled clock still repeats.
class RefineInFlight {
 public:
  /// Throws Error unless finite and >= 0.
  explicit RefineInFlight(double steps_per_s) : steps_per_s_(steps_per_s) {
    Check check("RefineInFlight");
    check.not_negative("steps_per_s", steps_per_s);
    check.done();
  }
  template <RefinableMap M>
  void departed(M& map, const Decision& decision, Rng& rng) const {
    if (const int steps = static_cast<int>(std::min(1e6, std::floor(steps_per_s_ * decision.travel_s))); steps > 0)
      map.refine(steps, rng);
  }

 private:
  double steps_per_s_;
};

}  // namespace vantage

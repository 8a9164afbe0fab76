// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>

namespace vantage {

/// How much variance in the region of interest a measurement from v would take away (eq. 3.13):
///
///     psi(v) = sum over c_i in C_HS of (K-_ii - K+_ii)
///
/// The map simulates the measurement without its values, for all candidates at once. In the square of the map's unit.
/// Views already in the sequence count as measured. Throws what the map's forecast throws.
struct VarianceReduction {
  using MapNeeds = Needs<need::Forecast>;

  template <ForecastMap M>
  auto prepare(const M& map, const Situation&, Rng) const {
    return [&map](Views given, Views views, std::span<double> out) { map.forecast(given, views, out); };
  }
};

}  // namespace vantage

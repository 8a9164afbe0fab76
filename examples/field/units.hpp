// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <type_traits>

#include <vantage/geometry/scalar_field.hpp>
#include <vantage/maps/field/cell_sensor.hpp>
#include <vantage/maps/field/interest.hpp>

namespace field {

using namespace vantage;

/// A map's configuration, made for fields in [0, 1], for a field of any range: the map then speaks the field's unit,
/// and does to it exactly what the other one would do to the field scaled to [0, 1]. The prior thus knows the field's
/// range, as one does from an earlier campaign, and nothing else of it. `threshold` is in the field's unit (default:
/// scaled).
template <class Config>
Config in_unit_of(const ScalarField& truth, Config c, std::optional<double> threshold = {}) {
  const double low = truth.minimum(), unit = truth.range() > 0 ? truth.range() : 1, unit2 = unit * unit;
  const auto scaled = [&](double value) { return low + unit * value; };
  c.prior_mean = scaled(c.prior_mean);
  c.kernel.variance *= unit2;
  using Sensor = decltype(c.sensor);
  c.sensor.alpha *= std::is_same_v<typename Sensor::HeightNoiseType, VarianceGrowsWithHeight> ? unit2 : unit;
  if constexpr (requires { c.sensor.partial.beta *= unit2; }) c.sensor.partial.beta *= unit2;
  auto& interest = c.resolution.interest;
  interest.threshold = threshold.value_or(scaled(interest.threshold));
  if constexpr (std::is_same_v<decltype(interest.margin), VarianceMargin>)
    interest.margin.gamma /= unit;  // meets a variance
  if constexpr (requires { c.belief.variance_error; }) {
    c.belief.variance_error *= unit2;
    c.belief.least_noise_variance *= unit2;
  }
  return c;
}

}  // namespace field

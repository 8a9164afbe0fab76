// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

#include <vantage/maps/surfel/padded_rows.hpp>

namespace vantage {

// How much neighbouring normals differ, for pairs of pixels in rows: (x, y, z) their difference, `step_m` that of the
// rendered depths. A policy writes the penalty of each pair, and replaces the difference by the derivative of the
// penalty by it. Depths are constants.

/// Total variation of the published code of ch. 6: only where the rendered depth is continuous, and less where the
/// normals differ much, as they do at an edge:
///
///     [step^2 <= 1e-4 m^2] |dN|^2 exp(-|dN|^2 / 0.18),
///
/// differentiated as a whole, the weight as well. A pair counts once for each of its pixels that the sensor measured.
struct EdgeAwareVariation {
  static constexpr std::string_view name = "EdgeAwareVariation";
  static constexpr bool measured_only = true;

  template <class Row, class Step>
  void operator()(Row& x, Row& y, Row& z, const Step& step_m, Row& penalty, Row& factor) const {
    using T = typename Row::Scalar;
    constexpr T width = T(0.18);
    factor = step_m.square();
    mark_above<T>(factor.data(), T(1e-4), factor.size(), factor.data());
    penalty = x.square() + y.square() + z.square();
    factor = (1 - factor) * (penalty * (-1 / width)).exp();
    const auto slope = 2 * factor * (1 - penalty * (1 / width));
    x *= slope, y *= slope, z *= slope;
    penalty *= factor;
  }
};

/// Plain total variation (Rudin, Osher and Fatemi, Physica D 60, 1992; anisotropic): |dx| + |dy| + |dz|, everywhere.
struct PlainVariation {
  static constexpr std::string_view name = "PlainVariation";
  static constexpr bool measured_only = false;

  template <class Row, class Step>
  void operator()(Row& x, Row& y, Row& z, const Step&, Row& penalty, Row&) const {
    penalty = x.abs() + y.abs() + z.abs();
    for (Row* r : {&x, &y, &z}) take_sign(r->data(), r->size(), r->data());
  }
};

}  // namespace vantage

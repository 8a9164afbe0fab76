// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <string_view>

#include <vantage/core/error.hpp>
#include <vantage/maps/field/kernel.hpp>

namespace vantage {

/// Matern kernel of smoothness nu = P / Q, one of 1/2, 3/2, 5/2 (Rasmussen & Williams 2006, eq. 4.17), for fields
/// rougher than the squared exponential's: samples are 0, 1 or 2 times differentiable.
///
/// As a SeparableKernel it is the product of one-dimensional Materns over the axes, which is not the isotropic Matern
/// of the distance (for nu = 1/2: exp(-|dx| / l - |dy| / l)). Only the product has averages over cells that are
/// products of integrals over one axis. GpRegression offers both forms. Immutable; thread-safe.
template <int P, int Q>
requires((P == 1 || P == 3 || P == 5) && Q == 2) struct Matern {
  static constexpr std::string_view name = P == 1 ? "matern_1_2" : P == 3 ? "matern_3_2" : "matern_5_2";
  double variance = 1.0;   ///< sigma^2 > 0, in the field's unit squared
  double length_m = 2.36;  ///< l > 0

  void validate() const {
    Check check(name);
    check.positive("variance", variance);
    check.positive("length_m", length_m);
    check.done();
  }
  [[nodiscard]] double correlation(double d) const {
    const double s = std::sqrt(static_cast<double>(P)) * std::abs(d) / length_m;
    if constexpr (P == 1) return std::exp(-s);
    if constexpr (P == 3) return (1 + s) * std::exp(-s);
    if constexpr (P == 5) return (1 + s + s * s / 3) * std::exp(-s);
  }
  /// By numerical integration, accurate to about 1e-14; made once, when a map is initialised.
  [[nodiscard]] double average(const Interval& a, const Interval& b) const { return quadrature_average(*this, a, b); }
};

using Matern12 = Matern<1, 2>;
using Matern32 = Matern<3, 2>;
using Matern52 = Matern<5, 2>;

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>

#include <vantage/core/error.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// One measurement of a scalar field in the plane z = 0: what a sensor saw of its footprint, in the field's own unit.
/// values(row, column): rows along +y, columns along +x of the footprint; NaN = no value there (masked, invalid).
struct FieldImage {
  View view;       ///< from where it was taken
  Box2 footprint;  ///< what it covers on the ground [m]
  Image<double> values;
};

/// A downward sensor with a square field of view: from height h it sees the square of side 2 h tan(half_angle).
struct NadirSensor {
  double half_angle_rad = deg(45);  ///< in (0, pi / 2)
  int pixels = 20;                  ///< along each side, 1 to 4096

  void validate() const {
    Check check("NadirSensor");
    check(half_angle_rad > 0 && half_angle_rad < deg(90), "half_angle_rad", half_angle_rad, "in (0, pi / 2)");
    check(pixels >= 1 && pixels <= 4096, "pixels", pixels, "1 to 4096");
    check.done();
  }
  /// Ground covered from `view` [m]; yaw is ignored. Throws Error if the view is not finite, not above the ground, or
  /// does not look straight down (to 1e-6).
  [[nodiscard]] Box2 footprint(const View& view) const {
    const Eigen::Vector3d p = view.position(), down = view.forward();
    if (!p.allFinite() || !down.allFinite())
      throw Error("NadirSensor::footprint", "the view is not finite", "finite numbers");
    if (!(p.z() > 0)) throw Error("NadirSensor::footprint", concat("height ", p.z(), " m"), "above the ground (z > 0)");
    if ((down + Eigen::Vector3d::UnitZ()).norm() > 1e-6)
      throw Error("NadirSensor::footprint", "the view does not look straight down", "forward = -z");
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(p.z() * std::tan(half_angle_rad));
    return {p.head<2>() - half, p.head<2>() + half};
  }
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>

namespace vantage {

/// Light from infinitely far away; nothing casts a shadow.
struct DirectionalLight {
  Eigen::Vector3d towards;    ///< from a surface to the light, world frame; any length > 0
  Eigen::Vector3f intensity;  ///< RGB, >= 0: what a white surface that faces the light shows
};

/// Lambert's law on display-encoded colours: a surface shows colour * (ambient + sum intensity max(0, n . l)), clamped
/// to [0, 1]. Both sides of a triangle are surfaces: n is on the viewer's side.
struct Lighting {
  Eigen::Vector3f ambient = Eigen::Vector3f::Constant(0.55F);  ///< RGB, >= 0
  /// By default three, so that the sides of a box differ, and the underside is lit too.
  std::vector<DirectionalLight> lights = {{{0.4, 0.25, 0.9}, {0.33F, 0.32F, 0.29F}},
                                          {{-0.8, 0.5, 0.2}, {0.16F, 0.16F, 0.17F}},
                                          {{0.3, -0.6, -0.7}, {0.20F, 0.20F, 0.22F}}};

  /// Ambient 0.7 and five lights of 0.6 (above, and four around at 45 degrees), as in the simulator of ch. 4; a light
  /// is taken as irradiance, of which a white surface sends 1 / pi towards the viewer.
  static Lighting object() {
    constexpr float intensity = 0.6F * std::numbers::inv_pi_v<float>;
    Lighting lighting{Eigen::Vector3f::Constant(0.7F), {}};
    for (const Eigen::Vector3d& towards :
         {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 1), Eigen::Vector3d(-1, 0, 1), Eigen::Vector3d(0, 1, 1),
          Eigen::Vector3d(0, -1, 1)})
      lighting.lights.push_back({towards, Eigen::Vector3f::Constant(intensity)});
    return lighting;
  }
  /// Textures and colours as they are.
  static Lighting none() { return {Eigen::Vector3f::Ones(), {}}; }

  void validate() const {
    Check check("Lighting");
    const auto intensity = [&](const Eigen::Vector3f& rgb, const std::string& name) {
      check((rgb.array() >= 0).all() && rgb.allFinite(), name, rgb.transpose(), "finite and >= 0");
    };
    intensity(ambient, "ambient");
    for (std::size_t i = 0; i < lights.size(); ++i) {
      intensity(lights[i].intensity, concat("lights[", i, "].intensity"));
      const double length = lights[i].towards.stableNorm();
      check(std::isfinite(length) && length > 0, concat("lights[", i, "].towards"), lights[i].towards.transpose(),
            "a direction");
    }
    check.done();
  }
  /// Factor of the colour of a surface with this unit normal.
  [[nodiscard]] Eigen::Vector3f shade(const Eigen::Vector3d& normal) const {
    Eigen::Vector3f sum = ambient;
    for (const DirectionalLight& light : lights)
      sum += light.intensity * static_cast<float>(std::max(0.0, normal.dot(light.towards.stableNormalized())));
    return sum;
  }
};

}  // namespace vantage

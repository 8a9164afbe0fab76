// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/sampler/pattern.hpp>

namespace vantage {

/// A fixed spiral down a hemisphere, looking at its centre: the baseline "Fixed Pattern" of chapter 5. Starts at the
/// top; heights divide the cap into zones of equal area, and each step in azimuth is as long as the distance between
/// the windings (the generalised spiral of Saff and Kuijlaars, "Distributing many points on a sphere", 1997).
class Spiral : public Pattern {
 public:
  struct Config {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< what to look at [m]
    double radius_m = 2;                               ///< > 0
    double max_polar_rad = deg(80);                    ///< where it ends, from straight above, in (0, pi / 2]
    int views = 10;                                    ///< 1 to 65536
    double reached = 0.25;  ///< a view is visited within this share of the spacing, in (0, 0.5)
  };
  Spiral() : Spiral(Config{}) {}
  /// Throws Error naming every bad member.
  explicit Spiral(const Config& config)
      : Pattern(turns(config), config.reached * config.radius_m * spacing_rad(config)) {}

 private:
  /// Views on a whole sphere of this density, and the angle between neighbours there.
  static double density(const Config& c) { return c.views / (0.5 * (1 - std::cos(c.max_polar_rad))); }
  static double spacing_rad(const Config& c) { return std::sqrt(4 * std::numbers::pi / density(c)); }

  static std::vector<View> turns(const Config& c) {
    Check check("Spiral::Config");
    check(c.centre.allFinite(), "centre", concat("[", c.centre.transpose(), "]"), "finite");
    check.positive("radius_m", c.radius_m);
    check(c.max_polar_rad > 0 && c.max_polar_rad <= deg(90), "max_polar_rad", c.max_polar_rad, "in (0, pi / 2]");
    check(c.views >= 1 && c.views <= 1 << 16, "views", c.views, "1 to 65536");
    check(c.reached > 0 && c.reached < 0.5, "reached", c.reached, "in (0, 0.5)");
    check.done();
    std::vector<View> views;
    double azimuth_rad = 0;
    for (int k = 0; k < c.views; ++k) {
      const double cos_polar = 1 - (1 - std::cos(c.max_polar_rad)) * k / std::max(1, c.views - 1);
      const double sin_polar = std::sqrt(std::max(0.0, 1 - cos_polar * cos_polar));
      if (k > 0) azimuth_rad += spacing_rad(c) / sin_polar;
      const Eigen::Vector3d direction(sin_polar * std::cos(azimuth_rad), sin_polar * std::sin(azimuth_rad), cos_polar);
      views.push_back(look_at(c.centre + c.radius_m * direction, c.centre));
    }
    return views;
  }
};

}  // namespace vantage

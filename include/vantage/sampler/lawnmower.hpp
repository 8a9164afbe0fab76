// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/sampler/pattern.hpp>

namespace vantage {

/// Views straight down that cover an area leg by leg, to and fro along x: the measurements of section 3.2.1 and 3.2.2.
/// The outermost footprints end at the edges; in between they overlap by `overlap` at least, evenly.
class Lawnmower : public Pattern {
 public:
  enum class Corner { min_x_min_y, max_x_min_y, min_x_max_y, max_x_max_y };
  struct Config {
    Box2 area;                        ///< to be covered [m]
    double height_m = 2.5;            ///< > 0
    double half_angle_rad = deg(45);  ///< of the sensor, in (0, pi / 2): footprints are 2 height tan(half angle) wide
    double overlap = 0;               ///< share of a footprint that its neighbour sees too, in [0, 1)
    Corner start = Corner::min_x_min_y;
    double reached = 0.25;  ///< a view is visited within this share of the distance to the next, in (0, 0.5)
  };
  /// Throws Error naming every bad member, and for more than a million views.
  explicit Lawnmower(const Config& config) : Lawnmower(config, Axis(config, 0), Axis(config, 1)) {}

 private:
  struct Axis {
    double low, step;
    std::size_t count;
    Axis(const Config& c, int axis) {
      if (axis == 0) validate(c);
      const double footprint = 2 * c.height_m * std::tan(c.half_angle_rad);
      const double length = c.area.sizes()[axis], rest = length - footprint;
      // 1e-9: a rest that is a whole number of steps but for rounding takes no step more.
      const double steps = rest <= 1e-9 * footprint ? 0 : std::ceil(rest / (footprint * (1 - c.overlap)) - 1e-9);
      if (!(steps < 1e6)) throw Error("Lawnmower", concat(steps, " views along one side"), "at most a million");
      count = static_cast<std::size_t>(steps) + 1;
      low = count == 1 ? c.area.center()[axis] : c.area.min()[axis] + 0.5 * footprint;
      step = count == 1 ? footprint : rest / steps;
    }
    [[nodiscard]] double at(std::size_t i) const { return low + step * static_cast<double>(i); }
  };

  Lawnmower(const Config& c, const Axis& x, const Axis& y)
      : Pattern(legs(c, x, y), c.reached * std::min(x.step, y.step)) {}

  static std::vector<View> legs(const Config& c, const Axis& x, const Axis& y) {
    if (x.count * y.count > 1'000'000)
      throw Error("Lawnmower", concat(x.count, " x ", y.count, " views"), "at most a million");
    const bool from_right = c.start == Corner::max_x_min_y || c.start == Corner::max_x_max_y;
    const bool from_top = c.start == Corner::min_x_max_y || c.start == Corner::max_x_max_y;
    std::vector<View> views;
    views.reserve(x.count * y.count);
    for (std::size_t leg = 0; leg < y.count; ++leg) {
      const double y_m = y.at(from_top ? y.count - 1 - leg : leg);
      const bool leftward = from_right != (leg % 2 == 1);
      for (std::size_t i = 0; i < x.count; ++i)
        views.push_back(nadir(x.at(leftward ? x.count - 1 - i : i), y_m, c.height_m));
    }
    return views;
  }
  static void validate(const Config& c) {
    Check check("Lawnmower::Config");
    check(c.area.min().allFinite() && c.area.max().allFinite() && !c.area.isEmpty(), "area",
          concat("[", c.area.min().transpose(), "] to [", c.area.max().transpose(), "]"),
          "finite, the minimum not above the maximum");
    check.positive("height_m", c.height_m);
    check(c.half_angle_rad > 0 && c.half_angle_rad < deg(90), "half_angle_rad", c.half_angle_rad, "in (0, pi / 2)");
    check(c.overlap >= 0 && c.overlap < 1, "overlap", c.overlap, "in [0, 1)");
    check(c.reached > 0 && c.reached < 0.5, "reached", c.reached, "in (0, 0.5)");
    check.done();
  }
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// One layer of a lattice: nx times ny views straight down, evenly spread over `bounds`, its edges included (a single
/// one lies in the middle).
struct Layer {
  double height_m = 0;  ///< > 0
  Box2 bounds;          ///< of the positions [m]
  int nx = 1, ny = 1;   ///< 1 to 4096

  /// A layer whose outermost footprints end at the edges of `area`: a sensor of this half angle looks at nothing else.
  static Layer inside(const Box2& area, double height_m, int nx, int ny, double half_angle_rad = deg(45)) {
    const Eigen::Vector2d inset = Eigen::Vector2d::Constant(height_m * std::tan(half_angle_rad));
    return {height_m, Box2(area.min() + inset, area.max() - inset), nx, ny};
  }
};

/// All views of a 3-D lattice above a field, layer by layer: the discrete action space of section 3.2.3.
class Lattice {
 public:
  struct Config {
    std::vector<Layer> layers;
    bool leave_out_current = true;  ///< a candidate at the robot's position (to 1e-9 m) is no candidate
  };

  /// 300 views at 2 m and 5 m above a field of 20 m x 20 m. The thesis does not say how it spreads them; here 18 x 15
  /// and 6 x 5, which keeps the two densities close to those of the published code.
  static Config thesis(const Box2& area = field_20m()) {
    return {.layers = {Layer::inside(area, 2, 18, 15), Layer::inside(area, 5, 6, 5)}};
  }
  /// The 314 views of the published code: 17 x 17 at 2 m, x and y from 2 to 18; 5 x 5 at 5 m, from 5 to 15.
  static Config reference(const Box2& area = field_20m()) {
    return {.layers = {Layer::inside(area, 2, 17, 17), Layer::inside(area, 5, 5, 5)}};
  }
  static Box2 field_20m() { return {Eigen::Vector2d(0, 0), Eigen::Vector2d(20, 20)}; }

  /// Throws Error naming every bad layer.
  explicit Lattice(const Config& config) : leave_out_current_(config.leave_out_current) {
    Check check("Lattice::Config");
    check(!config.layers.empty(), "layers", config.layers.size(), "one at least");
    for (std::size_t i = 0; i < config.layers.size(); ++i) {
      const Layer& layer = config.layers[i];
      const auto name = [&](const char* member) { return concat("layers[", i, "].", member); };
      check.positive(name("height_m"), layer.height_m);
      check(layer.nx >= 1 && layer.nx <= 4096, name("nx"), layer.nx, "1 to 4096");
      check(layer.ny >= 1 && layer.ny <= 4096, name("ny"), layer.ny, "1 to 4096");
      check(layer.bounds.min().allFinite() && layer.bounds.max().allFinite() && !layer.bounds.isEmpty(), name("bounds"),
            concat("[", layer.bounds.min().transpose(), "] to [", layer.bounds.max().transpose(), "]"),
            "finite, the minimum not above the maximum");
    }
    check.done();
    for (const Layer& layer : config.layers)
      for (int i = 0; i < layer.nx; ++i)
        for (int j = 0; j < layer.ny; ++j)
          views_.push_back(
              nadir(position(layer.bounds, 0, i, layer.nx), position(layer.bounds, 1, j, layer.ny), layer.height_m));
  }

  template <Map M>
  Candidates sample(const M&, const Situation& q, const Score&, Rng&) const {
    Candidates c;
    c.views.reserve(views_.size());
    for (const View& v : views_)
      if (!(leave_out_current_ && same_place(v, q.here))) c.views.push_back(v);
    return c;
  }
  /// All of them, the current one included.
  [[nodiscard]] const std::vector<View>& views() const { return views_; }

 private:
  static double position(const Box2& bounds, int axis, int i, int n) {
    const double low = bounds.min()[axis], high = bounds.max()[axis];
    return n == 1 ? 0.5 * (low + high) : low + (high - low) * i / (n - 1);
  }
  std::vector<View> views_;
  bool leave_out_current_;
};

}  // namespace vantage

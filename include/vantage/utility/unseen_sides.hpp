// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/concepts/sides.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/utility/once_per_view.hpp>

namespace vantage {

/// How many sides of things a view would show that were not seen yet, by any measurement or by the views that its
/// sequence begins with:
///
///     psi(v) = | unseen sides in v  minus  those in the views before |
///
/// What is unknown has sides as well, so that frontiers count, and surfaces that were seen from elsewhere count less
/// the more they were looked at: it goes on where Unexplored has nothing left to count. An integer >= 0. Cost: the
/// map's unseen_sides of each view, and of each that sequences begin with.
class UnseenSides {
 public:
  using MapNeeds = Needs<need::Sides>;

  struct Config {
    Camera camera = Camera::from_fov(64, 64, deg(60));
    double far_m = 5;  ///< range of the sensor, camera z; finite and > 0
  };

  UnseenSides() : UnseenSides(Config()) {}
  /// Throws Error naming every bad member.
  explicit UnseenSides(const Config& config) : config_(config) {
    config.camera.validate();
    Check check("UnseenSides::Config");
    check.positive("far_m", config.far_m);
    check.done();
  }

  template <SideMap M>
  auto prepare(const M& map, const Situation&, Rng) const {
    using Sides = std::vector<std::uint64_t>;
    const auto sides = [&map, c = config_](const View& view) { return map.unseen_sides(view, c.camera, c.far_m); };
    return [sides, once = std::make_shared<OncePerView<Sides>>()](Views given, Views views, std::span<double> out) {
      const auto before = (*once)(given, sides);
      parallel_for(views.size(), [&](std::size_t i) {
        const Sides shown = sides(views[i]);
        out[i] = static_cast<double>(std::ranges::count_if(shown, [&](std::uint64_t side) {
          return std::ranges::none_of(before, [&](const auto& b) { return std::ranges::binary_search(*b, side); });
        }));
      });
    };
  }
  [[nodiscard]] const Config& config() const { return config_; }

 private:
  Config config_;
};

}  // namespace vantage

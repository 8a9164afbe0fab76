// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/look_around.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/sampler/view_cone.hpp>

namespace vantage {

/// Everything around a few places: the centres of navigable voxels, drawn anywhere within a radius, and last where the
/// robot stands (look_all_around, from a random heading at each). To turn costs no way: a robot that weighs what it
/// would see against the way there looks around as long as that pays, and then goes on. Never empty. Costs some dozen
/// looks at voxels, or one at the blocks within the radius where few are navigable.
class AllAround {
 public:
  using MapNeeds = Needs<need::Navigable>;
  struct Config {
    int places = 5;                                             ///< 1 to 1024, that of the robot included
    double radius_m = std::numeric_limits<double>::infinity();  ///< around the robot, > 0
    double field_of_view_rad = deg(60);                         ///< of the camera, in (0, pi]
  };
  AllAround() : AllAround(Config{}) {}
  /// Throws Error naming every bad member.
  explicit AllAround(const Config& config) : config_(config) {
    Check check("AllAround::Config");
    check(config.places >= 1 && config.places <= 1024, "places", config.places, "1 to 1024");
    check(config.radius_m > 0, "radius_m", config.radius_m, "> 0");
    check(config.field_of_view_rad > 0 && config.field_of_view_rad <= std::numbers::pi, "field_of_view_rad",
          config.field_of_view_rad, "in (0, pi]");
    check.done();
  }

  template <NavigableMap M>
  Candidates sample(const M& map, const Situation& q, const Score&, Rng& rng) const {
    const Region around{q.here.position(), Eigen::Vector3d::UnitZ()};
    const ViewCone ball{.nearest_m = 0, .farthest_m = config_.radius_m, .min_cosine = -1};
    std::vector<Eigen::Vector3i> places;
    draw_in_cone(map, around, ball, static_cast<std::size_t>(config_.places - 1), rng, places);
    Candidates c;
    const auto add = [&](const Eigen::Vector3d& eye) {
      const double heading_rad = rng.uniform(0, 2 * std::numbers::pi);
      const View start = look_at(eye, eye + Eigen::Vector3d(std::cos(heading_rad), std::sin(heading_rad), 0));
      for (const View& view : look_all_around(start, config_.field_of_view_rad)) c.views.push_back(view);
    };
    for (const Eigen::Vector3i& voxel : places) add(map.grid().centre(voxel));
    add(q.here.position());
    return c;
  }

 private:
  Config config_;
};

}  // namespace vantage

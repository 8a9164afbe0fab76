// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/sampler/view_cone.hpp>

namespace vantage {

/// Random views around the robot (section 6.1.5, and its ablation without regions of interest): from the centres of
/// navigable voxels within a radius, in all directions alike, without roll. The last is from where the robot stands,
/// so that one that cannot go anywhere yet looks around; with no such voxel, all are. Costs one look at the blocks
/// within the radius.
class Local {
 public:
  using MapNeeds = Needs<need::Navigable>;
  struct Config {
    double radius_m = 0.5;  ///< > 0
    int candidates = 100;   ///< 1 to 1048576
  };
  Local() : Local(Config{}) {}
  /// Throws Error naming every bad member.
  explicit Local(const Config& config) : config_(config) {
    Check check("Local::Config");
    check.positive("radius_m", config.radius_m);
    check(config.candidates >= 1 && config.candidates <= 1 << 20, "candidates", config.candidates, "1 to 1048576");
    check.done();
  }

  template <NavigableMap M>
  Candidates sample(const M& map, const Situation& q, const Score&, Rng& rng) const {
    Candidates c;
    draw(map, q, static_cast<std::size_t>(config_.candidates), rng, c.views);
    return c;
  }
  /// Adds `n` such views to `views`.
  template <NavigableMap M>
  void draw(const M& map, const Situation& q, std::size_t n, Rng& rng, std::vector<View>& views) const {
    const Region around{q.here.position(), Eigen::Vector3d::UnitZ()};
    const ViewCone ball{.nearest_m = 0, .farthest_m = config_.radius_m, .min_cosine = -1};
    std::vector<Eigen::Vector3d> positions;
    for_each_in_cone(map, around, ball, [&](const auto& voxel) { positions.push_back(map.grid().centre(voxel)); });
    for (std::size_t i = 0; i < n; ++i) {
      const bool stays = i + 1 == n || positions.empty();
      const Eigen::Vector3d eye = stays ? q.here.position() : positions[rng.index(positions.size())];
      views.push_back(look_at(eye, eye + direction(rng)));
    }
  }

 private:
  static Eigen::Vector3d direction(Rng& rng) {
    const double z = rng.uniform(-1, 1), azimuth_rad = rng.uniform(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(azimuth_rad), r * std::sin(azimuth_rad), z};
  }
  Config config_;
};

}  // namespace vantage

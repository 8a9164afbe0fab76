// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// Random views on a hemisphere around a scene, looking at its centre, new ones each step: the action space of chapters
/// 4 and 5. Uniform (by area) on that part of it which is no farther than `max_polar_rad` from straight above and no
/// farther than `max_turn_rad`, seen from the centre, from where the robot is (chapter 4: 60 degrees). A robot at the
/// centre may turn anywhere. Proposes nothing if the two caps do not meet.
class Hemisphere {
 public:
  struct Config {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< what to look at [m]
    double radius_m = 2;                               ///< > 0
    double max_polar_rad = deg(80);                    ///< from straight above, in (0, pi / 2]
    double max_turn_rad = std::numbers::pi;            ///< from the current view, in (0, pi]
    int candidates = 50;                               ///< 1 to 1048576
  };
  /// Section 4.2.3: 50 candidates within 60 degrees, 2 m from the centre and not lower than 0.3 m.
  static Config chapter4() { return {.max_polar_rad = std::acos(0.3 / 2.0), .max_turn_rad = deg(60)}; }

  Hemisphere() : Hemisphere(Config{}) {}
  /// Throws Error naming every bad member.
  explicit Hemisphere(const Config& config) : config_(config) {
    Check check("Hemisphere::Config");
    check(config.centre.allFinite(), "centre", concat("[", config.centre.transpose(), "]"), "finite");
    check.positive("radius_m", config.radius_m);
    check(config.max_polar_rad > 0 && config.max_polar_rad <= deg(90), "max_polar_rad", config.max_polar_rad,
          "in (0, pi / 2]");
    check(config.max_turn_rad > 0 && config.max_turn_rad <= std::numbers::pi, "max_turn_rad", config.max_turn_rad,
          "in (0, pi]");
    check(config.candidates >= 1 && config.candidates <= 1 << 20, "candidates", config.candidates, "1 to 1048576");
    check.done();
  }

  template <Map M>
  Candidates sample(const M&, const Situation& q, const Score&, Rng& rng) const {
    const Eigen::Vector3d offset = q.here.position() - config_.centre;
    const Cap top{Eigen::Vector3d::UnitZ(), config_.max_polar_rad};
    const bool at_centre = !(offset.norm() > 1e-9);
    const Cap turn = at_centre ? Cap{top.axis, std::numbers::pi} : Cap{offset.normalized(), config_.max_turn_rad};
    // Draw from the smaller cap and keep what lies in the other.
    const Cap& drawn = turn.angle_rad < top.angle_rad ? turn : top;
    const Cap& other = turn.angle_rad < top.angle_rad ? top : turn;
    Candidates c;
    const Rng streams(rng());
    for (int i = 0; i < config_.candidates; ++i)
      if (const auto direction = draw(drawn, other, streams.fork(static_cast<std::uint64_t>(i))))
        c.views.push_back(look_at(config_.centre + config_.radius_m * *direction, config_.centre));
    return c;
  }

 private:
  struct Cap {
    Eigen::Vector3d axis;
    double angle_rad;
    [[nodiscard]] bool contains(const Eigen::Vector3d& direction) const {
      return direction.dot(axis) >= std::cos(angle_rad);
    }
  };
  /// Uniform in both caps; none if a thousand draws miss.
  static std::optional<Eigen::Vector3d> draw(const Cap& drawn, const Cap& other, Rng rng) {
    const double between_rad = std::acos(std::clamp(drawn.axis.dot(other.axis), -1.0, 1.0));
    if (between_rad > drawn.angle_rad + other.angle_rad) return std::nullopt;
    const Eigen::Vector3d u = drawn.axis.unitOrthogonal(), v = drawn.axis.cross(u);
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const double cosine = rng.uniform(std::cos(drawn.angle_rad), 1),
                   sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
      const double azimuth_rad = rng.uniform(0, 2 * std::numbers::pi);
      const Eigen::Vector3d direction =
          cosine * drawn.axis + sine * (std::cos(azimuth_rad) * u + std::sin(azimuth_rad) * v);
      if (other.contains(direction)) return direction;
    }
    return std::nullopt;
  }
  Config config_;
};

}  // namespace vantage

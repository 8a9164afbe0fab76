// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/planning/heading.hpp>

namespace vantage {

struct LevelConfig {
  double max_pitch_rad = 0;  ///< how far the camera can look up or down, in [0, pi / 2]
};

/// Another sampler's views for a robot that cannot pitch its camera, or not far (section 6.2.3): from the same places,
/// in the same horizontal directions, without roll, no steeper than the limit. A view straight up or down keeps the
/// heading of its image. What the base asks of the utility is asked for the views as they become.
template <class Base>
class Level {
 public:
  using MapNeeds = NeedsOf<Base>;
  using Config = LevelConfig;
  Level() : Level(Base{}) {}
  explicit Level(Base base) : Level(std::move(base), Config{}) {}
  explicit Level(const Config& config) : Level(Base{}, config) {}
  /// Throws Error naming every bad member.
  Level(Base base, const Config& config) : base_(std::move(base)), config_(config) {
    Check check("Level::Config");
    check(config.max_pitch_rad >= 0 && config.max_pitch_rad <= deg(90), "max_pitch_rad", config.max_pitch_rad,
          "in [0, pi / 2]");
    check.done();
  }

  template <Map M>
  requires SamplerFor<Base, M> Candidates sample(const M& map, const Situation& q, const Score& score, Rng& rng) {
    const auto levelled = [&](Views given, Views views, std::span<double> out) {
      score(all_level(given), all_level(views), out);
    };
    Candidates c = base_.sample(map, q, Score(levelled), rng);
    c.views = all_level(c.views);
    return c;
  }
  void save(Sink& sink) const requires Persistent<Base> { base_.save(sink); }
  void load(Source& source) requires Persistent<Base> { base_.load(source); }

  /// The view that such a robot takes instead.
  [[nodiscard]] View level(const View& view) const {
    const Eigen::Vector3d forward = view.forward(), eye = view.position();
    const double pitch_rad =
        std::clamp(std::atan2(forward.z(), forward.head<2>().norm()), -config_.max_pitch_rad, config_.max_pitch_rad);
    return look_at(eye, eye + std::cos(pitch_rad) * heading(view) + std::sin(pitch_rad) * Eigen::Vector3d::UnitZ());
  }

 private:
  [[nodiscard]] std::vector<View> all_level(Views views) const {
    std::vector<View> all;
    all.reserve(views.size());
    for (const View& v : views) all.push_back(level(v));
    return all;
  }
  Base base_;
  Config config_;
};
template <class Base>
Level(Base) -> Level<Base>;
template <class Base>
Level(Base, LevelConfig) -> Level<Base>;

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <type_traits>

#include <vantage/loop/nbv_loop.hpp>
#include <vantage/maps/surfel/surfel_presets.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/sampler/local.hpp>
#include <vantage/sampler/roi_and_local.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/utility/confidence_exploration.hpp>
#include <vantage/utility/fisher_information.hpp>

#include "robot.hpp"
#include "surfel_maps.hpp"

namespace scene {

/// A robot that reconstructs a scene with surfels (ch. 6): its map, and which policies make which method.
struct Reconstructor : Robot {
  using Robot::Robot;

  template <class Preset, SurfelConfidence Confidence = typename SurfelPreset<Preset>::Confidence>
  [[nodiscard]] ActiveGsMap<Preset, Confidence> map() const {
    using Map = ActiveGsMap<Preset, Confidence>;
    typename Map::Config c = surfel_config<Map>(bounds);
    set(c.voxels);
    c.far_m = range_m;
    return Map(c);
  }

  /// ActiveGS itself.
  template <class Preset, SurfelConfidence Confidence = typename SurfelPreset<Preset>::Confidence>
  [[nodiscard]] auto ours() const {
    return NbvLoop{map<Preset, Confidence>(), inspect<Preset>(), RoiAndLocal<frontier, low_confidence>{}, tradeoff()};
  }
  /// fly(loop) with the loop of a method.
  template <class Preset, class F>
  void with(const std::string& method, F&& fly) const {
    if (method == "ours")
      fly(ours<Preset>());
    else if (method == "view_count")
      fly(ours<Preset, ViewCountConfidence>());
    else if (method == "without_roi")
      fly(NbvLoop{map<Preset>(), inspect<Preset>(), Local{}, tradeoff()});
    else if (method == "fisher")
      fly(NbvLoop{map<Preset>(), FisherInformation({.camera = sensor}), frontiers(), tradeoff()});
    else if (method == "fbe")
      fly(NbvLoop{map<Preset>(), unexplored(), frontiers(), tradeoff()});
    else
      fly(wander(map<Preset>(), AStar{}));
  }

 private:
  template <class Preset>
  [[nodiscard]] auto inspect() const {
    using Exploitation = std::conditional_t<std::is_same_v<Preset, preset::thesis>, LeastConfidence, UnsureSurface>;
    return ConfidenceExploration<Exploitation>({.camera = sensor, .far_m = range_m});
  }
  [[nodiscard]] TravelTradeoff<AStar> tradeoff() const { return {AStar{}, {.speed_m_s = speed_m_s}}; }
};

}  // namespace scene

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <type_traits>

#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/maps/surfel/surfel_presets.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/sampler/frontier.hpp>
#include <vantage/sampler/local.hpp>
#include <vantage/sampler/roi_and_local.hpp>
#include <vantage/selector/minus_cost.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/utility/confidence_exploration.hpp>
#include <vantage/utility/fisher_information.hpp>
#include <vantage/utility/unexplored.hpp>
#include <vantage/utility/uninformed.hpp>

#include "input.hpp"
#include "surfel_maps.hpp"

namespace scene {

using namespace vantage;

/// What the thesis' computer takes for a step (section 6.2.1).
inline constexpr ModelledClock::Config published_costs{.mapping_s = 1, .planning_s = 0.5};

/// A robot that reconstructs a scene with surfels (ch. 6): its map, and which policies make which method.
struct Reconstructor {
  Box3 bounds;         ///< to be reconstructed [m]
  double voxel_m;      ///< of the map that it flies by
  double clearance_m;  ///< around the robot's centre
  double range_m;      ///< of depth
  double speed_m_s;
  Camera sensor;  ///< as utilities render it

  template <class Preset, SurfelConfidence Confidence = typename SurfelPreset<Preset>::Confidence>
  [[nodiscard]] ActiveGsMap<Preset, Confidence> map() const {
    using Map = ActiveGsMap<Preset, Confidence>;
    typename Map::Config c = surfel_config<Map>(bounds);
    c.voxels.voxel_m = voxel_m;
    c.voxels.clearance_m = clearance_m;
    c.voxels.range = {.max_m = range_m, .no_return_m = range_m};
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
    const Frontier frontiers({.cone = {.farthest_m = 0.5 * range_m, .min_cosine = 0.25}, .smallest_m2 = 0.02});
    if (method == "ours")
      fly(ours<Preset>());
    else if (method == "view_count")
      fly(ours<Preset, ViewCountConfidence>());
    else if (method == "without_roi")
      fly(NbvLoop{map<Preset>(), inspect<Preset>(), Local{}, tradeoff()});
    else if (method == "fisher")
      fly(NbvLoop{map<Preset>(), FisherInformation({.camera = sensor}), frontiers, tradeoff()});
    else if (method == "fbe")
      fly(NbvLoop{map<Preset>(), Unexplored({.camera = sensor, .far_m = range_m}), frontiers, tradeoff()});
    else
      fly(NbvLoop{map<Preset>(), Uninformed{}, Local({.radius_m = 2}),
                  MinusCost(AStar{}, {.weight_per_m = 0, .speed_m_s = speed_m_s})});
  }

 private:
  template <class Preset>
  [[nodiscard]] auto inspect() const {
    using Exploitation = std::conditional_t<std::is_same_v<Preset, preset::thesis>, LeastConfidence, UnsureSurface>;
    return ConfidenceExploration<Exploitation>({.camera = sensor, .far_m = range_m});
  }
  [[nodiscard]] TravelTradeoff<AStar> tradeoff() const { return {AStar{}, {.speed_m_s = speed_m_s}}; }
};

inline Reconstructor reconstructor_of(const Options& o, const Input& input) {
  return {.bounds = input.bounds,
          .voxel_m = o.map_voxel(),
          .clearance_m = o.body_radius_m,
          .range_m = o.range_m,
          .speed_m_s = o.speed_m_s,
          .sensor = Camera::from_fov(128, 128, deg(o.field_of_view_deg))};
}

}  // namespace scene

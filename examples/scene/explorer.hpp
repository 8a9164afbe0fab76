// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <utility>

#include <vantage/core/units.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/planning/shortcut.hpp>
#include <vantage/sampler/frontier.hpp>
#include <vantage/sampler/local.hpp>
#include <vantage/sampler/view_tree.hpp>
#include <vantage/selector/first_of_branch.hpp>
#include <vantage/selector/minus_cost.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/utility/information_gain.hpp>
#include <vantage/utility/unexplored.hpp>
#include <vantage/utility/uninformed.hpp>

#include "input.hpp"

namespace scene {

using namespace vantage;

/// A robot that explores: its map, and which policies make which method.
struct Explorer {
  Box3 bounds;         ///< to be explored [m]
  double voxel_m;      ///< of the map
  double clearance_m;  ///< around the robot's centre
  double range_m;      ///< of depth
  double speed_m_s;
  Camera sensor;  ///< as utilities render it

  template <class Update>
  [[nodiscard]] VoxelMap<Update> map() const {
    return VoxelMap<Update>({.bounds = bounds,
                             .voxel_m = voxel_m,
                             .clearance_m = clearance_m,
                             .range = {.max_m = range_m, .no_return_m = range_m}});
  }

  /// fly(loop, stop) with the loop of a method, over a map with this update.
  template <class Update, class Stop, class F>
  void with(const std::string& method, const Stop& stop, F&& fly) const {
    const Shortcut<> route(AStar{});
    const TravelTradeoff tradeoff(route, {.speed_m_s = speed_m_s});
    const Frontier frontier({.cone = {.farthest_m = 0.5 * range_m, .min_cosine = 0.25}, .smallest_m2 = 0.02});
    const Unexplored unexplored({.camera = sensor, .far_m = range_m});
    if (method == "fbe")
      fly(NbvLoop{map<Update>(), unexplored, frontier, tradeoff}, stop);
    else if (method == "information_gain")
      fly(NbvLoop{map<Update>(), InformationGain(sensor), frontier, tradeoff}, stop);
    else if (method == "nbvp")  // a tree always proposes something
      fly(NbvLoop{map<Update>(), unexplored, ViewTree{}, FirstOfBranch({.speed_m_s = speed_m_s})},
          AnyOf{stop, UtilityBelow{1e-9}});
    else
      fly(NbvLoop{map<Update>(), Uninformed{}, Local({.radius_m = 2}),
                  MinusCost(route, {.weight_per_m = 0, .speed_m_s = speed_m_s})},
          stop);
  }
};

inline Explorer explorer_of(const Options& o, const Input& input) {
  return {.bounds = input.bounds,
          .voxel_m = o.map_voxel(),
          .clearance_m = o.body_radius_m,
          .range_m = o.range_m,
          .speed_m_s = o.speed_m_s,
          .sensor = Camera::from_fov(128, 128, deg(o.field_of_view_deg))};
}

}  // namespace scene

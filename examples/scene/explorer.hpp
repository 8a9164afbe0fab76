// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include <vantage/loop/stop_rules.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/planning/shortcut.hpp>
#include <vantage/sampler/view_tree.hpp>
#include <vantage/selector/first_of_branch.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/utility/information_gain.hpp>

#include "robot.hpp"

namespace scene {

/// A robot that explores: its map, and which policies make which method.
struct Explorer : Robot {
  using Robot::Robot;

  template <class Update>
  [[nodiscard]] VoxelMap<Update> map() const {
    typename VoxelMap<Update>::Config c;
    set(c);
    return VoxelMap<Update>(c);
  }

  /// fly(loop, stop) with the loop of a method, over a map with this update.
  template <class Update, class Stop, class F>
  void with(const std::string& method, const Stop& stop, F&& fly) const {
    const Shortcut<> route(AStar{});
    const TravelTradeoff tradeoff(route, {.speed_m_s = speed_m_s});
    if (method == "fbe")
      fly(NbvLoop{map<Update>(), unexplored(), frontiers(), tradeoff}, stop);
    else if (method == "information_gain")
      fly(NbvLoop{map<Update>(), InformationGain(sensor), frontiers(), tradeoff}, stop);
    else if (method == "nbvp")  // a tree always proposes something
      fly(NbvLoop{map<Update>(), unexplored(), ViewTree{}, FirstOfBranch({.speed_m_s = speed_m_s})},
          AnyOf{stop, UtilityBelow{1e-9}});
    else
      fly(wander(map<Update>(), route), stop);
  }
};

}  // namespace scene

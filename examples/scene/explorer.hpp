// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include <vantage/loop/stop_rules.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>
#include <vantage/maps/voxel/with_sides.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/planning/shortcut.hpp>
#include <vantage/sampler/all_around.hpp>
#include <vantage/sampler/fallback.hpp>
#include <vantage/sampler/view_tree.hpp>
#include <vantage/selector/first_of_branch.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/utility/information_gain.hpp>
#include <vantage/utility/unseen_sides.hpp>

#include "robot.hpp"

namespace scene {

/// A robot that explores: its map, and which policies make which method.
struct Explorer : Robot {
  using Robot::Robot;

  /// Of a camera of 64 x 64 pixels: a view that shows less is not worth it.
  static constexpr double fewest_sides = 50;

  template <class M>
  [[nodiscard]] M map() const {
    typename M::Config c;
    set(c);
    return M(c);
  }
  /// Frontiers; when none shows as much, all around from here and from anywhere.
  [[nodiscard]] Fallback<Frontier, AllAround> frontiers_or_around() const {
    return {frontiers(), AllAround({.field_of_view_rad = field_of_view_rad}), {.least = fewest_sides}};
  }
  [[nodiscard]] UnseenSides unseen_sides() const {
    return UnseenSides({.camera = Camera::from_fov(64, 64, field_of_view_rad), .far_m = range_m});
  }

  /// fly(loop, stop) with the loop of a method, over a map with this update.
  template <class Update, class Stop, class F>
  void with(const std::string& method, const Stop& stop, F&& fly) const {
    using Voxels = VoxelMap<Update>;
    const Shortcut<> route(AStar{});
    const AnyOf until_seen{stop, UtilityBelow{fewest_sides}};
    if (method == "fbe")
      fly(NbvLoop{map<WithSides<Voxels>>(), unseen_sides(), frontiers_or_around(),
                  TravelTradeoff(route, {.delta = 3, .speed_m_s = speed_m_s})},
          until_seen);
    else if (method == "nbvp")
      fly(NbvLoop{map<WithSides<Voxels>>(), unseen_sides(), ViewTree{}, FirstOfBranch({.speed_m_s = speed_m_s})},
          until_seen);
    else if (method == "information_gain")
      fly(NbvLoop{map<Voxels>(), InformationGain(sensor), frontiers(), TravelTradeoff(route, {.speed_m_s = speed_m_s})},
          stop);
    else
      fly(wander(map<Voxels>(), route), stop);
  }
};

}  // namespace scene

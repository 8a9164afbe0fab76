// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <utility>
#include <vector>

#include <vantage/geometry/look_around.hpp>
#include <vantage/io/octomap_bt.hpp>
#include <vantage/loop/stop_rules.hpp>

#include "explore_results.hpp"
#include "explorer.hpp"
#include "fly.hpp"
#include "missions.hpp"

namespace scene {

/// A robot explores a scene that it does not know: it maps voxels with this update, and flies where they are free.
template <class Update>
Mission explore(const Options& o, const Input& input, std::ostream& log) {
  Mission mission;
  const std::vector<View> first = look_all_around(input.start, deg(o.field_of_view_deg));
  Explorer(o, input).with<Update>(o.method, o.stop_rule(), [&](auto loop, const auto& stop) {
    Flown flown = fly(o, input, log, loop, first, stop);
    write_bt(o.out / "map.bt", loop.map);
    write_exploration(o, input, flown.referee, flown.album, flown.record);
    mission = {.record = std::move(flown.record)};
  });
  return mission;
}

// Compiled apart, in explore_thesis.cpp and explore_reference.cpp.
extern template Mission explore<RayCast>(const Options&, const Input&, std::ostream&);
extern template Mission explore<Projective>(const Options&, const Input&, std::ostream&);

}  // namespace scene

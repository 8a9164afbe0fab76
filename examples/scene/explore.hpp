// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <unistd.h>

#include <iostream>

#include <vantage/io/octomap_bt.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/mission/progress.hpp>
#include <vantage/mission/recorder.hpp>
#include <vantage/sim/rgbd_world.hpp>

#include "explore_results.hpp"
#include "explorer.hpp"
#include "first_views.hpp"
#include "missions.hpp"
#include "referee.hpp"

namespace scene {

/// A robot explores a scene that it does not know: it maps voxels with this update, and flies where they are free.
template <class Update>
void explore(const Options& o, const Input& input) {
  RgbdWorld world(*input.scene, Rng(o.seed).fork(1), o.sensor());
  const std::vector<View> first = look_all_around(input.start, deg(o.field_of_view_deg));
  explorer_of(o, input).with<Update>(o.method, o.stop_rule(), [&](auto loop, const auto& stop) {
    Referee referee(input, o);
    MissionClock clock(o.clock);
    Recorder recorder(
        RecorderConfig{.file = o.out / "mission.json", .config = config(o, input), .seed = o.seed, .with_prior = false},
        [&](const auto& map) { return referee.metrics(map); });
    Album album(o.out / "views", o.range_m);
    Progress progress(recorder.record(), std::cerr,
                      {.budget_s = o.most_time_s(),
                       .budget_steps = o.measurements,
                       .terminal_fd = STDERR_FILENO,
                       .utf8 = locale_is_utf8()});
    loop.run(world, input.start, first, stop, clock, Rng(o.seed), referee, recorder, album, progress);
    write_bt(o.out / "map.bt", loop.map);
    write_exploration(o, input, referee, album, recorder.record());
  });
}

// Compiled apart, in explore_thesis.cpp and explore_reference.cpp.
extern template void explore<RayCast>(const Options&, const Input&);
extern template void explore<Projective>(const Options&, const Input&);

}  // namespace scene

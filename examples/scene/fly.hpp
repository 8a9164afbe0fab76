// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <ostream>
#include <vector>

#include <vantage/loop/mission_state.hpp>
#include <vantage/loop/refine_in_flight.hpp>
#include <vantage/loop/skip_refused.hpp>
#include <vantage/mission/checkpoint.hpp>
#include <vantage/mission/progress.hpp>
#include <vantage/mission/recorder.hpp>
#include <vantage/sim/rgbd_world.hpp>

#include "album.hpp"
#include "missions.hpp"
#include "referee.hpp"

namespace scene {

/// What a flight leaves, besides what the robot learned.
struct Flown {
  Referee referee;
  Album album;
  MissionRecord record = {};
};

/// Flies through a scene until the stop rule holds, and keeps all on disk, so that --resume goes on from there.
/// `judges` are further Persistent observers with metrics. Pictures and what is fused of them is not kept: the world
/// shows the same again.
template <class Loop, class Stop, class... Judges>
Flown fly(const Options& o, const Input& input, std::ostream& log, Loop& loop, Views first, const Stop& stop,
          Judges&... judges) {
  RgbdWorld world(*input.scene, Rng(o.seed).fork(1), o.sensor());
  Flown flown{.referee = Referee(input, o),
              .album = Album(o.keep_views ? o.out / "views" : "", o.range_m, input.scene->classes)};
  MissionClock clock(o.clock, o.costs());
  MissionState state{.here = input.start, .rng = Rng(o.seed)};
  Recorder recorder(
      RecorderConfig{.file = o.out / "mission.json", .config = config(o, input), .seed = o.seed, .with_prior = false},
      [&](const auto& map) {
        std::vector<Metric> all = flown.referee.metrics(map);
        (std::ranges::move(judges.metrics(map), std::back_inserter(all)), ...);
        return all;
      });
  SkipRefused skip(log);
  Checkpoint checkpoint(CheckpointConfig{.file = o.out / "mission.checkpoint", .most_share = 0.03}, recorder,
                        flown.referee, skip, judges...);
  Progress progress(recorder.record(), log,
                    {.budget_s = o.most_time_s(),
                     .budget_steps = o.measurements,
                     .terminal_fd = STDERR_FILENO,
                     .utf8 = locale_is_utf8()});

  if (o.resume && checkpoint.load(loop, world, clock, state)) {
    log << "resumed after step " << state.visited.size() << '\n';
    RgbdWorld again = world;
    for (std::size_t i = 0; i < state.visited.size(); ++i) {
      const Frame frame = *again.observe(state.visited[i]);
      if (std::ranges::find(skip.steps(), i + 1) != skip.steps().end()) continue;
      flown.referee.saw(i + 1, frame);
      flown.album.saw(i + 1, frame);
    }
  }
  first = first.first(std::min<std::size_t>(first.size(), o.measurements));
  RefineInFlight refine{o.refine_per_s};
  loop.resume(world, state, first, stop, clock, refine, skip, flown.referee, judges..., recorder, flown.album, progress,
              checkpoint);
  flown.record = recorder.record();
  return flown;
}

}  // namespace scene

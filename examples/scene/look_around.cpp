// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// A camera looks around: in a home, at objects, or through a recording. What it sees is written as pictures and fused
// into a mesh, and compared with the truth. The views are chosen without a map.
#include <unistd.h>

#include <iostream>
#include <optional>
#include <utility>

#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/mission/progress.hpp>
#include <vantage/mission/recorder.hpp>
#include <vantage/sampler/pool.hpp>
#include <vantage/selector/arg_max.hpp>
#include <vantage/selector/in_order.hpp>
#include <vantage/sim/replay_world.hpp>
#include <vantage/sim/rgbd_world.hpp>
#include <vantage/utility/uninformed.hpp>
#include <vantage/utility/view_distance.hpp>

#include "missions.hpp"
#include "results.hpp"

namespace scene {

namespace {

template <class World, class Utility, class Selector>
void fly(const Options& o, const Input& input, World& world, Utility utility, Selector selector) {
  std::optional<SurfaceCoverage> truth;
  if (input.surface.size() != 0) truth.emplace(input.surface);
  const bool colour = !input.recording || !input.recording->frames().front().colour.empty();
  NbvLoop loop{FusedMap({.bounds = input.bounds, .voxel_m = o.voxel_m, .truncation_m = 5 * o.voxel_m, .colour = colour},
                        std::move(truth)),
               std::move(utility), Pool(input.views), std::move(selector)};

  MissionClock clock(o.clock);
  Recorder recorder(
      RecorderConfig{.file = o.out / "mission.json", .config = config(o, input), .seed = o.seed, .with_prior = false},
      Judge{input, o.threshold_m});
  Album album(o.out / "views", o.range_m);
  Progress progress(
      recorder.record(), std::cerr,
      {.budget_s = o.budget_s, .budget_steps = o.measurements, .terminal_fd = STDERR_FILENO, .utf8 = locale_is_utf8()});
  loop.run(world, input.start, Views(&input.start, 1), o.stop_rule(), clock, Rng(o.seed), recorder, album, progress);
  write_results(o, input, loop.map, album, recorder.record());
}

template <class World>
void choose(const Options& o, const Input& input, World&& world) {
  if (o.method == "max_view_distance")
    fly(o, input, world, ViewDistance<Nearest>{}, ArgMax{});
  else if (o.method == "random")
    fly(o, input, world, Uninformed{}, ArgMax{});
  else
    fly(o, input, world, Uninformed{}, InOrder{});
}

}  // namespace

void look_around(const Options& o, const Input& input) {
  if (input.recording)
    choose(o, input,
           ReplayWorld(input.views, [&](std::size_t i) { return within(input.recording->frame(i), o.range_m); }));
  else
    choose(o, input, RgbdWorld(*input.scene, Rng(o.seed).fork(1), o.sensor()));
}

}  // namespace scene

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// A camera looks around: in a home, at objects, or through a recording. What it sees is written as pictures and fused
// into a mesh, and compared with the truth. The views are chosen without a map.
#include <unistd.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

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
Mission fly(const Options& o, const Input& input, std::ostream& log, World& world, Utility utility, Selector selector) {
  std::optional<SeenSurface> truth;
  if (input.scene) truth = input.unseen(o);
  const bool colour = !input.recording || !input.recording->frames().front().colour.empty();
  NbvLoop loop{FusedMap(around(input.bounds, o.voxel_m, colour), std::move(truth)), std::move(utility),
               Pool(input.views), std::move(selector)};

  MissionClock clock(o.clock, o.costs());
  Recorder recorder(
      RecorderConfig{.file = o.out / "mission.json", .config = config(o, input), .seed = o.seed, .with_prior = false},
      Judge{input, o.threshold_m});
  // What is replayed is kept already, perhaps in this very folder.
  Album album(o.keep_views && input.scene ? o.out / "views" : "", o.range_m,
              input.scene ? input.scene->classes : std::vector<std::string>());
  Progress progress(recorder.record(), log,
                    {.budget_s = o.budget_s,
                     .budget_steps = o.most_measurements().value_or(o.measurements),
                     .terminal_fd = STDERR_FILENO,
                     .utf8 = locale_is_utf8()});
  loop.run(world, input.start, Views(&input.start, 1), o.stop_rule(), clock, Rng(o.seed), recorder, album, progress);
  write_results(o, input, loop.map, album, recorder.record());
  return {.record = recorder.record()};
}

template <class World>
Mission choose(const Options& o, const Input& input, std::ostream& log, World&& world) {
  if (o.method == "max_view_distance") return fly(o, input, log, world, ViewDistance<Nearest>{}, ArgMax{});
  if (o.method == "random") return fly(o, input, log, world, Uninformed{}, ArgMax{});
  return fly(o, input, log, world, Uninformed{}, InOrder{});
}

}  // namespace

Mission look_around(const Options& o, const Input& input, std::ostream& log) {
  if (input.recording)
    return choose(o, input, log, ReplayWorld(input.views, [&](std::size_t i) {
                    return within(input.recording->frame(i), o.range_m);
                  }));
  return choose(o, input, log, RgbdWorld(*input.scene, Rng(o.seed).fork(1), o.sensor()));
}

}  // namespace scene

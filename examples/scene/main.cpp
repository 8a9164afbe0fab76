// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// A camera looks around: in a home, at objects, or through a recording. What it sees is written as pictures and fused
// into a mesh, and compared with the truth. No learned map yet: the views are chosen without one.
#include <unistd.h>

#include <iostream>
#include <optional>
#include <utility>

#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/mission/progress.hpp>
#include <vantage/mission/recorder.hpp>
#include <vantage/sampler/pool.hpp>
#include <vantage/selector/arg_max.hpp>
#include <vantage/selector/in_order.hpp>
#include <vantage/sim/replay_world.hpp>
#include <vantage/sim/rgbd_world.hpp>
#include <vantage/utility/uninformed.hpp>
#include <vantage/utility/view_distance.hpp>

#include "results.hpp"

namespace scene {

/// All that determines the mission, besides the seed.
nlohmann::ordered_json config(const Options& o, const Input& input) {
  const auto budget = [](double x) { return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(); };
  nlohmann::ordered_json c = {{"mission", "scene"}, {"input", input.name}, {"method", o.method}};
  c["clock"] = vantage::name_of(o.clock);
  if (!input.recording) {
    c["camera_px"] = o.pixels;
    c["field_of_view_deg"] = o.field_of_view_deg;
    c["depth_noise"] = o.depth_noise;
    c["body_radius_m"] = o.body_radius_m;
  }
  c["range_m"] = o.range_m;
  c["candidates"] = input.views.size();
  c["voxel_m"] = o.voxel_m;
  c["threshold_m"] = o.threshold_m;
  c["budget_s"] = budget(o.budget_s);
  c["budget_travel_m"] = budget(o.travel_m);
  c["budget_measurements"] = o.measurements;
  return c;
}

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
  const auto finite = [](double x) { return std::min(x, std::numeric_limits<double>::max()); };
  loop.run(world, input.start, Views(&input.start, 1),
           AnyOf{MissionTime{finite(o.budget_s)}, Measurements{o.measurements}, Travel{finite(o.travel_m)}}, clock,
           Rng(o.seed), recorder, album, progress);
  write_results(o, input, loop.map, album, recorder.record());
  std::cout << (o.out / "report.html").string() << '\n';
}

template <class World>
void look_around(const Options& o, const Input& input, World&& world) {
  if (o.method == "max_view_distance")
    fly(o, input, world, ViewDistance<Nearest>{}, ArgMax{});
  else if (o.method == "random")
    fly(o, input, world, Uninformed{}, ArgMax{});
  else
    fly(o, input, world, Uninformed{}, InOrder{});
}

void run(const Options& o) {
  validate(o);
  make_folder(o.out);
  const Input input = load(o);
  std::cerr << input.name << ". " << input.note << '\n';
  if (input.recording)
    look_around(o, input,
                ReplayWorld(input.views, [&](std::size_t i) { return within(input.recording->frame(i), o.range_m); }));
  else
    look_around(o, input,
                RgbdWorld(*input.scene, Rng(o.seed).fork(1),
                          {.camera = o.camera(), .depth_noise = o.depth_noise, .max_depth_m = o.range_m}));
}

}  // namespace scene

int main(int argc, char** argv) {
  CLI::App app("A camera looks around in a scene, and reconstructs it.", "scene");
  scene::Options options;
  options.command.assign(argv, argv + argc);
  scene::add_options(app, options);
  return vantage::run_program(app, argc, argv, std::cout, std::cerr,
                              [&] { vantage::with_threads(options.threads, [&] { scene::run(options); }); });
}

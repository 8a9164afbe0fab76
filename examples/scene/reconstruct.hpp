// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <unistd.h>

#include <iostream>
#include <vector>

#include <vantage/io/splat_ply.hpp>
#include <vantage/loop/refine_in_flight.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/mission/progress.hpp>
#include <vantage/mission/recorder.hpp>
#include <vantage/sim/rgbd_world.hpp>

#include "first_views.hpp"
#include "missions.hpp"
#include "reconstruct_results.hpp"
#include "reconstructor.hpp"
#include "referee.hpp"
#include "surfel_judge.hpp"

namespace scene {

/// A robot reconstructs a scene that it does not know with surfels: it trains them on every frame, and flies where its
/// voxels are free.
template <class Preset>
void reconstruct(const Options& o, const Input& input) {
  RgbdWorld world(*input.scene, Rng(o.seed).fork(1), o.sensor());
  reconstructor_of(o, input).with<Preset>(o.method, [&](auto loop) {
    Referee referee(input, o);
    SurfelJudge judge(input, o);
    MissionClock clock(o.clock, published_costs);
    Recorder recorder(
        RecorderConfig{.file = o.out / "mission.json", .config = config(o, input), .seed = o.seed, .with_prior = false},
        [&](const auto& map) {
          std::vector<Metric> all = referee.metrics(map);
          for (Metric& m : judge.metrics(map)) all.push_back(std::move(m));
          return all;
        });
    Album album(o.out / "views", o.range_m);
    Progress progress(recorder.record(), std::cerr,
                      {.budget_s = o.most_time_s(),
                       .budget_steps = o.measurements,
                       .terminal_fd = STDERR_FILENO,
                       .utf8 = locale_is_utf8()});
    loop.run(world, input.start, turn_around(input.start, deg(o.field_of_view_deg)), o.stop_rule(), clock, Rng(o.seed),
             RefineInFlight{o.refine_per_s}, referee, judge, recorder, album, progress);

    Reconstruction result{.scores = judge.scores(), .mesh = surface_of(loop.map, input.bounds, o.voxel_m)};
    result.scores.push_back(judge.judge(loop.map, recorder.record().steps.back().elapsed_s));
    for (std::size_t k = 0; k < 4; ++k)
      result.comparisons.push_back(judge.compare(loop.map, (2 * k + 1) * judge.test_views() / 8));
    write_splat_ply(o.out / "splats.ply", loop.map.surfels());
    write_surfel_ply(o.out / "surfels.ply", loop.map.surfels());
    write_reconstruction(o, input, referee, result, album, recorder.record());
  });
}

// Compiled apart, in reconstruct_thesis.cpp and reconstruct_reference.cpp.
extern template void reconstruct<preset::thesis>(const Options&, const Input&);
extern template void reconstruct<preset::reference>(const Options&, const Input&);

}  // namespace scene

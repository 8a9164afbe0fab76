// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <utility>
#include <vector>

#include <vantage/geometry/look_around.hpp>
#include <vantage/io/splat_ply.hpp>
#include <vantage/loop/stop_rules.hpp>

#include "fly.hpp"
#include "missions.hpp"
#include "reconstruct_results.hpp"
#include "reconstructor.hpp"
#include "surfel_judge.hpp"

namespace scene {

/// A robot reconstructs a scene that it does not know with surfels: it trains them on every frame, and flies where its
/// voxels are free.
template <class Preset>
Mission reconstruct(const Options& o, const Input& input, std::ostream& log) {
  Mission mission;
  const std::vector<View> first = turn_around(input.start, deg(o.field_of_view_deg));
  Reconstructor(o, input).with<Preset>(o.method, [&](auto loop) {
    SurfelJudge judge(input, o);
    Flown flown = fly(o, input, log, loop, first, o.stop_rule(), judge);

    Reconstruction result{.scores = judge.scores(),
                          .test_views = judge.test_views(),
                          .mesh = surface_of(loop.map, input.bounds, o.voxel_m)};
    result.scores.push_back(judge.judge(loop.map, flown.record.steps.back().elapsed_s));
    for (std::size_t k = 0; k < 4; ++k)
      result.comparisons.push_back(judge.compare(loop.map, (2 * k + 1) * judge.test_views() / 8));
    write_splat_ply(o.out / "splats.ply", loop.map.surfels());
    write_surfel_ply(o.out / "surfels.ply", loop.map.surfels());
    write_reconstruction(o, input, flown.referee, result, flown.album, flown.record);
    mission = {.record = std::move(flown.record), .scores = std::move(result.scores)};
  });
  return mission;
}

// Compiled apart, in reconstruct_thesis.cpp and reconstruct_reference.cpp.
extern template Mission reconstruct<preset::thesis>(const Options&, const Input&, std::ostream&);
extern template Mission reconstruct<preset::reference>(const Options&, const Input&, std::ostream&);

}  // namespace scene

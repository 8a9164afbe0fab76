// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The planning step of ActiveGS on about 300 k surfels of a furnished room, of which half was seen: 100 candidates at
// regions of interest and around the robot, for each a rendering of depth and confidence in 128 x 128 px and the
// unexplored voxels in sight, and the search for the ways to all. Items are candidates.
#include <cstddef>
#include <cstdint>

#include "kernels/surfel_frames.hpp"
#include "peak.hpp"

#include <vantage/loop/nbv_loop.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/sampler/roi_and_local.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/utility/confidence_exploration.hpp>

namespace {

using namespace vantage;

void planning_step(benchmark::State& state, int frames) {
  NbvLoop loop{bench::map_after(frames), ConfidenceExploration<>{}, RoiAndLocal<frontier, low_confidence>{},
               TravelTradeoff{AStar{}}};
  const Situation here{.here = bench::surfel_frame(loop.map.surfels(), 0, 10).view};
  std::size_t candidates = 0;
  for (auto _ : state) {
    Rng rng(1);
    const auto plan = loop.plan(here, rng);
    if (!plan) return state.SkipWithError("nowhere to go");
    candidates = plan->candidates;
  }
  state.counters["surfels"] = static_cast<double>(loop.map.surfels().size());
  state.counters["regions"] =
      static_cast<double>(loop.map.regions(frontier{}).size() + loop.map.regions(low_confidence{}).size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(candidates));
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RegisterBenchmark("surfel/planning_step/300k", [](benchmark::State& s) { planning_step(s, 8); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

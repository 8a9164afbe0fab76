// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// 100 candidates of the samplers of voxel maps in a half explored apartment, the map's list of regions at hand.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <vector>

#include "kernels/apartment_input.hpp"

#include <vantage/planning/reachable_voxels.hpp>
#include <vantage/sampler/frontier.hpp>
#include <vantage/sampler/local.hpp>
#include <vantage/sampler/roi_and_local.hpp>

namespace {

using namespace vantage;

/// Made once: navigable voxels and frontiers take seconds at 5 cm.
const bench::Apartment& apartment(double edge_m) {
  static std::map<double, bench::Apartment> made;
  return made.try_emplace(edge_m, edge_m).first->second;
}
const View here = look_at({1.5, 1.5, 1.2}, {3, 1.5, 1.2});

// Items are candidates; `visited` measurements lie behind.
template <class Sampler>
void sampler(benchmark::State& state, double edge_m, const Sampler& sampler, std::size_t visited) {
  const bench::Apartment& map = apartment(edge_m);
  const auto scorer = [](Views, Views, std::span<double>) {};
  Rng rng(1);
  std::vector<View> history;
  while (history.size() < visited)
    for (const View& v : sampler.sample(map, {.here = here}, Score(scorer), rng).views) history.push_back(v);
  history.resize(visited);
  std::size_t views = 0;
  for (auto _ : state) {
    const Candidates c = sampler.sample(map, {.here = here, .visited = history}, Score(scorer), rng);
    views += c.views.size();
    benchmark::DoNotOptimize(c.views.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(views));
  state.counters["candidates"] = static_cast<double>(views) / static_cast<double>(state.iterations());
  state.counters["frontier_voxels"] = static_cast<double>(map.regions(frontier{}).size());
}

// Items are voxels reached.
void reachable(benchmark::State& state, double edge_m) {
  const bench::Apartment& map = apartment(edge_m);
  const Eigen::Vector3i start = map.grid().voxel_at(here.position());
  for (auto _ : state) {
    const ReachableVoxels found(Passable(map, start), start);
    benchmark::DoNotOptimize(found.in(block_of(start)));
  }
  const ReachableVoxels found(Passable(map, start), start);
  int voxels = 0;
  for (const Eigen::Vector3i& block : map.known_blocks()) voxels += found.in(block).count();
  state.SetItemsProcessed(state.iterations() * voxels);
}

BENCHMARK_CAPTURE(sampler, f20, 0.2, Frontier{}, 0)->Name("sampler/frontier/20cm")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(sampler, f5, 0.05, Frontier{}, 0)->Name("sampler/frontier/5cm")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(sampler, g5, 0.05, Frontier({.most_looks = 1000}), 300)
    ->Name("sampler/frontier_after_300_views/5cm")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(sampler, r20, 0.2, RoiAndLocal<frontier>{}, 0)
    ->Name("sampler/roi_and_local/20cm")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(sampler, r5, 0.05, RoiAndLocal<frontier>{}, 0)
    ->Name("sampler/roi_and_local/5cm")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(sampler, l20, 0.2, Local{}, 0)->Name("sampler/local/20cm")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(sampler, l5, 0.05, Local{}, 0)->Name("sampler/local/5cm")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(reachable, r20, 0.2)->Name("planning/reachable/20cm")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(reachable, r5, 0.05)->Name("planning/reachable/5cm")->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();

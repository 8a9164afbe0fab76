// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// One planning step: the variance that each of 314 candidate views would take from the region of interest (eq. 3.13).
#include "kernels/field_input.hpp"
#include "peak.hpp"

#include <vantage/maps/field/latent.hpp>

namespace {

using namespace vantage;

std::vector<View> lattice() {
  std::vector<View> views;
  for (int y = 2; y <= 18; ++y)
    for (int x = 2; x <= 18; ++x) views.push_back(nadir(x, y, 2));
  for (double y = 5; y <= 15; y += 2.5)
    for (double x = 5; x <= 15; x += 2.5) views.push_back(nadir(x, y, 5));
  return views;
}

// On the prior, with mean 0.7, every cell is of interest: the most work that a step can be.
template <class Gp>
void candidates(benchmark::State& state, int depth) {
  typename Gp::Config c = bench::config<Gp>(depth);
  c.prior_mean = 0.7;
  const Gp map(c);
  const std::vector<View> views = lattice();
  std::vector<double> reduction(views.size());
  for (auto _ : state) {
    map.forecast({}, views, reduction);
    benchmark::DoNotOptimize(reduction.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(views.size()));
}

using Sensor = CellSensor<DeviationGrowsWithHeight, SkipPartial>;
using Dense = IntegralGp<SquaredExponential, CellAverage, Full<>, Merging<>, Sensor>;
using LowRank = IntegralGp<SquaredExponential, CellAverage, Latent<>, Merging<>, Sensor>;

constexpr auto full = candidates<Dense>, latent = candidates<LowRank>;

BENCHMARK_CAPTURE(full, 32, 5)->Name("field/candidates/32")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(latent, 32, 5)->Name("field/candidates_latent/32")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(latent, 128, 7)->Name("field/candidates_latent/128")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

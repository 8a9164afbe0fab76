// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Whole mapping missions of section 3.2.1: the prior, 16 updates, merging, and mean and variance of every cell after
// each.
#include "kernels/field_input.hpp"
#include "peak.hpp"

#include <vantage/maps/field/latent.hpp>

namespace {

using namespace vantage;

// Useful flops of the dense filter, the symmetric half counted once: 16 (n^2 l + n l^2 + l^3 / 3), n cells, l = n / 16.
double dense_flops(int depth) {
  const double n = std::pow(4.0, depth), l = n / 16;
  return 16 * (n * n * l + n * l * l + l * l * l / 3);
}

template <class Gp>
void mission(benchmark::State& state, int depth) {
  bench::images();
  std::size_t cells = 0, bytes = 0;
  for (auto _ : state) {
    const Gp map = bench::flown<Gp>(depth);
    cells = map.size();
    bytes = map.bytes();
    benchmark::DoNotOptimize(map.mean(0) + map.variance(cells - 1));
  }
  state.SetItemsProcessed(state.iterations() * 16);
  state.counters["cells"] = static_cast<double>(cells);
  state.counters["bytes"] = static_cast<double>(bytes);
  if constexpr (requires(Gp gp) { gp.belief().rank(); })
    state.counters["rank"] = static_cast<double>(Gp(bench::config<Gp>(depth)).belief().rank());
}

using Dense = IntegralGp<SquaredExponential, CellCentre, Full<>, Fixed<>, bench::Sensor>;
using Adaptive = IntegralGp<SquaredExponential, CellAverage, Full<>, Merging<>, bench::Sensor>;
using LowRank = IntegralGp<SquaredExponential, CellAverage, Latent<>, Merging<>, bench::Sensor>;
using LowRankFixed = IntegralGp<SquaredExponential, CellAverage, Latent<>, Fixed<>, bench::Sensor>;

void dense(benchmark::State& state, int depth) {
  mission<Dense>(state, depth);
  bench::count_flops(state, dense_flops(depth));
}

constexpr auto merging = mission<Adaptive>, latent = mission<LowRank>, latent_fixed = mission<LowRankFixed>;

BENCHMARK_CAPTURE(dense, 32, 5)->Name("field/mission_dense/32")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(merging, 32, 5)->Name("field/mission_merging/32")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(dense, 64, 6)->Name("field/mission_dense/64")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(merging, 64, 6)->Name("field/mission_merging/64")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(latent, 64, 6)->Name("field/mission_latent/64")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(latent_fixed, 64, 6)
    ->Name("field/mission_latent_fixed/64")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(latent_fixed, 256, 8)->Name("field/mission_latent/256")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

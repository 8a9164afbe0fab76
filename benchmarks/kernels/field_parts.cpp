// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The parts of a mapping mission: the prior's rows, one update, one merging.
#include "kernels/field_input.hpp"
#include "peak.hpp"

namespace {

using namespace vantage;
using Dense = IntegralGp<SquaredExponential, CellAverage, Full<>, Fixed<>, bench::Sensor>;
using Adaptive = IntegralGp<SquaredExponential, CellAverage, Full<>, Merging<>, bench::Sensor>;

// Rows of the prior covariance: n (n + 1) / 2 entries of the Kronecker product.
void kernel_rows(benchmark::State& state, int depth) {
  std::size_t n = 0;
  for (auto _ : state) {
    const Dense map(bench::config<Dense>(depth));
    n = map.size();
    benchmark::DoNotOptimize(map.variance(0));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n * (n + 1) / 2));
}

// One update of l = n / 16 cells, n^2 l + n l^2 + l^3 / 3 flops (eqs. 3.6, 3.7).
void fuse(benchmark::State& state, int depth) {
  Dense map(bench::config<Dense>(depth));
  Rng rng;
  std::size_t k = 0;
  for (auto _ : state) map.integrate(bench::images()[k++ % 16], rng);
  const double n = std::pow(4.0, depth), l = n / 16;
  state.SetItemsProcessed(state.iterations());
  bench::count_flops(state, n * n * l + n * l * l + l * l * l / 3);
}

// M K M^T (eqs. 3.9, 3.10) of what the first image lets merge: items are entries of the lower triangle read.
void merge(benchmark::State& state, int depth) {
  const Dense before = bench::flown<Dense>(depth, 4);
  Merge plan;
  const bool any = Merging<>{}.plan(before.tree(), before.belief(), plan);
  if (!any) throw Error("field/merge", "nothing to merge", "a field with dull parts");
  for (auto _ : state) {
    state.PauseTiming();
    Full<> belief = before.belief();
    state.ResumeTiming();
    belief.merge(before.tree(), plan);
    benchmark::DoNotOptimize(belief.variance(0));
  }
  state.counters["merged_to"] = static_cast<double>(plan.groups.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(before.size() * (before.size() + 1) / 2));
}

BENCHMARK_CAPTURE(kernel_rows, 64, 6)->Name("field/kernel_rows/64")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(fuse, 64, 6)->Name("field/fuse/64")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(merge, 64, 6)->Name("field/merge/64")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

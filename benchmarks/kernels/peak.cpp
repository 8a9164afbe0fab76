// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The yardsticks: matrix products on all threads (the faster of Eigen's kernels and OpenBLAS), and a memory triad.
#include "peak.hpp"

namespace {

template <class T>
void gemm(benchmark::State& state) {
  double best = 0;
  for (auto _ : state) best = std::max(best, bench::gemm_flops<T>());
  state.counters["gflops"] = best * 1e-9;
  state.SetItemsProcessed(state.iterations());
}
void stream(benchmark::State& state) {
  double best = 0;
  for (auto _ : state) best = std::max(best, bench::stream_bytes());
  state.counters["gbytes_per_second"] = best * 1e-9;
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(gemm<float>)->Name("peak/gemm_f32")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gemm<double>)->Name("peak/gemm_f64")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(stream)->Name("peak/stream")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Plain GP regression (eqs. 2.5 to 2.8): fit n points, then mean and variance at n others.
#include <cmath>

#include <vantage/core/rng.hpp>
#include <vantage/maps/field/regression.hpp>

#include "peak.hpp"

namespace {

using namespace vantage;

Points points(Rng rng, Eigen::Index n) {
  Points p(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) p.row(i) << rng.uniform(0, 100), rng.uniform(0, 100);
  return p;
}

// Useful flops: n^3 / 3 for the factor, n^2 m for L^-1 K(X, X*).
void regression(benchmark::State& state, Eigen::Index n) {
  const Points x = points(Rng(1), n), queries = points(Rng(2), n);
  const Eigen::VectorXd y = (0.1 * x.col(0).array()).sin() * (0.07 * x.col(1).array()).cos();
  for (auto _ : state) {
    const GpRegression<> gp({.kernel = {1, 5}, .noise_variance = 0.01}, x, y);
    const Prediction p = gp.predict(queries);
    benchmark::DoNotOptimize(p.variance.sum());
  }
  const auto size = static_cast<double>(n);
  state.SetItemsProcessed(state.iterations() * n);
  bench::count_flops(state, size * size * size * (1.0 / 3 + 1));
}
BENCHMARK_CAPTURE(regression, 1024, 1024)->Name("field/regression/1024")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(regression, 4096, 4096)->Name("field/regression/4096")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

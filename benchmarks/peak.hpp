// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

#include <vantage/core/dense.hpp>
#include <vantage/core/error.hpp>
#ifdef VANTAGE_HAS_OPENBLAS
#include <cblas.h>
#endif

// The yardsticks of every kernel: what this machine's threads reach together on C = A B, n = 2048, in the same run.
namespace bench {

inline double seconds(auto&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Flop/s of one matrix product on all threads: the faster of Eigen's kernels on tiles and OpenBLAS.
template <class T>
double gemm_flops() {
  constexpr Eigen::Index n = 2048;
  const vantage::dense::Matrix<T> a = vantage::dense::Matrix<T>::Random(n, n),
                                  b = vantage::dense::Matrix<T>::Random(n, n);
  vantage::dense::Matrix<T> c(n, n), reference(n, n);
  const double eigen_s = seconds([&] {
    vantage::dense::for_tiles(
        n, [&](Eigen::Index j, Eigen::Index nj) { reference.middleCols(j, nj).noalias() = a * b.middleCols(j, nj); });
  });
  double best_s = eigen_s;
#ifdef VANTAGE_HAS_OPENBLAS
  const auto size = static_cast<blasint>(n);
  const double blas_s = seconds([&] {
    if constexpr (std::is_same_v<T, float>)
      cblas_sgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, size, size, size, 1, a.data(), size, b.data(), size, 0,
                  c.data(), size);
    else
      cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, size, size, size, 1, a.data(), size, b.data(), size, 0,
                  c.data(), size);
  });
  if (!c.isApprox(reference, 1e3 * std::numeric_limits<T>::epsilon()))
    throw vantage::Error("peak/gemm", "OpenBLAS computed a wrong product",
                         "one that this processor computes right (OPENBLAS_CORETYPE)");
  best_s = std::min(best_s, blas_s);
#endif
  const double size_d = static_cast<double>(n);
  return 2 * size_d * size_d * size_d / best_s;
}

/// The best of several, measured once a process.
template <class T>
double peak_flops() {
  static const double peak = [] {
    double best = 0;
    for (int i = 0; i < 5; ++i) best = std::max(best, gemm_flops<T>());
    return best;
  }();
  return peak;
}

/// Bytes/s of a triad a = b + s c over arrays far larger than the caches: 3 x 8 bytes a step.
inline double stream_bytes() {
  static Eigen::VectorXd a, b, c;
  constexpr Eigen::Index n = 1 << 24;
  if (a.size() == 0) {
    a.setZero(n);
    b.setOnes(n);
    c.setOnes(n);
  }
  const double s = seconds([&] {
    vantage::dense::for_tiles(
        n, [&](Eigen::Index i, Eigen::Index k) { a.segment(i, k).noalias() = b.segment(i, k) + 3.0 * c.segment(i, k); },
        1 << 16);
  });
  return 24.0 * static_cast<double>(n) / s;
}

/// Reports useful flops of one iteration as gflops and as a share of the double-precision peak.
inline void count_flops(benchmark::State& state, double flops) {
  state.counters["gflops"] = benchmark::Counter(flops * 1e-9, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["peak_share"] =
      benchmark::Counter(flops / peak_flops<double>(), benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace bench

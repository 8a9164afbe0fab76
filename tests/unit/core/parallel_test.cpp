// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <vector>

#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>

namespace vantage {
namespace {

template <class F>
auto with_threads(int n, F&& f) {
  const tbb::global_control most(tbb::global_control::max_allowed_parallelism, 8);
  tbb::task_arena arena(n);
  return arena.execute(f);
}

TEST(Parallel, ForVisitsEachOnce) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
    std::vector<std::atomic<int>> visits(n);
    with_threads(8, [&] { parallel_for(n, [&](std::size_t i) { ++visits[i]; }); });
    for (const auto& v : visits) EXPECT_EQ(v, 1);
  }
}

TEST(Parallel, BlocksCoverWithoutOverlap) {
  for (const std::size_t n : {0u, 1u, 99u, 100u, 101u}) {
    std::vector<std::atomic<int>> visits(n);
    parallel_for_blocks(n, 10, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(begin % 10, 0u);
      EXPECT_TRUE(begin < end && end <= begin + 10 && end <= n);
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& v : visits) EXPECT_EQ(v, 1);
  }
}

TEST(Parallel, SumsToTheSameBitsWithAnyNumberOfThreads) {
  Rng rng(1);
  std::vector<double> x(12345);
  for (double& v : x) v = rng.normal() * std::pow(10.0, rng.uniform(-8, 8));
  const auto sum = [&] {
    return parallel_sum(x.size(), 64, 0.0, [&](std::size_t begin, std::size_t end) {
      double s = 0;
      for (std::size_t i = begin; i < end; ++i) s += x[i];
      return s;
    });
  };
  const double one = with_threads(1, sum);
  for (int repeat = 0; repeat < 5; ++repeat) {
    EXPECT_EQ(one, with_threads(2, sum));
    EXPECT_EQ(one, with_threads(8, sum));
  }
  double plain = 0;
  for (const double v : x) plain += v;
  EXPECT_NEAR(one, plain, 1e-6 * std::abs(plain) + 1e-6);
  EXPECT_EQ(parallel_sum(0, 64, 3.0, [](std::size_t, std::size_t) { return 1.0; }), 3.0);
}

TEST(Parallel, ExceptionsComeOut) {
  EXPECT_THROW(parallel_for(100,
                            [](std::size_t i) {
                              if (i == 50) throw std::runtime_error("i");
                            }),
               std::runtime_error);
}

}  // namespace
}  // namespace vantage

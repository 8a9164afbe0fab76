// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

// The caller owns the oneTBB arena; nothing here sets a number of threads. Work is cut into blocks of a fixed size, so
// that no result depends on how many threads there are.
namespace vantage {

namespace detail {

/// Never inlined: in each of its copies, one a place where oneTBB calls it from, the compiler might contract
/// multiply-adds in another way, and which copy runs depends on the number of threads.
template <class F>
[[gnu::noinline]] void for_each_in(const tbb::blocked_range<std::size_t>& range, F& f) {
  for (std::size_t i = range.begin(); i != range.end(); ++i) f(i);
}

}  // namespace detail

/// f(i) for i in [0, n), concurrently. f must not depend on the order.
template <class F>
void parallel_for(std::size_t n, F&& f) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 1),
                    [&](const tbb::blocked_range<std::size_t>& range) { detail::for_each_in(range, f); });
}

/// f(begin, end) for consecutive blocks of `block` items that cover [0, n), concurrently.
template <class F>
void parallel_for_blocks(std::size_t n, std::size_t block, F&& f) {
  parallel_for((n + block - 1) / block, [&](std::size_t b) { f(b * block, std::min(n, (b + 1) * block)); });
}

/// Sum of f(begin, end) over fixed blocks, added in block order: the same bits with any number of threads.
template <class T, class F>
T parallel_sum(std::size_t n, std::size_t block, T zero, F&& f) {
  std::vector<T> partial((n + block - 1) / block, zero);
  parallel_for_blocks(n, block, [&](std::size_t begin, std::size_t end) { partial[begin / block] = f(begin, end); });
  T sum = zero;
  for (const T& p : partial) sum += p;
  return sum;
}

}  // namespace vantage

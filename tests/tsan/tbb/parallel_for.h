// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <tbb/blocked_range.h>

#include <array>
#include <exception>
#include <thread>

// Stands in for oneTBB's header in the preset `tsan`. Debian's libtbb is not instrumented: ThreadSanitizer sees neither how
// it hands a task to a thread nor how it waits, and reports every task as a race. These plain threads it understands, and
// nothing orders one against another, so that a race between two pieces shows wherever they run.
namespace tbb {

template <class T, class Body>
void parallel_for(const blocked_range<T>& range, const Body& body) {
  constexpr T threads = 4;
  std::array<std::exception_ptr, threads> errors;
  std::array<std::thread, threads> pool;
  for (T t = 0; t < threads; ++t)
    pool[t] = std::thread([&, t] {
      try {
        const T step = range.grainsize();
        for (T begin = range.begin() + t * step; begin < range.end(); begin += threads * step)
          body(blocked_range<T>(begin, begin + step < range.end() ? begin + step : range.end(), step));
      } catch (...) {
        errors[t] = std::current_exception();
      }
    });
  for (std::thread& thread : pool) thread.join();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace tbb

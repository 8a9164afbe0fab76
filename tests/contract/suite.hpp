// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <utility>

#include "lists.hpp"

namespace vantage::test {

/// A list of models as the types of a test suite: TYPED_TEST_SUITE(MapContract, Suite<Maps>).
template <class L>
using Suite = typename Into<testing::Types, L>::type;
/// The same for those of a list of maps that offer what is needed.
template <class L, class Need>
using SuiteOf = Suite<typename Offering<L, Need>::type>;

/// f() with so many threads, whatever the machine has.
template <class F>
auto with_threads(int n, F&& f) {
  const tbb::global_control most(tbb::global_control::max_allowed_parallelism, 8);
  tbb::task_arena arena(n);
  return arena.execute(std::forward<F>(f));
}

}  // namespace vantage::test

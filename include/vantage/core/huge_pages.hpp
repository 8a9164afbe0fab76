// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace vantage {

/// Reserves room for n items in an empty vector and asks for huge pages there: touching fresh memory page by page costs
/// more than filling it. A hint that changes no result.
template <class T>
void reserve_huge(std::vector<T>& items, std::size_t n) {
  items.reserve(n);
#ifdef __linux__
  constexpr std::size_t page = std::size_t{1} << 12;
  const auto begin = (reinterpret_cast<std::size_t>(items.data()) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::size_t>(items.data()) + n * sizeof(T)) / page * page;
  if (end > begin && end - begin >= std::size_t{1} << 21)
    madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace vantage

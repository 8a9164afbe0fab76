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
  constexpr std::size_t page = std::size_t{1} << 12, huge_page = std::size_t{1} << 21;
  auto* begin = reinterpret_cast<std::byte*>(items.data());
  const std::size_t skip = (page - reinterpret_cast<std::size_t>(begin) % page) % page, bytes = n * sizeof(T);
  if (bytes >= huge_page + page) madvise(begin + skip, (bytes - skip) / page * page, MADV_HUGEPAGE);
#endif
}

}  // namespace vantage

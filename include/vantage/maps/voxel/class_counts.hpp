// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace vantage {

/// A voxel map that keeps no classes; labels of frames are not read.
struct NoClasses {
  static constexpr std::string_view name = "NoClasses";
  static constexpr std::size_t classes = 0;
  struct Block {};
};

/// How many pixels of each class 1 to Classes - 1 were seen in each voxel; class 0 = unknown is not counted. 4 Classes
/// bytes a voxel. The probability of a class is the mean of a Dirichlet posterior (Gan et al., "Bayesian spatial kernel
/// smoothing for scalable dense semantic mapping", RA-L 5(2), 2020, without the kernel).
template <std::size_t Classes>
struct ClassCounts {
  static_assert(Classes >= 2 && Classes <= 65536);
  static constexpr std::string_view name = "ClassCounts";
  static constexpr std::size_t classes = Classes;

  struct Block {
    std::array<std::uint32_t, 512 * Classes> counts{};
    [[nodiscard]] std::span<const std::uint32_t, Classes> of(std::size_t local) const {
      return std::span<const std::uint32_t, Classes>(counts.data() + local * Classes, Classes);
    }
    /// May run concurrently; sums do not depend on the order.
    void add(std::size_t local, std::size_t label) {
      std::atomic_ref<std::uint32_t>(counts[local * Classes + label]).fetch_add(1, std::memory_order_relaxed);
    }
    /// Halves the counts of a voxel that come near the end of their type: proportions stay.
    void settle() {
      for (std::size_t local = 0; local < 512; ++local) {
        const auto first = counts.begin() + static_cast<std::ptrdiff_t>(local * Classes);
        if (*std::max_element(first, first + Classes) >> 30 == 0) continue;
        std::for_each_n(first, Classes, [](std::uint32_t& n) { n /= 2; });
      }
    }
  };
};

}  // namespace vantage

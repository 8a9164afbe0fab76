// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string_view>

#include <vantage/core/error.hpp>

namespace vantage {

/// A voxel map that keeps no classes; labels of frames are not read.
struct NoClasses {
  static constexpr std::string_view name = "NoClasses";
  static constexpr std::size_t classes = 0;
  struct Block {};
  struct Mixture {  ///< of nothing
    explicit Mixture(const auto&) {}
  };
  void validate() const {}
};

/// How many pixels of each class 1 to Classes - 1 were seen in each voxel; class 0 = unknown is not counted. 4 Classes
/// bytes a voxel. The probability that a voxel is of class c is the mean of a Dirichlet posterior with a symmetric
/// prior (Gan et al., "Bayesian spatial kernel smoothing for scalable dense semantic mapping", RA-L 5(2), 2020, without
/// the kernel), n_c being its pixels of class c:
///
///     p(c) = (n_c + prior) / (sum_k n_k + Classes prior)
///
/// Class 0 has a part in the prior: where no class was seen all are as likely, and of equals the first is unknown.
template <std::size_t Classes>
struct ClassCounts {
  static_assert(Classes >= 2 && Classes <= 65536);
  static constexpr std::string_view name = "ClassCounts";
  static constexpr std::size_t classes = Classes;

  double prior = 1.0 / Classes;  ///< pixels that each class has to begin with, 1e-6 to 1e6; by default one in all

  struct Block {
    std::array<std::uint32_t, 512 * Classes> counts{};
    [[nodiscard]] std::span<const std::uint32_t, Classes> of(std::size_t local) const {
      return std::span<const std::uint32_t, Classes>(counts.data() + local * Classes, Classes);
    }
    /// Pixels of all classes.
    [[nodiscard]] std::uint64_t total(std::size_t local) const {
      const auto n = of(local);
      return std::accumulate(n.begin(), n.end(), std::uint64_t{0});
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

  void validate() const {
    Check check("ClassCounts");
    check(prior >= 1e-6 && prior <= 1e6, "prior", prior, "1e-6 to 1e6");
    check.done();
  }
  /// Of a class in a voxel of a block; null: of one that nothing is known of.
  [[nodiscard]] double probability(const Block* block, std::size_t local, std::size_t label) const {
    const double seen = block ? block->of(local)[label] : 0, all = block ? static_cast<double>(block->total(local)) : 0;
    return (seen + prior) / (all + Classes * prior);
  }

  /// The classes of several voxels, each with a weight: sum_i w_i p_i(c).
  class Mixture {
   public:
    explicit Mixture(const ClassCounts& semantics) : prior_(static_cast<float>(semantics.prior)) {}
    /// A voxel, as in probability(). O(Classes).
    void add(float weight, const Block* block, std::size_t local) {
      const std::uint64_t all = block ? block->total(local) : 0;
      const float a_pixel = weight / (static_cast<float>(all) + Classes * prior_);
      of_prior_ += a_pixel * prior_;
      if (all == 0) return;
      const auto seen = block->of(local);
      for (std::size_t c = 0; c < Classes; ++c) of_pixels_[c] += a_pixel * static_cast<float>(seen[c]);
    }
    [[nodiscard]] float operator[](std::size_t label) const { return of_pixels_[label] + of_prior_; }

   private:
    std::array<float, Classes> of_pixels_{};
    float prior_, of_prior_ = 0;
  };
};

}  // namespace vantage

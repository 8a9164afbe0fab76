// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/maps/surfel/surfel_normal.hpp>
#include <vantage/maps/surfel/surfels.hpp>

namespace vantage {

/// Which surfels are given up, and when (section 6.1.2).
struct PruneConfig {
  int every_frames = 5;        ///< >= 1
  double least_weight = 0.03;  ///< a surfel stays if its weight is above this in a measured pixel of some frame, >= 0
  double least_opacity = 0.1;  ///< and its opacity is at least this, [0, 1)

  void validate() const {
    Check check("PruneConfig");
    check(every_frames >= 1, "every_frames", every_frames, ">= 1");
    check.not_negative("least_weight", least_weight);
    check(least_opacity >= 0 && least_opacity < 1, "least_opacity", least_opacity, "in [0, 1)");
    check.done();
  }
};

/// Removes the surfels whose largest weight or opacity is too low (or no number), and their `numbers` of state each;
/// the others keep their order. Returns how many are gone. O(surfels), nothing is allocated.
inline std::size_t prune(Surfels& surfels, std::vector<float>& state, std::size_t numbers,
                         std::span<const float> weight, const PruneConfig& config) {
  std::size_t kept = 0;
  const std::size_t n = surfels.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!(weight[i] > static_cast<float>(config.least_weight)) ||
        !(opacity_of(surfels, i) >= static_cast<float>(config.least_opacity)))
      continue;
    if (kept != i) {
      for (auto& values : surfels.parameter) values[kept] = values[i];
      surfels.confidence[kept] = surfels.confidence[i];
      std::copy_n(state.data() + i * numbers, numbers, state.data() + kept * numbers);
    }
    ++kept;
  }
  for (auto& values : surfels.parameter) values.resize(kept);
  surfels.confidence.resize(kept);
  state.resize(kept * numbers);
  return n - kept;
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vantage {

/// Probability and entropy of a voxel by its log-odds, looked up: p to 4e-6 and H = -p ln p - (1 - p) ln(1 - p) [nats]
/// to 1e-5, exact where nothing is known (log-odds 0). Log-odds beyond +-16 count as these. 16 kB.
class OccupancyTable {
 public:
  struct Voxel {
    float probability, entropy;
  };
  OccupancyTable() {
    for (std::size_t i = 0; i < size; ++i) {
      const double l = static_cast<double>(i) / per_unit - reach, odds = std::exp(-std::abs(l));
      const double less_likely = odds / (1 + odds);
      table_[i] = {static_cast<float>(l > 0 ? 1 - less_likely : less_likely),
                   static_cast<float>(std::log1p(odds) + std::abs(l) * less_likely)};
    }
  }
  /// The one that all share; it never changes.
  static const OccupancyTable& shared() {
    static const OccupancyTable table;
    return table;
  }
  [[nodiscard]] Voxel operator()(float log_odds) const {
    const float at = (std::clamp<float>(log_odds, -reach, reach) + reach) * per_unit;
    const std::size_t i = std::min(static_cast<std::size_t>(static_cast<int>(at)), size - 2);
    const float part = at - static_cast<float>(static_cast<int>(i));
    const Voxel &a = table_[i], &b = table_[i + 1];
    return {a.probability + part * (b.probability - a.probability), a.entropy + part * (b.entropy - a.entropy)};
  }

 private:
  static constexpr int reach = 16, per_unit = 64;
  static constexpr std::size_t size = 2 * reach * per_unit + 1;
  std::array<Voxel, size> table_;
};

}  // namespace vantage

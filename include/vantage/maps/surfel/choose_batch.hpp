// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>

namespace vantage {

struct BatchConfig {
  int newest = 3;        ///< frames that are in every batch, >= 1
  int earlier = 5;       ///< drawn from the others, without replacement, >= 0
  bool by_error = true;  ///< with a probability that is proportional to their last error; else uniform

  void validate() const {
    Check check("BatchConfig");
    check(newest >= 1 && newest <= 1000, "newest", newest, "1 to 1000");
    check(earlier >= 0 && earlier <= 1000, "earlier", earlier, "0 to 1000");
    check.done();
  }
};

/// Which of `errors.size()` frames, oldest first, to train on: the newest, then those drawn from the earlier ones.
/// Errors are finite and >= 0; where all that are left are 0, they are drawn alike. O(frames * earlier).
inline std::vector<std::size_t> choose_batch(const std::vector<double>& errors, const BatchConfig& config, Rng& rng) {
  std::vector<std::size_t> batch, left(errors.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  for (int k = 0; k < config.newest && !left.empty(); ++k) {
    batch.push_back(left.back());
    left.pop_back();
  }
  for (int k = 0; k < config.earlier && !left.empty(); ++k) {
    double sum = 0;
    for (const std::size_t i : left) sum += errors[i];
    std::size_t at = 0;
    if (config.by_error && sum > 0) {
      double rest = rng.uniform() * sum;
      while (at + 1 < left.size() && (rest -= errors[left[at]]) >= 0) ++at;
    } else {
      at = static_cast<std::size_t>(rng.index(left.size()));
    }
    batch.push_back(left[at]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return batch;
}

}  // namespace vantage

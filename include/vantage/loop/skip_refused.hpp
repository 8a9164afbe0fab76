// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <ostream>

#include <vantage/core/error.hpp>
#include <vantage/loop/nbv_loop.hpp>

namespace vantage {

struct SkipRefusedConfig {
  int most_in_a_row = 5;  ///< >= 0; one more, and the mission ends: a broken sensor does not mend
};

/// Observer with which a mission goes on after a measurement that its map refuses: a pose that is not finite, a frame
/// of another size, a map that would outgrow its memory. The map is as it was, the view counts as visited. Says so on
/// `log`; throws the map's Error when too many are refused one after the other, or already the first of all.
class SkipRefused {
 public:
  explicit SkipRefused(std::ostream& log, const SkipRefusedConfig& config = {}) : log_(log), config_(config) {
    Check check("SkipRefusedConfig");
    check(config.most_in_a_row >= 0, "most_in_a_row", config.most_in_a_row, "at least 0");
    check.done();
  }

  template <class M>
  void refused(const M&, const Situation& q, const Error& error) {
    if (++in_a_row_ > config_.most_in_a_row || q.step == 1) throw error;
    ++total_;
    log_ << "view " << q.step << " refused: " << error.what() << '\n';
  }
  template <class M, class Z>
  void measured(const M&, const Situation&, const Step<Z>&) {
    in_a_row_ = 0;
  }
  [[nodiscard]] int total() const { return total_; }

 private:
  std::ostream& log_;
  SkipRefusedConfig config_;
  int in_a_row_ = 0, total_ = 0;
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/loop/nbv_loop.hpp>

namespace vantage {

struct SkipRefusedConfig {
  std::size_t most_in_a_row = 5;  ///< one more, and the mission ends: a broken sensor does not mend
};

/// Observer with which a mission goes on after a measurement that its map refuses: a pose that is not finite, a frame
/// of another size, a map that would outgrow its memory. The map is as it was, the view counts as visited. Says so on
/// `log`; throws the map's Error when too many are refused one after the other, or already the first of all.
/// Persistent.
class SkipRefused {
 public:
  explicit SkipRefused(std::ostream& log, const SkipRefusedConfig& config = {}) : log_(log), config_(config) {}

  template <class M>
  void refused(const M&, const Situation& q, const Error& error) {
    if (++in_a_row_ > config_.most_in_a_row || q.step == 1) throw error;
    steps_.push_back(q.step);
    log_ << "view " << q.step << " refused: " << error.what() << '\n';
  }
  template <class M, class Z>
  void measured(const M&, const Situation&, const Step<Z>&) {
    in_a_row_ = 0;
  }
  /// Which measurements were refused; 1 = the first of the mission.
  [[nodiscard]] const std::vector<std::uint64_t>& steps() const { return steps_; }

  void save(Sink& sink) const {
    sink.put(static_cast<std::uint64_t>(in_a_row_));
    sink.put(steps_);
  }
  void load(Source& source) {
    const auto in_a_row = source.get<std::uint64_t>();
    std::vector<std::uint64_t> steps;
    source.get(steps);
    in_a_row_ = static_cast<std::size_t>(in_a_row);
    steps_ = std::move(steps);
  }

 private:
  std::ostream& log_;
  SkipRefusedConfig config_;
  std::size_t in_a_row_ = 0;
  std::vector<std::uint64_t> steps_;
};

}  // namespace vantage

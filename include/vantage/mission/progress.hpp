// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/mission/record.hpp>
#include <vantage/mission/text.hpp>

namespace vantage {

/// Columns of the terminal behind a file descriptor; none if it is no terminal.
inline std::optional<int> terminal_columns(int fd) {
  if (::isatty(fd) == 0) return std::nullopt;
  ::winsize size{};
  return ::ioctl(fd, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? int{size.ws_col} : 80;
}

struct ProgressConfig {
  double budget_s = std::numeric_limits<double>::infinity();               ///< mission time, > 0; infinite: none
  std::uint64_t budget_steps = std::numeric_limits<std::uint64_t>::max();  ///< measurements, >= 1; the largest: none
  int terminal_fd = -1;  ///< a bar as wide as this terminal; -1 or no terminal: one line a step
  bool utf8 = true;      ///< else plain ASCII
};

/// Whether the user's locale says that the terminal shows UTF-8.
inline bool locale_is_utf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"})
    if (const char* value = std::getenv(name); value && *value) {
      const std::string_view text(value);
      return text.find("UTF-8") != text.npos || text.find("utf8") != text.npos || text.find("UTF8") != text.npos;
    }
  return false;
}

/// Observer that shows how a mission goes: step, mission time of its budget, best utility, the recorder's metrics and
/// the real time that is left. On a terminal one line is rewritten; elsewhere every step is a line of its own. Must
/// come after the Recorder whose record it shows, in the list of observers.
///
///     Progress progress(recorder.record(), std::cerr, ProgressConfig{.budget_s = 300, .terminal_fd = 2});
class Progress {
 public:
  Progress(const MissionRecord& record, std::ostream& out, const ProgressConfig& config)
      : record_(record), out_(out), config_(config) {
    Check check("ProgressConfig");
    check(config.budget_s > 0, "budget_s", config.budget_s, "> 0");
    check(config.budget_steps >= 1, "budget_steps", config.budget_steps, "at least 1");
    check.done();
  }

  template <class M>
  void started(const M&, const Situation&) {
    begin();
    show();
  }
  template <class M, class Z>
  void measured(const M&, const Situation&, const Step<Z>&) {
    if (!began_) begin();  // resumed
    show();
  }
  template <class M>
  void finished(const M&, const Situation&, StopReason reason) {
    if (!began_) begin();
    if (drawn_) out_ << '\n';
    drawn_ = false;
    out_ << "done ("
         << (reason == StopReason::stop_rule       ? "stop rule"
             : reason == StopReason::nothing_to_do ? "nowhere left to go"
                                                   : "the world ended")
         << ") in " << short_time(real_s()) << '\n'
         << std::flush;
  }

 private:
  void begin() {
    began_ = std::chrono::steady_clock::now();
    // The step that is being shown has already happened when a mission is resumed: its share is not ours.
    const std::vector<StepRecord>& steps = record_.steps;
    share_at_begin_ = steps.size() >= 2 ? share(steps[steps.size() - 2]) : 0.0;
  }
  [[nodiscard]] double real_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - *began_).count();
  }
  // How much of the budget is used, in [0, 1]: whichever runs out first.
  [[nodiscard]] double share(const StepRecord& r) const {
    const double of_steps = config_.budget_steps == std::numeric_limits<std::uint64_t>::max()
                                ? 0.0
                                : static_cast<double>(r.index) / static_cast<double>(config_.budget_steps);
    return std::clamp(std::max(r.elapsed_s / config_.budget_s, of_steps), 0.0, 1.0);
  }

  void show() {
    if (record_.steps.empty()) return;
    const StepRecord& r = record_.steps.back();
    const double done = share(r), made = done - share_at_begin_;
    std::vector<std::string> facts;
    facts.push_back("step " + std::to_string(r.index));
    facts.push_back(short_number(std::round(10 * r.elapsed_s) / 10) +
                    (std::isfinite(config_.budget_s) ? " of " + short_number(config_.budget_s) : "") + " s");
    if (r.planned) facts.push_back("utility " + short_number(r.utility));
    for (const Metric& m : r.metrics) facts.push_back(m.name + " " + short_number(m.value));
    if (const auto columns = terminal_columns(config_.terminal_fd)) {
      if (made > 0) facts.push_back("left " + short_time(real_s() * (1 - done) / made));
      draw(static_cast<std::size_t>(*columns) - 1, done, facts);
    } else {
      std::string line;
      for (const std::string& fact : facts) line += (line.empty() ? "" : "  ") + fact;
      out_ << line << '\n' << std::flush;
    }
  }

  // Drops facts from the right until the rest and a bar of at least ten columns fit; a narrower terminal gets no bar.
  void draw(std::size_t columns, double done, std::vector<std::string>& facts) {
    const std::string percent = std::to_string(static_cast<int>(100 * done)) + " %";
    const auto width = [&] {
      std::size_t n = percent.size();
      for (const std::string& fact : facts) n += 2 + fact.size();
      return n;
    };
    while (facts.size() > 1 && width() + 12 > columns) facts.pop_back();
    std::string line = "\r\x1b[K";
    if (width() + 12 <= columns) {
      const std::size_t bar = std::min<std::size_t>(40, columns - width() - 2);
      const auto full = static_cast<std::size_t>(std::round(done * static_cast<double>(bar)));
      for (std::size_t i = 0; i < bar; ++i) line += i < full ? (config_.utf8 ? "━" : "#") : (config_.utf8 ? "─" : "-");
      line += "  ";
    }
    line += percent;
    for (const std::string& fact : facts) line += "  " + fact;
    out_ << line << std::flush;
    drawn_ = true;
  }

  const MissionRecord& record_;
  std::ostream& out_;
  ProgressConfig config_;
  std::optional<std::chrono::steady_clock::time_point> began_ = {};
  double share_at_begin_ = 0;
  bool drawn_ = false;
};

}  // namespace vantage

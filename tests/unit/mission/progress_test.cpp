// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <limits>
#include <sstream>
#include <string>
#include <vantage/mission/progress.hpp>
#include <vantage/mission/recorder.hpp>
#include <vector>

#include "toy/mission.hpp"

namespace {

using namespace vantage;

/// A terminal that nobody looks at.
struct Terminal {
  int master = ::posix_openpt(O_RDWR | O_NOCTTY), fd = -1;
  explicit Terminal(unsigned short columns) {
    if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0) return;
    fd = ::open(::ptsname(master), O_RDWR | O_NOCTTY);
    ::winsize size{};
    size.ws_col = columns;
    size.ws_row = 25;
    ::ioctl(fd, TIOCSWINSZ, &size);
  }
  Terminal(const Terminal&) = delete;
  ~Terminal() {
    ::close(fd);
    ::close(master);
  }
};

std::string run(const ProgressConfig& config) {
  Recorder recorder(RecorderConfig{}, [](const toy::ToyMap& map) {
    return std::vector<Metric>{{"variance", map.total_variance()}};
  });
  std::ostringstream out;
  Progress progress(recorder.record(), out, config);
  auto loop = toy::toy_loop();
  toy::ToyWorld world;
  loop.run(world, nadir(4, 4, 2), {}, toy::ToyStop{20}, ModelledClock{}, Rng(5), recorder, progress);
  return out.str();
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(by, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + by.size();
  }
  return parts;
}

// Columns that a line of UTF-8 takes: every byte that does not continue a character.
std::size_t columns_of(const std::string& line) {
  std::size_t n = 0;
  for (const char c : line) n += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return n;
}

TEST(Progress, OneLineAStepWithoutATerminal) {
  const std::string text = run({.budget_s = 20});
  const auto lines = split(text, "\n");
  ASSERT_GE(lines.size(), 4u);
  EXPECT_EQ(lines[0], "step 0  0 of 20 s  variance 64");
  EXPECT_EQ(lines[1].find("step 1  "), 0u);
  EXPECT_NE(lines[1].find("  utility "), std::string::npos);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(lines[lines.size() - 2].find("done (stop rule) in 0:0"), 0u);
}

TEST(Progress, OneLineOnATerminalNeverWiderThanIt) {
  for (const unsigned short columns : std::initializer_list<unsigned short>{40, 80, 200}) {
    const Terminal terminal(columns);
    if (terminal.fd < 0) GTEST_SKIP() << "no pseudo-terminal here";
    ASSERT_EQ(terminal_columns(terminal.fd), columns);
    for (const bool utf8 : {false, true}) {
      const std::string text = run({.budget_s = 20, .terminal_fd = terminal.fd, .utf8 = utf8});
      const auto lines = split(text, "\n");
      ASSERT_EQ(lines.size(), 3u);  // the bar, "done", and nothing after the last line break
      const auto draws = split(lines[0], "\r\x1b[K");
      EXPECT_GT(draws.size(), 4u);
      for (const std::string& draw : draws) EXPECT_LT(columns_of(draw), columns) << draw;
      EXPECT_NE(draws.back().find("100 %"), std::string::npos);
      EXPECT_EQ(draws.back().find(utf8 ? "━━━━━" : "#####"), 0u) << draws.back();
      if (columns == 200) { EXPECT_NE(draws[2].find("left 0:0"), std::string::npos); }
    }
  }
}

TEST(Progress, AFileIsNoTerminal) {
  const int fd = ::open("/dev/null", O_WRONLY);
  EXPECT_FALSE(terminal_columns(fd));
  EXPECT_FALSE(terminal_columns(-1));
  EXPECT_EQ(run({.terminal_fd = fd}).find('\r'), std::string::npos);
  ::close(fd);
}

TEST(Progress, AResumedMissionShowsNoStart) {
  MissionRecord record;
  record.steps = {StepRecord{.index = 0}, StepRecord{.index = 5, .elapsed_s = 50}};
  std::ostringstream out;
  Progress progress(record, out, {.budget_s = 100});
  const FieldImage z{};
  progress.measured(toy::ToyMap(2), Situation{}, Step<FieldImage>{.index = 5, .measurement = z});
  EXPECT_EQ(out.str(), "step 5  50 of 100 s\n");
}

TEST(Progress, TheUtilityIsThatOfTheChosenView) {
  MissionRecord record;
  record.steps = {StepRecord{.index = 1, .planned = true, .utility = 2, .best_utility = 3}};
  std::ostringstream out;
  Progress(record, out, {}).started(toy::ToyMap(2), Situation{});
  EXPECT_EQ(out.str(), "step 1  0 s  utility 2\n");
}

TEST(Progress, RefusesABadConfig) {
  const MissionRecord record;
  std::ostringstream out;
  EXPECT_THROW(Progress(record, out, {.budget_s = 0}), Error);
  EXPECT_THROW(Progress(record, out, {.budget_s = std::numeric_limits<double>::quiet_NaN()}), Error);
  EXPECT_THROW(Progress(record, out, {.budget_steps = 0}), Error);
}

}  // namespace

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vantage/core/rng.hpp>
#include <vantage/io/file.hpp>

#include "toy/folder.hpp"

// A mission that is killed (kill -9) at random moments and started again ends in the same bytes.
namespace {

using namespace vantage;

std::string text_of(const std::filesystem::path& file) { return read_file(file, std::size_t{1} << 30); }

::pid_t start(const std::string& kind, const std::filesystem::path& folder) {
  std::string program = std::string(VANTAGE_PROGRAMS_DIR) + "/mission_to_kill_program", mode = kind,
              out = folder.string();
  char* argv[] = {program.data(), mode.data(), out.data(), nullptr};
  ::pid_t pid = -1;
  return ::posix_spawn(&pid, program.c_str(), nullptr, nullptr, argv, environ) == 0 ? pid : -1;
}

struct Toll {
  int kills = 0, amid_writing = 0;
};

// Runs the mission to its end, with as many lives as it takes.
void run_and_kill(const std::string& kind, const std::filesystem::path& folder, Rng& rng, Toll& toll) {
  using namespace std::chrono;
  for (double longest_s = 0.1;; longest_s *= 1.05) {  // on a slow machine a life must still be long enough
    ASSERT_LT(longest_s, 60) << "the mission does not get on";
    const ::pid_t pid = start(kind, folder);
    ASSERT_GT(pid, 0);
    std::this_thread::sleep_for(duration<double>(rng.uniform(0, longest_s)));
    ::kill(pid, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(pid, &status, 0), pid);
    if (WIFEXITED(status)) {
      ASSERT_EQ(WEXITSTATUS(status), 0);
      return;
    }
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    ++toll.kills;
    toll.amid_writing += std::filesystem::exists(folder / "mission.checkpoint.part") ||
                         std::filesystem::exists(folder / "mission.json.part");
  }
}

class Crash : public testing::TestWithParam<const char*> {};

TEST_P(Crash, AtLeastTwentyKillsAndTheSameBytes) {
  const toy::Folder whole;
  const ::pid_t pid = start(GetParam(), whole.path);
  ASSERT_GT(pid, 0);
  int status = -1;
  ASSERT_EQ(::waitpid(pid, &status, 0), pid);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);

  Rng rng(1);
  Toll toll;
  for (int mission = 0; toll.kills < 20; ++mission) {  // a fast machine may need several missions to kill so often
    ASSERT_LT(mission, 50);
    const toy::Folder broken;
    run_and_kill(GetParam(), broken.path, rng, toll);
    if (HasFatalFailure()) return;
    for (const char* file : {"mission.json", "map.bytes"})
      ASSERT_EQ(text_of(broken.path / file), text_of(whole.path / file)) << file;
  }
  RecordProperty("kills", toll.kills);
  RecordProperty("kills_amid_writing", toll.amid_writing);
  std::cout << toll.kills << " kills, " << toll.amid_writing << " of them while a file was written\n";
}

INSTANTIATE_TEST_SUITE_P(Missions, Crash, testing::Values("toy", "field"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace

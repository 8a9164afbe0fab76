// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <thread>

#include <vantage/core/rng.hpp>
#include <vantage/io/file.hpp>

#include "toy/folder.hpp"

inline std::string text_of(const std::filesystem::path& file) { return vantage::read_file(file, std::size_t{1} << 30); }

/// A mission's program, as its users start it, in a folder of its own.
class MissionProgram : public testing::Test {
 protected:
  explicit MissionProgram(const std::string& name)
      : program(std::filesystem::path(VANTAGE_PROGRAMS_DIR) / ".." / "examples" / name) {}
  const std::filesystem::path program;
  const toy::Folder folder;

  void SetUp() override {
    if (!std::filesystem::exists(program)) GTEST_SKIP() << "the examples are not built";
  }
  struct Ended {
    int code;
    std::string out, err;
  };
  [[nodiscard]] ::pid_t start(const std::string& arguments) const {
    std::string shell = "/bin/sh", c = "-c";
    std::string line = "exec '" + program.string() + "' " + arguments + " >'" + (folder.path / "out.txt").string() +
                       "' 2>'" + (folder.path / "err.txt").string() + "'";
    char* argv[] = {shell.data(), c.data(), line.data(), nullptr};
    ::pid_t pid = -1;
    return ::posix_spawn(&pid, shell.c_str(), nullptr, nullptr, argv, environ) == 0 ? pid : -1;
  }
  [[nodiscard]] Ended run(const std::string& arguments) const {
    const ::pid_t pid = start(arguments);
    int status = -1;
    ::waitpid(pid, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder.path / "out.txt"),
            text_of(folder.path / "err.txt")};
  }
  [[nodiscard]] std::string out(const std::string& name) const {
    return " --out '" + (folder.path / name).string() + "'";
  }
  // Killed (kill -9) at random moments, so often at least, and started again, missions end in the same files.
  void expect_to_survive(const std::string& arguments, int least_kills, std::initializer_list<const char*> files) {
    const auto began = std::chrono::steady_clock::now();
    ASSERT_EQ(run(arguments + out("whole")).code, 0);
    const std::chrono::duration<double> whole_life = std::chrono::steady_clock::now() - began;
    vantage::Rng rng(1);
    int kills = 0, resumed = 0;
    for (int mission = 0; kills < least_kills; ++mission) {
      ASSERT_LT(mission, 20);
      const std::string name = "broken_" + std::to_string(mission);
      std::filesystem::remove_all(folder.path / name);  // of other arguments
      for (int status = -1; !WIFEXITED(status);) {
        const ::pid_t pid = start(arguments + " --resume" + out(name));
        // On a machine that is busier now than it was, a life must still be long enough.
        std::this_thread::sleep_for(rng.uniform(0.1, 0.6) * (1 + 0.1 * kills) * whole_life);
        ::kill(pid, SIGKILL);
        ASSERT_EQ(::waitpid(pid, &status, 0), pid);
        resumed += text_of(folder.path / "err.txt").find("resumed after step") != std::string::npos;
        if (WIFEXITED(status)) {
          ASSERT_EQ(WEXITSTATUS(status), 0) << text_of(folder.path / "err.txt");
        } else {
          ++kills;
        }
      }
      for (const char* file : files)
        EXPECT_EQ(text_of(folder.path / name / file), text_of(folder.path / "whole" / file))
            << arguments << ' ' << file;
    }
    EXPECT_GE(resumed, 1) << arguments;
    std::cout << kills << " kills, " << resumed << " resumed, " << whole_life.count() << " s a mission\n";
  }
};

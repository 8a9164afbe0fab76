// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

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
};

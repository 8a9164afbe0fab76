// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/file.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace vantage {
namespace {

std::string message(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& e) { return e.what(); }
  return "";
}

TEST(File, WritesAndReadsBack) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.bin";
  std::string bytes("line\n\0\xFF end", 11);
  write_file(path, bytes);
  EXPECT_EQ(read_file(path, 100), bytes);
  write_file(path, std::string_view("shorter"));
  EXPECT_EQ(read_file(path, 7), "shorter");
  write_file(path, std::string_view());
  EXPECT_EQ(read_file(path, 0), "");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) files += entry.is_regular_file();
  EXPECT_EQ(files, 1u) << "nothing is left beside it";
}

TEST(File, RefusesWhatIsNoReadableFile) {
  const test::TemporaryFolder folder;
  EXPECT_NE(message([&] { read_file(folder.path() / "none", 9); }).find("no such file"), std::string::npos);
  EXPECT_NE(message([&] { read_file(folder.path(), 9); }).find("no regular file"), std::string::npos);
  EXPECT_NE(message([&] { read_file("/dev/zero", 9); }).find("no regular file"), std::string::npos);
  EXPECT_NE(message([&] { read_file(folder.put("big", "0123456789"), 9); }).find("10 bytes; expected at most 9"),
            std::string::npos);
}

TEST(File, AFailedWriteSaysWhyAndKeepsTheOldFile) {
  const test::TemporaryFolder folder;
  EXPECT_NE(
      message([&] { write_file(folder.path() / "no" / "a", std::string_view("x")); }).find("No such file or directory"),
      std::string::npos);
  const auto path = folder.put("a", "old");
  std::filesystem::create_directory(folder.path() / "a.part");  // where the new one would be prepared
  EXPECT_NE(message([&] { write_file(path, std::string_view("new")); }).find("cannot be written"), std::string::npos);
  EXPECT_EQ(read_file(path, 9), "old");
}

// A reader, or a crash, at any moment finds one of the versions whole.
TEST(File, IsNeverSeenHalfWritten) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a";
  write_file(path, std::string(100'000, '0'));
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
    for (char c = '1';; c = c == '9' ? '1' : static_cast<char>(c + 1)) write_file(path, std::string(100'000, c));
  std::set<char> seen;
  for (int i = 0; i < 300; ++i) {
    const std::string bytes = read_file(path, 1 << 20);
    ASSERT_EQ(bytes, std::string(100'000, bytes.at(0)));
    seen.insert(bytes[0]);
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  const std::string bytes = read_file(path, 1 << 20);
  EXPECT_EQ(bytes, std::string(100'000, bytes.at(0)));
}

}  // namespace
}  // namespace vantage

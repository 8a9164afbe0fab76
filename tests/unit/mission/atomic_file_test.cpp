// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vantage/mission/atomic_file.hpp>

#include "toy/folder.hpp"

namespace {

using namespace vantage;

std::string text_of(const std::filesystem::path& file) {
  const auto bytes = read_bytes(file);
  return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "(none)";
}

TEST(AtomicFile, WritesAndReplaces) {
  const toy::Folder folder;
  const auto file = folder.path / "a.json";
  EXPECT_FALSE(read_bytes(file));
  write_atomically(file, std::string(100'000, 'x'));
  EXPECT_EQ(text_of(file).size(), 100'000u);
  write_atomically(file, "short");
  EXPECT_EQ(text_of(file), "short");
  write_atomically(file, "");
  EXPECT_EQ(text_of(file), "");
}

TEST(AtomicFile, LeavesNothingBeside) {
  const toy::Folder folder;
  std::ofstream(folder.path / "a.part") << "what a killed writer left behind, longer than the text";
  write_atomically(folder.path / "a", "text");
  EXPECT_EQ(text_of(folder.path / "a"), "text");
  EXPECT_FALSE(std::filesystem::exists(folder.path / "a.part"));
}

TEST(AtomicFile, FailureKeepsTheOldFile) {
  const toy::Folder folder;
  const auto file = folder.path / "a";
  write_atomically(file, "old");
  std::filesystem::create_directory(folder.path / "a.part");  // the file beside cannot be opened
  EXPECT_THROW(write_atomically(file, "new"), std::system_error);
  EXPECT_EQ(text_of(file), "old");
  EXPECT_THROW(write_atomically(folder.path / "nowhere" / "a", "new"), std::system_error);
}

TEST(AtomicFile, FullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const detail::Descriptor full("/dev/full", O_WRONLY);
  const std::string text = "no room";
  EXPECT_THROW(full.write(std::as_bytes(std::span(text.data(), text.size()))), std::system_error);
}

TEST(AtomicFile, RefusesWhatIsNoFileOrTooLong) {
  const toy::Folder folder;
  EXPECT_THROW(read_bytes(folder.path), Error);
  write_atomically(folder.path / "a", "12345");
  EXPECT_NO_THROW(read_bytes(folder.path / "a", 5));
  EXPECT_THROW(read_bytes(folder.path / "a", 4), Error);
}

}  // namespace

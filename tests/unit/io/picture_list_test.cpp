// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/picture_list.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace vantage {
namespace {

std::vector<std::string> names(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::string> out;
  for (const std::filesystem::path& p : paths) out.push_back(p.filename().string());
  return out;
}

TEST(PictureList, CountsAsAPersonDoes) {
  const test::TemporaryFolder folder;
  for (const char* name : {"10.png", "2.PNG", "b2.jpg", "b10.jpeg", "b010.pgm", "1.ppm", "a.txt", "c", "d.png.txt"})
    folder.put(name, "");
  EXPECT_EQ(names(pictures(folder.path())),
            (std::vector<std::string>{"1.ppm", "2.PNG", "10.png", "b2.jpg", "b10.jpeg", "b010.pgm"}));
  EXPECT_EQ(names(pictures(folder.path(), "b1")), std::vector<std::string>{"b10.jpeg"});
}

TEST(PictureList, IsEmptyWhereThereIsNoFolder) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(pictures(folder.path()).empty());
  EXPECT_TRUE(pictures(folder.path() / "none").empty());
  EXPECT_TRUE(pictures(folder.put("a.png", "")).empty());
  EXPECT_TRUE(pictures(std::string(5000, 'x')).empty());
}

}  // namespace
}  // namespace vantage

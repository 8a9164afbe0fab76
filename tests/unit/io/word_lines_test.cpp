// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include <vantage/io/word_lines.hpp>

namespace vantage {
namespace {

TEST(WordLines, WordsOfTheLinesThatCount) {
  WordLines lines("# a comment 1 2 3\n\n  one\t2.5  three four \r\n   \n-7 +1e-3\nlast", "file");
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines.word(0), "one");
  EXPECT_EQ(lines.number(1), 2.5);
  EXPECT_EQ(lines.rest(2), "three four");
  EXPECT_EQ(lines.where(), "file:3");
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.integer(0, -10, 10), -7);
  EXPECT_EQ(lines.number(1), 1e-3);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.word(0), "last");
  EXPECT_FALSE(lines.next());
}

TEST(WordLines, SkipLeavesOutALineWhateverItHolds) {
  WordLines lines(std::string_view("a\n\x01 binary\nb\n\nc\n", 16), "file");
  std::string seen;
  while (lines.next()) {
    seen += lines.word(0);
    lines.skip();
  }
  EXPECT_EQ(seen, "abc");
}

// What is wrong is named, with its line.
void refuses(std::string_view text, std::string_view named, const WordLimits& limits = {}) {
  try {
    WordLines lines(text, "file", limits);
    while (lines.next()) {
      (void)lines.number(1);
      (void)lines.integer(2, 0, 9);
    }
    FAIL() << text;
  } catch (const Error& e) { EXPECT_NE(std::string(e.what()).find(named), std::string::npos) << e.what(); }
}

TEST(WordLines, RefusesWithTheLine) {
  refuses("a 1 2\nb x 2\n", "file:2: 'x'");
  refuses("a 1 2\nb 1e999 2\n", "file:2: '1e999'");
  refuses("a nan 2\n", "file:1: 'nan'");
  refuses("a 1 10\n", "from 0 to 9");
  refuses("a 1 2.5\n", "'2.5'");
  refuses("a 1\n", "2 words on the line");
  refuses("a\n", "1 words on the line");
  refuses(std::string_view("a 1 2\n\0 1 2\n", 12), "file:2: byte 0");
  refuses("a 1 2 3\n", "more than 3 words", {.words = 3});
  refuses("a 1 2\na 1 2\n", "more than 1 lines", {.lines = 1});
  refuses("a 1 2\n", "6 bytes", {.bytes = 5});
  refuses("a    1   2\n", "a line of 10 bytes", {.line_bytes = 9});
}

TEST(WordLines, CommentsMayBeLong) {
  std::string text = "#";
  for (int i = 0; i < 200; ++i) text += " word";
  text += "\na 1 2\n";
  WordLines lines(text, "file");
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.word(0), "a");
}

}  // namespace
}  // namespace vantage

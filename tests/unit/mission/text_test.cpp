// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vantage/mission/text.hpp>

namespace {

using namespace vantage;

TEST(Text, NumbersAsPeopleWriteThem) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(-0.0), "0");
  EXPECT_EQ(short_number(4096), "4096");
  EXPECT_EQ(short_number(0.042345), "0.0423");
  EXPECT_EQ(short_number(123.456), "123.5");
  EXPECT_EQ(short_number(-1e9), "-1e+09");
  EXPECT_EQ(short_number(std::numeric_limits<double>::quiet_NaN()), "-");
  EXPECT_EQ(short_number(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(short_number(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Text, Times) {
  EXPECT_EQ(short_time(0), "0:00");
  EXPECT_EQ(short_time(-5), "0:00");
  EXPECT_EQ(short_time(59.6), "1:00");
  EXPECT_EQ(short_time(725), "12:05");
  EXPECT_EQ(short_time(3723), "1:02:03");
}

TEST(Text, Markup) {
  EXPECT_EQ(escaped("<a href=\"x\">Tom & Jerry's</a>"), "&lt;a href=&quot;x&quot;&gt;Tom &amp; Jerry&#39;s&lt;/a&gt;");
  EXPECT_EQ(escaped(""), "");
}

TEST(Text, Base64OfRfc4648) {
  const auto of = [](std::string_view s) { return base64(std::as_bytes(std::span(s.data(), s.size()))); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe\xfd"), "//79");
}

}  // namespace

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/json.hpp>

#include <string>

#include <gtest/gtest.h>

#include "message_of.hpp"

namespace vantage {
namespace {

TEST(Json, TellsLineAndByteOfAMistake) {
  EXPECT_REFUSED(parse_json("{\n \"a\": 1,\n \"b\" 2}", "a.json"), "a.json:3: no JSON at byte");
  EXPECT_REFUSED(parse_json("{\"a\": [1, 2", "a.json"), "a.json:1: ends at byte 11");
  EXPECT_REFUSED(parse_json("", "a.json"), "a.json:1: ends at byte 0");
  EXPECT_REFUSED(parse_json("[1e999]", "a.json"), "a number that is out of range");
  EXPECT_REFUSED(parse_json("[\"\xFF\"]", "a.json"), "no JSON at byte");
  EXPECT_REFUSED(parse_json("[nan]", "a.json"), "no JSON at byte 3");
}

TEST(Json, IsBoundedBeforeItIsParsed) {
  EXPECT_REFUSED(parse_json(std::string(1 << 20, '['), "a"), "nested deeper than 64 at byte 64");
  EXPECT_REFUSED(parse_json("[1,2,3,4]", "a", {.values = 4}), "more than 4 values at byte 6");
  EXPECT_REFUSED(parse_json("[1,2,3,4]", "a", {.bytes = 4}), "9 bytes; expected at most 4");
  EXPECT_EQ(parse_json(R"(["[[[[,,,,\"[["])", "a", {.depth = 1, .values = 2}).size(), 1u) << "texts do not count";
}

TEST(Json, ItemsKnowWhereTheyStand) {
  const nlohmann::json json =
      parse_json(R"({"boxes":[{"min":[0,1,2],"n":3,"x":-1.5,"name":"a","on":true,"no":null}]})", "s");
  const JsonItem root(json, "s.json"), box = root.at("boxes").at(std::size_t{0});
  EXPECT_EQ(box.at("min").vector<3>(), Eigen::Vector3d(0, 1, 2));
  EXPECT_EQ(box.at("n").count(3), 3u);
  EXPECT_EQ(box.at("x").number(), -1.5);
  EXPECT_EQ(box.at("name").text(), "a");
  EXPECT_TRUE(box.at("on").flag());
  EXPECT_FALSE(box.find("no")) << "null is none";
  EXPECT_FALSE(box.find("max"));
  std::size_t members = 0;
  box.each_member([&](const std::string&, const JsonItem&) { ++members; });
  EXPECT_EQ(members, 6u);
  EXPECT_REFUSED(box.at("max"), "s.json: /boxes/0: no 'max'");
  EXPECT_REFUSED(box.at("min").vector<2>(), "s.json: /boxes/0/min: 3 elements; expected 2 numbers");
  EXPECT_REFUSED(box.at("n").count(2), "/boxes/0/n: 3; expected a whole number from 0 to 2");
  EXPECT_REFUSED(box.at("x").count(2), "/boxes/0/x: -1.5");
  EXPECT_REFUSED(box.at("x").number(0, 1), "/boxes/0/x: -1.5; expected a number from 0 to 1");
  EXPECT_REFUSED(box.at("name").number(), "/boxes/0/name: a value of kind string; expected a number");
  EXPECT_REFUSED(box.at("n").text(), "a value of kind number; expected a text");
  EXPECT_REFUSED(box.at("n").flag(), "expected true or false");
  EXPECT_REFUSED(root.at("boxes").at(1), "s.json: /boxes: 1 elements; expected more than 1");
  EXPECT_REFUSED(root.size(), "s.json: a value of kind object; expected an array");
  EXPECT_REFUSED(root.at("boxes").find("a"), "/boxes: a value of kind array; expected an object");
}

}  // namespace
}  // namespace vantage

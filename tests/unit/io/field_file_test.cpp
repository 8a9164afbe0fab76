// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/field_file.hpp>

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace vantage {
namespace {

FieldSamples read(const std::string& csv, const std::optional<std::string>& column = {}, const std::string& json = {}) {
  const test::TemporaryFolder folder;
  if (!json.empty()) folder.put("f.json", json);
  return read_field(folder.put("f.csv", csv), column);
}
std::string refusal(const std::string& csv, const std::optional<std::string>& column = {},
                    const std::string& json = {}) {
  try {
    static_cast<void>(read(csv, column, json));
  } catch (const Error& e) {
    const std::string text = e.what();
    return text.substr(text.find("/f.") + 1);  // without the temporary folder
  }
  return "(accepted)";
}

TEST(FieldFile, TakesTheLastColumnOrTheOneNamed) {
  const std::string csv = "x,y,zinc,lead\n1,2,3,4\n5,6,,8\n";
  const FieldSamples last = read(csv), named = read(csv, "zinc");
  ASSERT_EQ(last.samples.size(), 2u);
  EXPECT_EQ(last.quantity.name, "lead");
  EXPECT_EQ(last.quantity.unit, "");
  EXPECT_EQ(last.samples[1].position, Eigen::Vector2d(5, 6)) << "plane coordinates as they are";
  EXPECT_EQ(last.samples[1].value, 8);
  EXPECT_EQ(named.samples[0].value, 3);
  EXPECT_TRUE(std::isnan(named.samples[1].value)) << "a blank stays, as a blank";
}

TEST(FieldFile, TakesUnitsFromTheFileBesideIt) {
  const std::string csv = "x,y,t\n1,2,3\n";
  EXPECT_EQ(read(csv, {}, R"({"units": {"t": "degC", "x": "m"}, "about": [1, 2]})").quantity.unit, "degC");
  for (const char* json : {"{}", "[]", "3", R"({"units": 3})", R"({"units": {"t": 4}})", R"({"units": {"u": "m"}})"})
    EXPECT_EQ(read(csv, {}, json).quantity.unit, "") << json;
  EXPECT_EQ(refusal(csv, {}, "{\"units\": "),
            R"(f.json: this is no JSON; expected {"units": {"column": "unit"}}, or no such file)");
  EXPECT_EQ(refusal(csv, {}, std::string(100'000, '[')).find("f.json: this is no JSON"), 0u);
}

TEST(FieldFile, LongitudeAndLatitudeBecomeLengths) {
  const double east = std::cos(deg(60));
  for (const auto& f : {read("lon,lat,v\n10,50,1\n12,70,2\n"), read("Latitude,Longitude,v\n50,10,1\n70,12,2\n"),
                        read("x,y,v\n10,50,1\n12,70,2\n", {}, R"({"units": {"x": "deg lon", "y": "deg lat"}})")}) {
    EXPECT_TRUE(f.samples[0].position.isApprox(Eigen::Vector2d(10 * east, 50))) << f.samples[0].position.transpose();
    EXPECT_TRUE(f.samples[1].position.isApprox(Eigen::Vector2d(12 * east, 70)));
    EXPECT_EQ(f.samples[1].value, 2);
  }
}

TEST(FieldFile, PositionsAreKnownByTheirNames) {
  for (const auto& f : {read("z,x,y\n3,1,2\n"), read("Y,z,X\n2,3,1\n"), read("station,x,y,z\nAkron,1,2,3\n"),
                        read("x,y,lon,lat,z\n1,2,10,50,3\n", "z"), read("east,north,z\n1,2,3\n")}) {
    EXPECT_EQ(f.samples[0].position, Eigen::Vector2d(1, 2)) << f.quantity.name;
    EXPECT_EQ(f.samples[0].value, 3);
    EXPECT_EQ(f.quantity.name, "z");
    EXPECT_FALSE(f.latitude_deg);
  }
  const FieldSamples f = read("z,LAT,LON\n3,60,10\n4,60,12\n");
  EXPECT_TRUE(f.samples[1].position.isApprox(Eigen::Vector2d(12 * std::cos(deg(60)), 60)));
  EXPECT_EQ(f.samples[1].value, 4);
  EXPECT_EQ(f.latitude_deg, 60);
}

TEST(FieldFile, RefusesWhatIsNoField) {
  EXPECT_EQ(refusal("x,y\n1,2\n"), "f.csv: 2 columns; expected x, y and at least one column of values");
  EXPECT_EQ(refusal("x,y,v\n1,2,3\n", "w"), "f.csv: no column 'w'; expected one of x, y, v");
  EXPECT_EQ(refusal("x,y,v\n1,2,3\n", "y"), "f.csv: column 'y' holds positions; expected a column of values");
  EXPECT_EQ(refusal("x,y,v\n1,2,3\n4,,6\n"), "f.csv:3: a position is missing; expected numbers in columns 'x' and 'y'");
  EXPECT_EQ(refusal("x,y,v\n1,2,3\n4,5,warm\n"), "f.csv:3: 'warm' in column 'v'; expected a finite number, or nothing");
  EXPECT_EQ(refusal("x,y,v\n1,2,inf\n"), "f.csv:2: 'inf' in column 'v'; expected a finite number, or nothing");
  EXPECT_EQ(refusal("lon,lat,v\n1,91,3\n"), "f.csv:2: latitude 91; expected -90 to 90 degrees");
  EXPECT_EQ(refusal("lon,lat,v\n-361,1,3\n"), "f.csv:2: longitude -361; expected -360 to 360 degrees");
  EXPECT_EQ(refusal("lon,y,v\n1,1,3\n"),
            "f.csv: columns 'lon' and 'y'; expected both or neither in degrees of longitude and latitude");
  EXPECT_EQ(refusal("name,east,north,v\na,1,2,3\n").find("f.csv:2: 'a' in column 'name'"), 0u);
  EXPECT_EQ(refusal("1,2,3\n4,5,6\n"), "f.csv:1: numbers only; expected a line of column names");
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/csv.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace vantage {
namespace {

std::vector<double> list(std::span<const double> s) { return {s.begin(), s.end()}; }

std::string refusal(std::string_view text, const CsvLimits& limits = {}) {
  try {
    static_cast<void>(parse_csv(text, "f.csv", limits));
  } catch (const Error& e) { return e.what(); }
  return "(accepted)";
}
// The refusal of a single field.
std::string refusal_of(const std::string& field) {
  const CsvTable t = parse_csv("x,y\n1,2\n3," + field + "\n", "f.csv");
  EXPECT_EQ(list(t.column("x")), (std::vector<double>{1, 3})) << "other columns are untouched";
  try {
    static_cast<void>(t.column("y"));
  } catch (const Error& e) { return e.what(); }
  return "(accepted)";
}

TEST(Csv, ReadsColumnsOfNumbers) {
  const CsvTable t = parse_csv("x,y,height\n1,2,3\n-4.5,6e-3,.5\n", "f.csv");
  EXPECT_EQ(t.names(), (std::vector<std::string>{"x", "y", "height"}));
  EXPECT_EQ(t.rows(), 2u);
  EXPECT_EQ(list(t.column("x")), (std::vector<double>{1, -4.5}));
  EXPECT_EQ(list(t.column(1)), (std::vector<double>{2, 6e-3}));
  EXPECT_EQ(list(t.column("height")), (std::vector<double>{3, 0.5}));
}

TEST(Csv, ToleratesWhatProgramsWrite) {
  const CsvTable t =
      parse_csv("\xEF\xBB\xBF\"x\" , \"a \"\"b\"\", c\",z\r\n\r\n +1 ,\"2.5\",\t3\r\n 4,NA,\n   \n7,8,9");
  EXPECT_EQ(t.names(), (std::vector<std::string>{"x", "a \"b\", c", "z"}));
  EXPECT_EQ(list(t.column("x")), (std::vector<double>{1, 4, 7}));
  EXPECT_EQ(t.column(1)[0], 2.5);
  EXPECT_TRUE(std::isnan(t.column(1)[1])) << "NA";
  EXPECT_TRUE(std::isnan(t.column("z")[1])) << "empty";
  EXPECT_EQ(t.line(0), 3u);
  EXPECT_EQ(t.line(2), 6u);
}

TEST(Csv, OneColumnIsATable) { EXPECT_EQ(list(parse_csv("v\n1\n2\n").column("v")), (std::vector<double>{1, 2})); }

TEST(Csv, TextStandsBesideNumbersUntilItIsAskedFor) {
  const CsvTable t = parse_csv("station,t\nAkron 4 E,1.5\n\"Boulder, CO\",2\n", "f.csv");
  EXPECT_EQ(list(t.column("t")), (std::vector<double>{1.5, 2}));
  EXPECT_THROW(static_cast<void>(t.column("station")), Error);
}

TEST(Csv, FieldsThatAreNoFiniteNumberAreRefusedWithTheirLine) {
  EXPECT_EQ(refusal_of("warm"), "f.csv:3: 'warm' in column 'y'; expected a finite number, or nothing");
  for (const char* field : {"nan", "NaN", "inf", "-inf", "Infinity", "nan(1)", "1.2.3", "1e", "0x10", "--1", "+-1", "+",
                            "-", ".", "1 2", "1_000", "é"})
    EXPECT_EQ(refusal_of(field).rfind("f.csv:3: '", 0), 0u) << field;
  EXPECT_EQ(refusal_of("1e999"), "f.csv:3: '1e999' (out of range) in column 'y'; expected a finite number, or nothing");
  EXPECT_EQ(refusal_of(std::string(5000, '9') + "e9")
                .find("f.csv:3: '9999999999999999999999999999999999999999...' (out of range)"),
            0u);
}

TEST(Csv, MissingColumnsAreNamedWithThoseThereAre) {
  const CsvTable t = parse_csv("x,y\n1,2\n", "f.csv");
  try {
    static_cast<void>(t.column("z"));
    FAIL();
  } catch (const Error& e) { EXPECT_STREQ(e.what(), "f.csv: no column 'z'; expected one of x, y"); }
  const CsvTable latin1 = parse_csv("x,temp\xE9\n1,warm\n", "f.csv");
  EXPECT_REFUSED(latin1.column("\xE9"), "f.csv: no column '?'; expected one of x, temp?");
  EXPECT_REFUSED(latin1.column(1), "f.csv:2: 'warm' in column 'temp?'");
}

TEST(Csv, RefusesWhatIsNoTable) {
  EXPECT_EQ(refusal(""), "f.csv: the file is empty; expected a line of column names");
  EXPECT_EQ(refusal("\n \n\r\n"), "f.csv: the file is empty; expected a line of column names");
  EXPECT_EQ(refusal("x,y\n"), "f.csv: no row after the column names; expected at least one");
  EXPECT_EQ(refusal("x,y\n1,2\n3\n"), "f.csv:3: 1 fields; expected 2, as in the line of names");
  EXPECT_EQ(refusal("x,y\n1,2,3\n"), "f.csv:2: 3 fields; expected 2, as in the line of names");
  EXPECT_EQ(refusal("x,y,x\n1,2,3\n"), "f.csv:1: two columns are named 'x'; expected distinct names");
  EXPECT_EQ(refusal("x,,y\n1,2,3\n"), "f.csv:1: column 2 has no name; expected a name for each column");
  EXPECT_EQ(refusal("0,0,1\n1,1,2\n"), "f.csv:1: numbers only; expected a line of column names");
  EXPECT_EQ(refusal("x,2\n1,2\n"), "(accepted)");
  EXPECT_EQ(refusal("x;y\n1;2\n"), "f.csv:1: no comma in the line of names; expected comma-separated columns");
  EXPECT_EQ(refusal("x,y\n\"1,2\n"), "f.csv:2: a quote is not closed; expected a closing quote on the same line");
  EXPECT_EQ(refusal("x,y\n\"1\"2,2\n"), "f.csv:2: text after a closing quote; expected a comma");
  EXPECT_EQ(refusal(std::string_view("x,y\n1,\0002\n", 9)), "f.csv:2: byte 0; expected text, not binary data");
  EXPECT_EQ(refusal("\x89PNG\r\n\x1A\n"), "f.csv:2: byte 26; expected text, not binary data");
}

TEST(Csv, IsBounded) {
  const std::string rows = "x,y\n1,2\n3,4\n5,6\n";
  EXPECT_EQ(refusal(rows, {.bytes = 15}), "f.csv: 16 bytes; expected at most 15");
  EXPECT_EQ(refusal(rows, {.columns = 1}), "f.csv:1: more than 1 columns; expected fewer");
  EXPECT_EQ(refusal(rows, {.values = 4}), "f.csv:4: more than 4 values; expected fewer");
  EXPECT_EQ(refusal(rows, {.values = 6}), "(accepted)");
  EXPECT_EQ(refusal("x,y\n" + std::string(3 << 20, '1') + ",2\n"),
            "f.csv:2: a line of 3145730 bytes; expected at most 1048576");
  EXPECT_EQ(refusal(std::string(100'000, ',')), "f.csv:1: column 1 has no name; expected a name for each column");
}

TEST(Csv, ReadsFilesAndNamesThem) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_csv(folder.put("good.csv", "x,y\n1,2\n")).rows(), 1u);
  const auto bad = folder.put("bad.csv", "x,y\n1\n");
  try {
    static_cast<void>(read_csv(bad));
    FAIL();
  } catch (const Error& e) { EXPECT_EQ(std::string(e.what()).find(bad.string() + ":2: 1 fields"), 0u) << e.what(); }
  EXPECT_THROW(static_cast<void>(read_csv(folder.path() / "none.csv")), Error);
  EXPECT_THROW(static_cast<void>(read_csv(bad, {.bytes = 3})), Error);
}

TEST(Csv, WrittenNumbersComeBackBitForBit) {
  Rng rng(8);
  std::vector<double> a{
      0.1, -0.0, 1e300, 5e-324, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::max()},
      b{1, 2, 3, 4, 5, 6};
  for (int i = 0; i < 1000; ++i) {
    a.push_back(rng.normal() * std::pow(10, rng.uniform(-300, 300)));
    b.push_back(rng.uniform());
  }
  const std::vector<std::string> names{"a", "b"};
  const std::vector<std::vector<double>> columns{a, b};
  const CsvTable t = parse_csv(format_csv(names, columns));
  ASSERT_EQ(t.rows(), a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(t.column("a")[i] == a[i] || (std::isnan(a[i]) && std::isnan(t.column("a")[i]))) << a[i];
    EXPECT_EQ(t.column("b")[i], b[i]);
  }
}

TEST(Csv, FormatRefusesWhatCouldNotBeReadBack) {
  const auto format = [](const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns) {
    return format_csv(names, columns);
  };
  EXPECT_THROW(format({"a"}, {{1}, {2}}), Error);
  EXPECT_THROW(format({}, {}), Error);
  EXPECT_THROW(format({"a", "b"}, {{1}, {2, 3}}), Error);
  EXPECT_THROW(format({"a,b"}, {{1}}), Error);
  EXPECT_THROW(format({""}, {{1}}), Error);
  EXPECT_THROW(format({"a"}, {{std::numeric_limits<double>::infinity()}}), Error);
}

}  // namespace
}  // namespace vantage

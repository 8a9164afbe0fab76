// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include <vantage/core/error.hpp>

namespace vantage {
namespace {

template <class F>
std::string message(F&& f) {
  try {
    f();
  } catch (const Error& e) { return e.what(); }
  return "";
}

TEST(Error, SaysWhereWhatAndWhatWasExpected) {
  EXPECT_EQ(message([] { throw Error("Here", "a thing", "another"); }), "Here: a thing; expected another");
  EXPECT_EQ(message([] { throw Error("Here", "a thing"); }), "Here: a thing");
  EXPECT_EQ(concat("row ", 3, " of ", 0.5), "row 3 of 0.5");
}

TEST(Check, NamesEveryViolationAtOnce) {
  Check check("Config");
  check(true, "fine", 1, "anything");
  check.positive("size_m", -2.0);
  check.not_negative("count", -1);
  check.finite("mean", std::numeric_limits<double>::infinity());
  check(false, "colour", "red", "green");
  EXPECT_EQ(
      message([&] { check.done(); }),
      "Config: size_m = -2 (expected finite and > 0); count = -1 (expected finite and >= 0); mean = inf (expected "
      "finite); colour = red (expected green)");
}

TEST(Check, NothingWrongNothingThrown) {
  Check check("Config");
  check.positive("a", 1e-300);
  check.not_negative("b", 0);
  check.finite("c", -1e300);
  EXPECT_NO_THROW(check.done());
}

TEST(Check, NaNIsNeverRight) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int rule = 0; rule < 3; ++rule) {
    Check check("Config");
    if (rule == 0) check.positive("a", nan);
    if (rule == 1) check.not_negative("a", nan);
    if (rule == 2) check.finite("a", nan);
    EXPECT_THROW(check.done(), Error) << rule;
  }
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/stop_rules.hpp>

namespace vantage {
namespace {

const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
const archetype::FullMap map;

TEST(StopRules, HoldFromTheBoundOn) {
  EXPECT_FALSE(MissionTime(300)(map, {.elapsed_s = 299.9}));
  EXPECT_TRUE(MissionTime(300)(map, {.elapsed_s = 300}));
  EXPECT_FALSE(Measurements(16)(map, {.step = 15}));
  EXPECT_TRUE(Measurements(16)(map, {.step = 16}));
  EXPECT_FALSE(Travel(100)(map, {.travelled_m = 99.9}));
  EXPECT_TRUE(Travel(100)(map, {.travelled_m = 100}));
  EXPECT_FALSE(UtilityBelow(0.5)(map, {.best_utility = 0.5}));
  EXPECT_TRUE(UtilityBelow(0.5)(map, {.best_utility = 0.49}));
  EXPECT_FALSE(UtilityBelow(1e300)(map, Situation{}));  // not before planning
}

TEST(StopRules, CoverageAsksTheMap) {
  archetype::FullMap seen;
  Rng rng;
  EXPECT_FALSE(CoverageReached(0.5)(seen, {}));
  seen.integrate({nadir(1, 0, 1)}, rng);
  EXPECT_TRUE(CoverageReached(0.5)(seen, {}));
  EXPECT_FALSE(CoverageReached(0.51)(seen, {}));
}

TEST(StopRules, AnyOfHoldsWhenOneDoes) {
  const AnyOf any{MissionTime(300), Measurements(16), CoverageReached(1)};
  EXPECT_FALSE(any(map, {.elapsed_s = 1, .step = 1}));
  EXPECT_TRUE(any(map, {.elapsed_s = 300, .step = 1}));
  EXPECT_TRUE(any(map, {.elapsed_s = 1, .step = 16}));
  EXPECT_FALSE(AnyOf<>{}(map, {.elapsed_s = 1e9}));
  EXPECT_TRUE(AnyOf(any, Travel(1))(map, {.travelled_m = 2}));  // nested
}

TEST(StopRules, TheLeastTimeLeftCounts) {
  EXPECT_EQ(MissionTime(300).remaining_s({.elapsed_s = 100}), 200);
  EXPECT_EQ(MissionTime(300).remaining_s({.elapsed_s = 400}), 0);
  EXPECT_EQ((AnyOf{MissionTime(300), Measurements(3), MissionTime(150)}.remaining_s({.elapsed_s = 100})), 50);
  EXPECT_EQ((AnyOf{Measurements(3)}.remaining_s({.elapsed_s = 100})), infinity);
}

TEST(StopRules, RefuseBoundsThatAreNone) {
  for (const double bad : {-1.0, nan, infinity}) {
    EXPECT_THROW(MissionTime{bad}, Error);
    EXPECT_THROW(Travel{bad}, Error);
  }
  for (const double bad : {0.0, -0.1, 1.1, nan}) EXPECT_THROW(CoverageReached{bad}, Error);
  for (const double bad : {nan, infinity}) EXPECT_THROW(UtilityBelow{bad}, Error);
  EXPECT_NO_THROW(UtilityBelow{-5});
}

}  // namespace
}  // namespace vantage

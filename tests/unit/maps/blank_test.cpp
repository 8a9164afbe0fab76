// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vantage/core/bytes.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vector>

// Where a field has no values (sea, another country), a map must learn that nothing is to be had there, or a planner
// would look at it for ever.
namespace {

using namespace vantage;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

FieldImage image(const View& view, double left, double right) {
  FieldImage z{view, NadirSensor{}.footprint(view), Image<double>(20, 20)};
  z.values.leftCols(10) = left;
  z.values.rightCols(10) = right;
  return z;
}
double expected(const IntegralGp<>& map, const View& view) {
  double reduction = -1;
  map.forecast({}, std::vector<View>{view}, std::span(&reduction, 1));
  return reduction;
}
IntegralGp<> fixed_interest() { return IntegralGp<>({.tree = {.depth = 3}, .prior_mean = 0.9}); }

TEST(Blank, NothingIsExpectedWhereNothingWasSeen) {
  IntegralGp<> map = fixed_interest();
  const View view = nadir(5, 5, 5);
  Rng rng;
  ASSERT_GT(expected(map, view), 1);
  map.integrate(image(view, none, none), rng);
  EXPECT_EQ(expected(map, view), 0);
  EXPECT_DOUBLE_EQ(map.mean(map.cell_at({5, 5})), 0.9);  // and nothing was learnt about values
  EXPECT_DOUBLE_EQ(map.coverage(), 0.25);
  EXPECT_GT(expected(map, nadir(15, 15, 5)), 1);
}

TEST(Blank, HalfAnImage) {
  IntegralGp<> map = fixed_interest();
  const View view = nadir(5, 5, 5);
  Rng rng;
  map.integrate(image(view, 0.9, none), rng);
  EXPECT_FALSE(map.tree()[map.cell_at({1, 5})].blank);
  EXPECT_TRUE(map.tree()[map.cell_at({1, 5})].measured);
  EXPECT_TRUE(map.tree()[map.cell_at({9, 5})].blank);
  EXPECT_FALSE(map.tree()[map.cell_at({9, 5})].measured);
}

TEST(Blank, AValueSeenLaterCounts) {
  IntegralGp<> map = fixed_interest();
  const View view = nadir(5, 5, 5);
  Rng rng;
  map.integrate(image(view, none, none), rng);
  map.integrate(image(view, 0.9, 0.9), rng);
  EXPECT_FALSE(map.tree()[map.cell_at({5, 5})].blank);
  EXPECT_GT(expected(map, view), 0);
}

TEST(Blank, IsSavedAndLoaded) {
  IntegralGp<> map = fixed_interest(), other = fixed_interest();
  Rng rng;
  map.integrate(image(nadir(5, 5, 5), 0.9, none), rng);
  Sink sink, again;
  map.save(sink);
  Source source(sink.bytes());
  other.load(source);
  other.save(again);
  EXPECT_TRUE(std::ranges::equal(sink.bytes(), again.bytes()));
  EXPECT_EQ(expected(other, nadir(7, 5, 2)), expected(map, nadir(7, 5, 2)));
}

TEST(Blank, CellsThatDoNotExistAreRefused) {
  IntegralGp<> map = fixed_interest();
  CellMeasurements z;
  z.blank = {map.size()};
  EXPECT_THROW(map.fuse(z), Error);
}

}  // namespace

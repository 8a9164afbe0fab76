// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/utility/fisher_information.hpp>

#include <array>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/concepts/archetypes.hpp>

namespace vantage {
namespace {

/// Three parameters; a view at x informs of them by 1, x and x^2.
struct Informed : archetype::Map {
  [[nodiscard]] std::size_t parameters() const { return 3; }
  void fisher(const View& view, const Camera&, std::span<double> diagonal) const {
    const double x = view.position().x();
    diagonal[0] += 1, diagonal[1] += x, diagonal[2] += x * x;
  }
};
View at(double x) { return nadir(x, 0, 1); }

TEST(FisherInformation, IsWhatAViewAddsToThoseMeasuredAndGiven) {
  const std::vector<View> visited = {at(1), at(2)}, given = {at(3)}, views = {at(0), at(4)};
  const Informed map;
  const auto score = FisherInformation({.lambda = 0.5}).prepare(map, Situation{.visited = visited}, Rng(1));
  std::array<double, 2> out{};
  score({}, views, out);
  EXPECT_DOUBLE_EQ(out[0], 1 / 2.5);
  EXPECT_DOUBLE_EQ(out[1], 1 / 2.5 + 4 / 3.5 + 16 / 5.5);
  score(given, views, out);
  EXPECT_DOUBLE_EQ(out[1], 1 / 3.5 + 4 / 6.5 + 16 / 14.5);
}

TEST(FisherInformation, RefusesABadConfig) {
  EXPECT_THROW(FisherInformation({.lambda = 0}), Error);
  EXPECT_THROW(FisherInformation({.lambda = std::numeric_limits<double>::quiet_NaN()}), Error);
  EXPECT_THROW(FisherInformation({.camera = {}}), Error);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/policy.hpp>

#include "policies.hpp"
#include "suite.hpp"

// What a router must mean: lengths to all goals at once, and paths that are as long as it said.
namespace vantage::test {
namespace {

template <class R>
class RouterContract : public testing::Test {
 protected:
  R router = make<R>();
  archetype::FullMap map;
  View from = nadir(1, 2, 3);
  std::vector<View> goals = {nadir(1, 2, 3), nadir(4, 6, 3), nadir(-1, 2, 1), nadir(0, 0, 10)};
};
TYPED_TEST_SUITE(RouterContract, Suite<Routers>);

TYPED_TEST(RouterContract, OneLengthAGoalNoShorterThanTheStraightLine) {
  const std::vector<double> lengths_m = this->router.lengths_m(this->map, this->from, this->goals);
  ASSERT_EQ(lengths_m.size(), this->goals.size());
  for (std::size_t i = 0; i < lengths_m.size(); ++i)
    EXPECT_GE(lengths_m[i], distance_m(this->from, this->goals[i]) - 1e-9);
  EXPECT_EQ(lengths_m[0], 0);
  EXPECT_TRUE(this->router.lengths_m(this->map, this->from, {}).empty());
}

TYPED_TEST(RouterContract, PathsHaveBothEndsAndTheStatedLength) {
  const std::vector<double> lengths_m = this->router.lengths_m(this->map, this->from, this->goals);
  for (std::size_t i = 0; i < lengths_m.size(); ++i) {
    const std::vector<View> path = this->router.path(this->map, this->from, this->goals[i]);
    ASSERT_GE(path.size(), 2u);
    EXPECT_TRUE(same_place(path.front(), this->from));
    EXPECT_TRUE(same_place(path.back(), this->goals[i]));
    double length_m = 0;
    for (std::size_t k = 1; k < path.size(); ++k) length_m += distance_m(path[k - 1], path[k]);
    EXPECT_NEAR(length_m, lengths_m[i], 1e-9);
  }
}

}  // namespace
}  // namespace vantage::test

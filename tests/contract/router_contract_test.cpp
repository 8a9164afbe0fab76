// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/policy.hpp>

#include "../drawn_voxels.hpp"
#include "policies.hpp"
#include "suite.hpp"

// What a router must mean: lengths to all goals at once, and paths that are as long as it said; none where it said so.
namespace vantage::test {
namespace {

template <class R>
class RouterContract : public testing::Test {
 protected:
  R router = make<R>();
  // Free, but for a closed shell around (0, 0, 10), and a wall with a gap at its end.
  DrawnVoxels map{VoxelGrid::on_lattice({Eigen::Vector3d(-8, -8, -4), Eigen::Vector3d(8, 8, 13)}, 1), 1};
  View from = nadir(1, 2, 3);
  std::vector<View> goals = {nadir(1, 2, 3), nadir(4, 6, 3), nadir(-1, 2, 1), nadir(0, 0, 10), nadir(1.1, 2.1, 3.1)};
  RouterContract() {
    map.draw_all([&](const Eigen::Vector3i& v) {
      const Eigen::Vector3d p = map.grid().centre(v);
      const double aside = std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z() - 10)});
      const bool in_shell = aside > 1 && aside < 2;
      const bool in_wall = p.y() > 4 && p.y() < 5 && p.x() > -5;
      return in_shell || in_wall ? Space::occupied : Space::free;
    });
  }
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
    if (std::isinf(lengths_m[i])) {
      EXPECT_TRUE(path.empty());
      continue;
    }
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

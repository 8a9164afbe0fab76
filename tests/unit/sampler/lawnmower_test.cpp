// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/sampler/lattice.hpp>
#include <vantage/sampler/lawnmower.hpp>

namespace vantage {
namespace {

std::vector<View> next(const Lawnmower& lawnmower, const std::vector<View>& visited) {
  const auto scorer = [](Views, Views, std::span<double>) {};
  Rng rng;
  return lawnmower.sample(archetype::Map{}, Situation{.visited = visited}, Score(scorer), rng).views;
}

TEST(Lawnmower, SixteenViewsAsPublished) {
  const Lawnmower lawnmower({.area = Lattice::field_20m(), .height_m = 2.5});
  std::vector<View> expected;
  for (int leg = 0; leg < 4; ++leg)
    for (int i = 0; i < 4; ++i) expected.push_back(nadir(2.5 + 5 * (leg % 2 == 0 ? i : 3 - i), 2.5 + 5 * leg, 2.5));
  ASSERT_EQ(lawnmower.views().size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_TRUE(same_place(lawnmower.views()[i], expected[i])) << i;
}

TEST(Lawnmower, EightyOneViewsWithHalfTheFootprintShared) {
  for (const double side_m : {20.0, 150.0}) {
    const Box2 square(Eigen::Vector2d(-3, 7), Eigen::Vector2d(-3 + side_m, 7 + side_m));
    EXPECT_EQ(Lawnmower({.area = square, .height_m = side_m / 10, .overlap = 0.5}).views().size(), 81u);
  }
}

TEST(Lawnmower, CoversTheAreaWithTheOverlapAsked) {
  for (const double overlap : {0.0, 0.2, 0.5, 0.9})
    for (const double height_m : {0.7, 1.3, 2.5, 4.0}) {
      const Box2 area(Eigen::Vector2d(1, -2), Eigen::Vector2d(12.3, 5.1));
      const Lawnmower lawnmower({.area = area, .height_m = height_m, .overlap = overlap});
      const double footprint_m = 2 * height_m, longest_m = footprint_m * (1 - overlap) + 1e-9;
      const std::vector<View>& v = lawnmower.views();
      Box2 seen;
      for (std::size_t i = 0; i < v.size(); ++i) {
        seen.extend(NadirSensor{}.footprint(v[i]));
        EXPECT_LE(i == 0 ? 0 : distance_m(v[i], v[i - 1]), longest_m) << overlap << " " << height_m;
      }
      EXPECT_TRUE(seen.contains(Box2(area.min().array() + 1e-9, area.max().array() - 1e-9)));
    }
}

TEST(Lawnmower, StartsAtAnyCorner) {
  using Corner = Lawnmower::Corner;
  const auto first_and_last = [](Corner corner) {
    const Lawnmower l({.area = Lattice::field_20m(), .height_m = 2.5, .start = corner});
    return std::pair(l.views().front().position(), l.views().back().position());
  };
  const auto at = [](double x, double y) { return Eigen::Vector3d(x, y, 2.5); };
  EXPECT_TRUE(first_and_last(Corner::min_x_min_y).first.isApprox(at(2.5, 2.5)));
  EXPECT_TRUE(first_and_last(Corner::max_x_min_y).first.isApprox(at(17.5, 2.5)));
  EXPECT_TRUE(first_and_last(Corner::min_x_max_y).first.isApprox(at(2.5, 17.5)));
  EXPECT_TRUE(first_and_last(Corner::max_x_max_y).first.isApprox(at(17.5, 17.5)));
  EXPECT_TRUE(first_and_last(Corner::min_x_min_y).second.isApprox(at(2.5, 17.5)));
}

TEST(Lawnmower, GivesTheNextViewNotYetVisited) {
  const Lawnmower lawnmower({.area = Lattice::field_20m(), .height_m = 2.5});
  std::vector<View> visited;
  for (const View& expected : lawnmower.views()) {
    const std::vector<View> c = next(lawnmower, visited);
    ASSERT_EQ(c.size(), 1u);
    EXPECT_TRUE(same_place(c[0], expected));
    View arrived = c[0];
    arrived.T_W_C.translation() += Eigen::Vector3d(0.4, -0.5, 0.3);  // not quite there
    visited.push_back(arrived);
  }
  EXPECT_TRUE(next(lawnmower, visited).empty());
  std::swap(visited[3], visited[7]);
  visited.erase(visited.begin() + 5);  // goes back for what was missed
  EXPECT_TRUE(same_place(next(lawnmower, visited).at(0), lawnmower.views()[5]));
}

TEST(Lawnmower, OneViewSeesASmallArea) {
  const Box2 small(Eigen::Vector2d(1, 1), Eigen::Vector2d(2, 3));
  const Lawnmower l({.area = small, .height_m = 2.5});
  ASSERT_EQ(l.views().size(), 1u);
  EXPECT_TRUE(same_place(l.views()[0], nadir(1.5, 2, 2.5)));
}

TEST(Lawnmower, RefusesBadConfigs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Box2 area = Lattice::field_20m();
  EXPECT_THROW(Lawnmower({.area = Box2()}), Error);
  EXPECT_THROW(Lawnmower({.area = Box2(Eigen::Vector2d(0, nan), Eigen::Vector2d(1, 1))}), Error);
  EXPECT_THROW(Lawnmower({.area = area, .height_m = 0}), Error);
  EXPECT_THROW(Lawnmower({.area = area, .half_angle_rad = 1.6}), Error);
  EXPECT_THROW(Lawnmower({.area = area, .overlap = 1}), Error);
  EXPECT_THROW(Lawnmower({.area = area, .overlap = -0.1}), Error);
  EXPECT_THROW(Lawnmower({.area = area, .reached = 0.5}), Error);
  EXPECT_THROW(Lawnmower({.area = area, .height_m = 1e-3}), Error);   // 10^8 views
  EXPECT_THROW(Lawnmower({.area = area, .height_m = 1e-30}), Error);  // more than can be counted
}

}  // namespace
}  // namespace vantage

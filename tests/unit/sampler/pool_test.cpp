// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/sampler/pool.hpp>

namespace vantage {
namespace {

std::vector<View> sample(const Pool& pool, const std::vector<View>& visited) {
  const auto scorer = [](Views, Views, std::span<double>) {};
  Rng rng;
  return pool.sample(archetype::Map{}, Situation{.visited = visited}, Score(scorer), rng).views;
}

TEST(Pool, LeavesOutWhatWasVisited) {
  const std::vector<View> views = {nadir(0, 0, 1), nadir(1, 0, 1), look_at({0, 0, 1}, {1, 0, 0}), nadir(2, 0, 1)};
  const Pool pool(views);
  EXPECT_EQ(sample(pool, {}).size(), 4u);
  const std::vector<View> rest = sample(pool, {nadir(0, 0, 1), nadir(2, 0, 1)});
  ASSERT_EQ(rest.size(), 2u);  // the same place seen in another direction stays
  EXPECT_TRUE(same_place(rest[0], views[1]));
  EXPECT_TRUE(rest[1].T_W_C.isApprox(views[2].T_W_C));
  EXPECT_TRUE(sample(pool, views).empty());
}

TEST(Pool, RefusesBadViews) {
  View bad = nadir(0, 0, 1);
  bad.T_W_C.linear() *= 2;
  EXPECT_THROW(Pool({nadir(0, 0, 1), bad}), Error);
  EXPECT_NO_THROW(Pool({}));
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/maps/field/nd_tree.hpp>

#include <gtest/gtest.h>

#include <set>

#include <vantage/core/rng.hpp>

namespace {

using namespace vantage;

NdTree::Config config(int branching, int depth) {
  NdTree::Config c;
  c.area = Box2(Eigen::Vector2d(-3, 2), Eigen::Vector2d(9, 11));
  c.branching = branching;
  c.depth = depth;
  return c;
}

// Merges the leaves of the cell (level, ix, iy), if they stand together.
Merge merge_into(const NdTree& tree, const Box2& cell) {
  Merge m;
  for (std::size_t i = 0; i < tree.size();) {
    std::size_t last = i + 1;
    while (cell.contains(tree.box(i).center()) && last < tree.size() && cell.contains(tree.box(last).center())) ++last;
    m.groups.push_back({i, last});
    i = last;
  }
  m.weight.assign(tree.size(), 1);
  return m;
}

void expect_tiling(const NdTree& tree) {
  double sum = 0, share = 0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    sum += area(tree.box(i));
    share += tree.share(i);
    EXPECT_EQ(tree.leaf_at(tree.box(i).center()), i);
  }
  EXPECT_NEAR(sum, area(tree.config().area), 1e-9);
  EXPECT_NEAR(share, 1, 1e-12);
}

TEST(NdTree, TilesTheAreaForAnyBranching) {
  for (const auto& [branching, depth] : {std::pair{2, 0}, {2, 5}, {3, 3}, {5, 2}, {16, 1}}) {
    const NdTree tree(config(branching, depth));
    EXPECT_EQ(tree.size(), static_cast<std::size_t>(std::pow(branching * branching, depth)));
    expect_tiling(tree);
  }
}

TEST(NdTree, MergesChildrenIntoTheirParentAndCascades) {
  NdTree tree(config(2, 3));
  const Box2 quarter(Eigen::Vector2d(3, 2), Eigen::Vector2d(9, 6.5));
  const Merge m = merge_into(tree, quarter);
  tree.merge(m);
  EXPECT_EQ(tree.size(), 64u - 16u + 1u);
  expect_tiling(tree);
  const std::size_t i = tree.leaf_at(Eigen::Vector2d(4, 3));
  EXPECT_EQ(tree[i].level, 1);
  EXPECT_TRUE(tree.box(i).isApprox(quarter));
}

TEST(NdTree, FindsWhatABoxOverlaps) {
  NdTree tree(config(2, 4));
  tree.merge(merge_into(tree, Box2(Eigen::Vector2d(-3, 6.5), Eigen::Vector2d(3, 11))));
  Rng rng(3);
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::Vector2d a(rng.uniform(-5, 11), rng.uniform(0, 13)), b(rng.uniform(-5, 11), rng.uniform(0, 13));
    const Box2 box(a.cwiseMin(b), a.cwiseMax(b));
    std::multiset<std::size_t> got;
    tree.for_each_overlapping(box, [&](std::size_t i) { got.insert(i); });
    std::multiset<std::size_t> expected;
    for (std::size_t i = 0; i < tree.size(); ++i)
      if (((tree.box(i).intersection(box)).sizes().array() > 1e-3).all()) expected.insert(i);
    for (const std::size_t i : expected) EXPECT_EQ(got.count(i), 1u);
    for (const std::size_t i : got) EXPECT_TRUE(tree.box(i).intersects(box)) << i;
  }
}

TEST(NdTree, SavesAndLoads) {
  NdTree tree(config(3, 2));
  tree.merge(merge_into(tree, Box2(Eigen::Vector2d(-3, 2), Eigen::Vector2d(1, 5))));
  tree.mark_measured(2);
  Sink sink;
  tree.save(sink);
  NdTree other(config(3, 2));
  Source source(sink.bytes());
  other.load(source);
  source.done();
  ASSERT_EQ(other.size(), tree.size());
  for (std::size_t i = 0; i < tree.size(); ++i) {
    EXPECT_TRUE(other.box(i).isApprox(tree.box(i)));
    EXPECT_EQ(other[i].measured, tree[i].measured);
  }
}

TEST(NdTree, RefusesTreesThatAreNone) {
  const NdTree tree(config(2, 2));
  Sink sink;
  tree.save(sink);
  const std::vector<std::byte> good(sink.bytes().begin(), sink.bytes().end());
  for (std::size_t byte = 0; byte < good.size(); ++byte) {
    auto bad = good;
    bad[byte] ^= std::byte{0x41};
    NdTree other(config(2, 2));
    Source source(bad);
    try {
      other.load(source);
      expect_tiling(other);  // only a "measured" flag may change without harm
    } catch (const Error&) { EXPECT_EQ(other.size(), 16u); }
  }
  for (std::size_t size = 0; size < good.size(); ++size) {
    NdTree other(config(2, 2));
    Source source(std::span<const std::byte>(good).first(size));
    EXPECT_THROW(other.load(source), Error);
  }
}

TEST(NdTree, NamesEveryBadValue) {
  NdTree::Config c = config(1, 20);
  c.area = Box2(Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 1));
  try {
    const NdTree tree(c);
    FAIL();
  } catch (const Error& e) {
    const std::string what = e.what();
    for (const char* name : {"area", "branching", "depth"}) EXPECT_NE(what.find(name), std::string::npos) << what;
  }
  const NdTree tree(config(2, 3));
  EXPECT_THROW(static_cast<void>(tree.leaf_at(Eigen::Vector2d(100, 0))), Error);
  EXPECT_THROW(static_cast<void>(tree.leaf_at(Eigen::Vector2d(std::nan(""), 3))), Error);
}

}  // namespace

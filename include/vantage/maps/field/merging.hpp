// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <vector>

#include <vantage/maps/field/interest.hpp>
#include <vantage/maps/field/nd_tree.hpp>

namespace vantage {

/// Fixed resolution; the interest is for planning and metrics only.
template <Interest I = Above<>>
struct Fixed {
  static constexpr std::string_view name = "fixed";
  using InterestType = I;
  I interest = {};

  template <class Belief>
  [[nodiscard]] bool plan(const NdTree&, const Belief&, Merge&) const { return false; }
};

/// Adaptive resolution (section 3.1.5): a parent replaces its P children where all are uninteresting leaves (eq. 3.8),
/// from the deepest level up, cascading in one pass. MeasuredOnly <reference>: only leaves that were measured merge.
template <Interest I = Above<>, bool MeasuredOnly = false>
struct Merging {
  static constexpr std::string_view name = MeasuredOnly ? "merging_measured" : "merging";
  using InterestType = I;
  I interest = {};

  /// Fills `merge` and returns whether there is anything to merge. One pass with a stack over the depth-first leaves:
  /// O(n), and for each merged parent the variance of its average.
  template <class Belief>
  [[nodiscard]] bool plan(const NdTree& tree, const Belief& belief, Merge& merge) const {
    struct Node {
      int level, ix, iy;
      std::size_t first, last;
      double mean;
      bool dull;
    };
    const auto n = static_cast<double>(tree.config().branching);
    const std::size_t p = tree.children();
    std::vector<Node> stack;
    std::vector<double> weight(tree.size(), 1.0);
    bool any = false;
    for (std::size_t i = 0; i < tree.size(); ++i) {
      const NdTree::Leaf& c = tree[i];
      const double mean = belief.mean(i);
      stack.push_back({c.level, c.ix, c.iy, i, i + 1, mean,
                       (!MeasuredOnly || c.measured) && !interest.interesting(mean, belief.variance(i))});
      while (stack.size() >= p) {
        const auto children = stack.end() - static_cast<std::ptrdiff_t>(p);
        const Node& a = stack.back();
        const int bx = a.ix / tree.config().branching, by = a.iy / tree.config().branching;
        if (a.level == 0 || !std::all_of(children, stack.end(), [&](const Node& b) {
              return b.dull && b.level == a.level && b.ix / tree.config().branching == bx &&
                     b.iy / tree.config().branching == by;
            }))
          break;
        Node parent{a.level - 1, bx, by, children->first, a.last, 0, false};
        for (auto b = children; b != stack.end(); ++b) parent.mean += b->mean / (n * n);
        for (std::size_t j = parent.first; j < parent.last; ++j) weight[j] /= n * n;
        parent.dull = !interest.interesting(
            parent.mean, belief.average_variance({parent.first, parent.last}, weight));
        stack.erase(children, stack.end());
        stack.push_back(parent);
        any = true;
      }
    }
    if (!any) return false;
    merge.groups.clear();
    for (const Node& node : stack) merge.groups.push_back({node.first, node.last});
    merge.weight = std::move(weight);
    return true;
  }
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <utility>
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
  [[nodiscard]] bool plan(const NdTree&, const Belief&, Merge&) const {
    return false;
  }
};

/// Adaptive resolution (section 3.1.5): a parent replaces its P children where all are uninteresting leaves (eq. 3.8),
/// from the deepest level up, cascading in one pass. MeasuredOnly <reference>: only leaves that were measured merge.
template <Interest I = Above<>, bool MeasuredOnly = false>
struct Merging {
  static constexpr std::string_view name = MeasuredOnly ? "merging_measured" : "merging";
  using InterestType = I;
  I interest = {};

  /// Fills `merge` and returns whether there is anything to merge. Level by level, so that a belief may compute the
  /// variances of all of a level's new parents at once. O(n) a level.
  template <class Belief>
  [[nodiscard]] bool plan(const NdTree& tree, const Belief& belief, Merge& merge) const {
    struct Node {
      NdTree::Leaf cell;
      LeafGroup leaves;
      double mean;
      bool dull;
    };
    const int branching = tree.config().branching;
    const std::size_t p = tree.children();
    const double share = 1 / static_cast<double>(p);
    const auto dull = [&](const NdTree::Leaf& c, double mean, double variance) {
      return (!MeasuredOnly || c.measured) && !interest.interesting(mean, variance);
    };
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < tree.size(); ++i)
      nodes.push_back({tree[i], {i, i + 1}, belief.mean(i), dull(tree[i], belief.mean(i), belief.variance(i))});
    std::vector<double> weight(tree.size(), 1.0);
    std::vector<ParentCell> parents;
    std::vector<Node> next;
    for (int level = tree.config().depth; level > 0; --level) {
      parents.clear();
      next.clear();
      for (std::size_t k = 0; k < nodes.size();) {  // children stand together: P of this level from a first child on
        const NdTree::Leaf& c = nodes[k].cell;
        const auto is_sibling = [&](const Node& b) { return b.dull && b.cell.level == level; };
        if (c.level != level || c.ix % branching != 0 || c.iy % branching != 0 || k + p > nodes.size() ||
            !std::all_of(nodes.begin() + static_cast<std::ptrdiff_t>(k),
                         nodes.begin() + static_cast<std::ptrdiff_t>(k + p), is_sibling)) {
          next.push_back(nodes[k++]);
          continue;
        }
        Node parent{{level - 1, c.ix / branching, c.iy / branching, true},
                    {nodes[k].leaves.first, nodes[k + p - 1].leaves.last},
                    0,
                    true};
        for (const std::size_t end = k + p; k < end; ++k) {
          parent.mean += share * nodes[k].mean;
          parent.cell.measured = parent.cell.measured && nodes[k].cell.measured;
        }
        for (std::size_t i = parent.leaves.first; i < parent.leaves.last; ++i) weight[i] *= share;
        parents.push_back({parent.cell, parent.leaves});
        next.push_back(parent);
      }
      if (parents.empty()) continue;
      const std::vector<double> variance = belief.parent_variances(parents, weight);
      std::size_t made = 0;
      for (Node& node : next)
        if (made < parents.size() && node.leaves.first == parents[made].leaves.first)
          node.dull = dull(node.cell, node.mean, variance[made++]);
      std::swap(nodes, next);
    }
    if (nodes.size() == tree.size()) return false;
    merge.groups.clear();
    for (const Node& node : nodes) merge.groups.push_back(node.leaves);
    merge.weight = std::move(weight);
    return true;
  }
};

}  // namespace vantage

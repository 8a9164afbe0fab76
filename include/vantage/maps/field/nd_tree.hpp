// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/maps/field/kernel.hpp>

namespace vantage {

/// Leaves [first, last) of a tree that become one.
struct LeafGroup {
  std::size_t first = 0, last = 0;
};

/// A merging of leaves as the matrix M of eq. 3.12: one group a new leaf, in order, and each old leaf's weight, its
/// share of the new leaf's area.
struct Merge {
  std::vector<LeafGroup> groups;
  std::vector<double> weight;
};

/// Nd-tree (Einhorn et al. 2011) over a rectangle, d = 2, N branches an axis, kept as its leaves in depth-first order:
/// the children of a parent stand together, so that a merge replaces a run of leaves by one. Const members are
/// thread-safe.
class NdTree {
 public:
  struct Config {
    Box2 area{Eigen::Vector2d(0, 0), Eigen::Vector2d(20, 20)};  ///< world [m]
    int branching = 2;                                          ///< N, 2 to 16
    int depth = 5;                                              ///< t, 0 to 12; N^t <= 4096 cells an axis
  };
  struct Leaf {
    std::int32_t level = 0, ix = 0, iy = 0;  ///< column and row among the cells of its level
    bool measured = false;
    bool blank = false;  ///< last seen without any value
  };

  /// All leaves at the full depth. Throws Error on a bad config.
  explicit NdTree(const Config& config) : config_(config) {
    Check check("NdTree::Config");
    const Box2& a = config.area;
    check(is_proper(a), "area", concat(a.min().transpose(), " to ", a.max().transpose()),
          "finite, of positive width and height");
    check(config.branching >= 2 && config.branching <= 16, "branching", config.branching, "2 to 16");
    check(config.depth >= 0 && config.depth <= 12, "depth", config.depth, "0 to 12");
    check(std::pow(config.branching, config.depth) <= 4096, "branching^depth", std::pow(config.branching, config.depth),
          "at most 4096 cells an axis");
    check.done();
    side_.push_back(1);
    for (int k = 0; k < config.depth; ++k) side_.push_back(side_.back() * config.branching);
    leaves_.reserve(static_cast<std::size_t>(resolution()) * static_cast<std::size_t>(resolution()));
    split({});
    index_leaves();
  }

  [[nodiscard]] const Config& config() const { return config_; }
  [[nodiscard]] std::size_t size() const { return leaves_.size(); }
  [[nodiscard]] const Leaf& operator[](std::size_t i) const { return leaves_[i]; }
  /// Cells along an axis at the full depth, and at a level.
  [[nodiscard]] int resolution() const { return side_.back(); }
  [[nodiscard]] int side(int level) const { return side_[static_cast<std::size_t>(level)]; }
  /// P = N^d.
  [[nodiscard]] std::size_t children() const {
    return static_cast<std::size_t>(config_.branching) * static_cast<std::size_t>(config_.branching);
  }
  [[nodiscard]] Interval x_interval(int level, int ix) const { return interval(0, level, ix); }
  [[nodiscard]] Interval y_interval(int level, int iy) const { return interval(1, level, iy); }
  [[nodiscard]] Box2 box(std::size_t i) const {
    const Leaf& c = leaves_[i];
    const Interval x = x_interval(c.level, c.ix), y = y_interval(c.level, c.iy);
    return {Eigen::Vector2d(x.low, y.low), Eigen::Vector2d(x.high, y.high)};
  }
  /// Share of the whole area.
  [[nodiscard]] double share(std::size_t i) const {
    const double n = side(leaves_[i].level);
    return 1 / (n * n);
  }
  /// Share of the area in leaves that were seen, with a value or without.
  [[nodiscard]] double coverage() const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += leaves_[i].measured || leaves_[i].blank ? share(i) : 0;
    return sum;
  }
  void mark_measured(std::size_t i) {
    leaves_[i].measured = true;
    leaves_[i].blank = false;
  }
  void mark_blank(std::size_t i) { leaves_[i].blank = true; }

  /// The leaf that holds a point [m]. O(1). Throws Error outside the area.
  [[nodiscard]] std::size_t leaf_at(const Eigen::Vector2d& p) const {
    if (!config_.area.contains(p))
      throw Error("NdTree::leaf_at", concat("point ", p.transpose(), " lies outside"),
                  concat(config_.area.min().transpose(), " to ", config_.area.max().transpose()));
    return leaf_of_cell(fine(0, p.x()), fine(1, p.y()));
  }
  /// The leaf that holds a cell of the full depth.
  [[nodiscard]] std::size_t leaf_of_cell(int ix, int iy) const { return static_cast<std::size_t>(index_(iy, ix)); }

  /// Calls f(leaf) once for each leaf that overlaps `box` by more than 1e-4 of a finest cell, in no particular order.
  template <class F>
  void for_each_overlapping(const Box2& box, F&& f) const {
    const Eigen::Vector2d slack = 1e-4 * config_.area.sizes() / resolution();
    const Eigen::Vector2d low = (box.min() + slack).cwiseMax(config_.area.min());
    const Eigen::Vector2d high = (box.max() - slack).cwiseMin(config_.area.max());
    if (low.x() >= high.x() || low.y() >= high.y()) return;
    const int x0 = fine(0, low.x()), x1 = fine(0, high.x()), y0 = fine(1, low.y()), y1 = fine(1, high.y());
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1;) {
        const std::size_t i = leaf_of_cell(x, y);
        const Leaf& c = leaves_[i];
        const int width = resolution() / side(c.level);
        if (y == std::max(y0, c.iy * width)) f(i);
        x = (c.ix + 1) * width;
      }
  }

  /// The cell that a group of leaves makes up.
  [[nodiscard]] Leaf parent_of(const LeafGroup& g) const {
    Leaf a = leaves_[g.first], b = leaves_[g.last - 1];
    const auto up = [&](Leaf& c) {
      c.ix /= config_.branching;
      c.iy /= config_.branching;
      --c.level;
    };
    while (a.level != b.level || a.ix != b.ix || a.iy != b.iy) {
      const int deeper = std::max(a.level, b.level);
      if (a.level == deeper) up(a);
      if (b.level == deeper) up(b);
    }
    for (std::size_t i = g.first; i < g.last; ++i) {
      a.measured = a.measured && leaves_[i].measured;
      a.blank = a.blank && leaves_[i].blank;
    }
    return a;
  }
  /// Replaces each group of leaves by the cell that they make up.
  void merge(const Merge& m) {
    std::vector<Leaf> merged;
    merged.reserve(m.groups.size());
    for (const LeafGroup& g : m.groups) merged.push_back(parent_of(g));
    leaves_ = std::move(merged);
    index_leaves();
  }

  [[nodiscard]] std::size_t bytes() const {
    return leaves_.capacity() * sizeof(Leaf) + static_cast<std::size_t>(index_.size()) * sizeof(std::int32_t);
  }

  void save(Sink& sink) const {
    sink.put(static_cast<std::uint64_t>(size()));
    for (const Leaf& c : leaves_) {
      sink.put(c.level);
      sink.put(c.ix);
      sink.put(c.iy);
      sink.put(c.measured);
      sink.put(c.blank);
    }
  }
  /// For a tree of the same config. Throws Error unless the leaves tile the area in depth-first order.
  void load(Source& source) {
    const auto n = source.get<std::uint64_t>();
    if (n == 0 || n > static_cast<std::uint64_t>(resolution()) * static_cast<std::uint64_t>(resolution()))
      throw Error(source.where(), concat(n, " leaves"), concat("1 to ", resolution(), "^2"));
    std::vector<Leaf> leaves;
    std::uint64_t next = 0;  // the finest cell, in depth-first order, at which the next leaf must begin
    for (std::uint64_t i = 0; i < n; ++i) {
      Leaf c;
      source.get(c.level);
      source.get(c.ix);
      source.get(c.iy);
      c.measured = source.get<std::uint8_t>() != 0;
      c.blank = source.get<std::uint8_t>() != 0;
      if (c.level < 0 || c.level > config_.depth || c.ix < 0 || c.iy < 0 || c.ix >= side(c.level) ||
          c.iy >= side(c.level) || first_cell(c) != next)
        throw Error(source.where(), concat("leaf ", i, " is out of place"), "leaves that tile the area in order");
      const auto width = static_cast<std::uint64_t>(resolution() / side(c.level));
      next += width * width;
      leaves.push_back(c);
    }
    if (next != static_cast<std::uint64_t>(resolution()) * static_cast<std::uint64_t>(resolution()))
      throw Error(source.where(), "the leaves do not cover the area", "a whole tree");
    leaves_ = std::move(leaves);
    index_leaves();
  }

 private:
  void split(const Leaf& node) {
    if (node.level == config_.depth) {
      leaves_.push_back(node);
      return;
    }
    for (int y = 0; y < config_.branching; ++y)
      for (int x = 0; x < config_.branching; ++x)
        split({node.level + 1, node.ix * config_.branching + x, node.iy * config_.branching + y});
  }
  void index_leaves() {
    index_.resize(resolution(), resolution());
    for (std::size_t i = 0; i < size(); ++i) {
      const Leaf& c = leaves_[i];
      const int width = resolution() / side(c.level);
      index_.block(c.iy * width, c.ix * width, width, width) = static_cast<std::int32_t>(i);
    }
  }
  // Number of finest cells before this leaf in depth-first order.
  [[nodiscard]] std::uint64_t first_cell(const Leaf& c) const {
    std::uint64_t before = 0;
    int x = c.ix, y = c.iy;
    for (int level = c.level; level > 0; --level) {
      const auto width = static_cast<std::uint64_t>(resolution() / side(level));
      const int child = (y % config_.branching) * config_.branching + x % config_.branching;
      before += static_cast<std::uint64_t>(child) * width * width;
      x /= config_.branching;
      y /= config_.branching;
    }
    return before;
  }
  [[nodiscard]] Interval interval(int axis, int level, int i) const {
    const double low = config_.area.min()[axis], width = config_.area.sizes()[axis], n = side(level);
    return {low + width * i / n, low + width * (i + 1) / n};
  }
  [[nodiscard]] int fine(int axis, double at) const {
    const double t = (at - config_.area.min()[axis]) / config_.area.sizes()[axis];
    return std::clamp(static_cast<int>(t * resolution()), 0, resolution() - 1);
  }

  Config config_;
  std::vector<int> side_;  // N^level
  std::vector<Leaf> leaves_;
  Image<std::int32_t> index_;  // finest cell -> leaf
};

/// A parent that could replace a group of leaves.
struct ParentCell {
  NdTree::Leaf cell;
  LeafGroup leaves;
};

}  // namespace vantage

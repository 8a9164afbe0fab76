// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <vector>

#include <vantage/core/dense.hpp>
#include <vantage/core/error.hpp>
#include <vantage/maps/field/nd_tree.hpp>
#include <vantage/maps/field/prior.hpp>

namespace vantage {

/// The prior covariance of any two cells of a tree, whatever their levels: what Prior is for the cells of the full
/// depth. Two tables, one an axis, over the intervals of all levels (2 N - 1 of them for N cells an axis and 2
/// branches), so that a covariance is a product of two looked-up numbers. Immutable; thread-safe.
class NodePrior {
 public:
  /// Throws Error for trees of more than 1024 cells an axis, whose tables would be too large.
  NodePrior(const NdTree& tree, const Prior& prior) : variance_(prior.variance) {
    if (tree.resolution() > 1024)
      throw Error("NodePrior", concat(tree.resolution(), " cells an axis"), "at most 1024, for beliefs by regression");
    int first = 0;
    for (int level = 0; level <= tree.config().depth; ++level) {
      first_.push_back(first);
      first += tree.side(level);
    }
    x_ = table(tree, prior, first, [&](int level, int i) { return tree.x_interval(level, i); });
    y_ = table(tree, prior, first, [&](int level, int i) { return tree.y_interval(level, i); });
  }

  [[nodiscard]] double operator()(const NdTree::Leaf& a, const NdTree::Leaf& b) const {
    return variance_ * x_(x(a), x(b)) * y_(y(a), y(b));
  }

  /// K[rows, columns].
  [[nodiscard]] Eigen::MatrixXd covariance(std::span<const NdTree::Leaf> rows,
                                           std::span<const NdTree::Leaf> columns) const {
    Eigen::MatrixXd k(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
    dense::for_tiles(
        k.cols(),
        [&](Eigen::Index begin, Eigen::Index count) {
          for (Eigen::Index j = begin; j < begin + count; ++j)
            column(rows, columns[static_cast<std::size_t>(j)], 0, k.col(j).data());
        },
        32);
    return k;
  }
  /// The lower triangle of K[cells, cells]; above it, nothing is said.
  [[nodiscard]] Eigen::MatrixXd covariance(std::span<const NdTree::Leaf> cells) const {
    const auto n = static_cast<Eigen::Index>(cells.size());
    Eigen::MatrixXd k(n, n);
    dense::for_tiles(
        n,
        [&](Eigen::Index begin, Eigen::Index count) {
          for (Eigen::Index j = begin; j < begin + count; ++j)
            column(cells, cells[static_cast<std::size_t>(j)], static_cast<std::size_t>(j), k.col(j).data());
        },
        32);
    return k;
  }

  [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(x_.size() + y_.size()) * sizeof(double); }

 private:
  [[nodiscard]] int x(const NdTree::Leaf& c) const { return first_[static_cast<std::size_t>(c.level)] + c.ix; }
  [[nodiscard]] int y(const NdTree::Leaf& c) const { return first_[static_cast<std::size_t>(c.level)] + c.iy; }
  void column(std::span<const NdTree::Leaf> rows, const NdTree::Leaf& b, std::size_t from, double* out) const {
    const double *kx = x_.col(x(b)).data(), *ky = y_.col(y(b)).data();
    for (std::size_t i = from; i < rows.size(); ++i) out[i] = variance_ * kx[x(rows[i])] * ky[y(rows[i])];
  }

  // A stationary kernel sees only the distance of two intervals' centres, counted in half cells of the full depth: each
  // pair of levels needs as many averages as the finer one has intervals.
  template <class IntervalOf>
  static Eigen::MatrixXd table(const NdTree& tree, const Prior& prior, int size, IntervalOf&& interval) {
    const int n = tree.resolution(), depth = tree.config().depth;
    Eigen::MatrixXd k(size, size);
    std::vector<double> at(2 * static_cast<std::size_t>(n));
    int coarse_first = 0;
    for (int coarse = 0; coarse <= depth; coarse_first += tree.side(coarse++)) {
      int fine_first = coarse_first;
      for (int fine = coarse; fine <= depth; fine_first += tree.side(fine++)) {
        const int a = n / tree.side(coarse), b = n / tree.side(fine);
        const auto distance = [&](int i, int j) {
          return static_cast<std::size_t>(std::abs((2 * i + 1) * a - (2 * j + 1) * b));
        };
        for (int j = tree.side(fine) - 1; j >= 0; --j) {
          const double c = prior.correlation(interval(coarse, 0), interval(fine, j));
          at[distance(0, j)] = std::abs(c) < 1e-100 ? 0 : c;  // denormal products slow every later factorisation
        }
        for (int j = 0; j < tree.side(fine); ++j)
          for (int i = 0; i < tree.side(coarse); ++i) {
            k(coarse_first + i, fine_first + j) = at[distance(i, j)];
            k(fine_first + j, coarse_first + i) = at[distance(i, j)];
          }
      }
    }
    return k;
  }

  double variance_;
  std::vector<int> first_;  // of each level's intervals
  Eigen::MatrixXd x_, y_;
};

}  // namespace vantage

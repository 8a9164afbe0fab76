// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/dense.hpp>
#include <vantage/core/large_matrix.hpp>
#include <vantage/maps/field/cell_sensor.hpp>
#include <vantage/maps/field/nd_tree.hpp>
#include <vantage/maps/field/prior.hpp>

namespace vantage {

namespace detail {

/// K[cells, cells] with `diagonal` added, lower triangle only; cells ascend.
template <class T>
dense::Matrix<T> gather(const LargeMatrix<T>& k, std::span<const std::size_t> cells, const Eigen::VectorXd* diagonal) {
  const auto l = static_cast<Eigen::Index>(cells.size());
  dense::Matrix<T> s(l, l);
  for (Eigen::Index b = 0; b < l; ++b) {
    const T* column = k.col(static_cast<Eigen::Index>(cells[static_cast<std::size_t>(b)]));
    for (Eigen::Index a = b; a < l; ++a) s(a, b) = column[cells[static_cast<std::size_t>(a)]];
  }
  if (diagonal) s.diagonal() += diagonal->template cast<T>();
  return s;
}

/// tr(S^-1 M) for symmetric matrices in their lower triangles; S is destroyed. On one thread, l^3 flops: a third each
/// for S = L L^T, for X = L^-1, and for the lower triangle of S^-1 = X^T X, tile by tile against M.
template <class T>
double trace_of_quotient(dense::Matrix<T>& s, const dense::Matrix<T>& m) {
  constexpr Eigen::Index size = 64;
  const Eigen::Index l = s.rows();
  dense::cholesky<T>(s, "forecast");
  const dense::Matrix<T> x = dense::inverse_lower<T>(s, size);
  dense::Matrix<T> tile;
  double trace = 0;
  for (Eigen::Index j = 0; j < l; j += size)
    for (Eigen::Index i = j; i < l; i += size) {
      const Eigen::Index ni = std::min(size, l - i), nj = std::min(size, l - j);
      tile.setZero(ni, nj);
      dense::add_tn<T>(tile, x.block(i, i, l - i, ni), x.block(i, j, l - i, nj), T(1));
      for (Eigen::Index c = 0; c < nj; ++c) {
        const Eigen::Index from = i == j ? c : 0;  // the lower triangle; what lies off the diagonal counts twice
        trace += 2 * static_cast<double>(tile.col(c).tail(ni - from).dot(m.col(j + c).segment(i + from, ni - from)));
        if (i == j) trace -= static_cast<double>(tile(c, c) * m(j + c, j + c));
      }
    }
  return trace;
}

}  // namespace detail

/// The full posterior: mean vector and covariance matrix, Kalman updates (eqs. 3.6, 3.7), merging (eqs. 3.9, 3.10). The
/// lower triangle of an n x n matrix: 8 n^2 bytes in double. One update of l cells: n^2 l + n l^2 + l^3 / 3 flops.
///
/// An update stays pending as K - W W^T until `settle`, so that cells which merge are merged in K and in W first, and
/// the rank-l update runs on the smaller matrix.
template <class T = double>
class Full {
 public:
  static constexpr std::string_view name = sizeof(T) == 8 ? "full" : "full_f32";
  struct Config {};

  Full(const Config&, const NdTree& tree, const Prior& prior)
      : mean_(Eigen::VectorXd::Constant(static_cast<Index>(tree.size()), prior.mean)), k_(mean_.size(), mean_.size()) {
    // A column of the Kronecker product is the product of a column of Kx and one of Ky, each spread over the leaves.
    const Index n = mean_.size(), side = tree.resolution();
    dense::Matrix<T> x(n, side), y(n, side);
    dense::for_tiles(
        side,
        [&](Index begin, Index count) {
          for (Index c = begin; c < begin + count; ++c)
            for (Index i = 0; i < n; ++i) {
              const NdTree::Leaf& leaf = tree[static_cast<std::size_t>(i)];
              x(i, c) = static_cast<T>(prior.variance * prior.kx(leaf.ix, c));
              y(i, c) = static_cast<T>(prior.ky(leaf.iy, c));
            }
        },
        4);
    dense::for_tiles(
        n,
        [&](Index begin, Index count) {
          for (Index j = begin; j < begin + count; ++j) {
            const NdTree::Leaf& leaf = tree[static_cast<std::size_t>(j)];
            k_.map().col(j).tail(n - j) = x.col(leaf.ix).tail(n - j).cwiseProduct(y.col(leaf.iy).tail(n - j));
          }
        },
        32);
    variance_ = k_.map().diagonal().template cast<double>();
  }

  [[nodiscard]] double mean(std::size_t i) const { return mean_[static_cast<Index>(i)]; }
  [[nodiscard]] double variance(std::size_t i) const { return variance_[static_cast<Index>(i)]; }
  /// Posterior covariance of two cells.
  [[nodiscard]] double covariance(std::size_t i, std::size_t j) const {
    return static_cast<double>(k_(static_cast<Index>(std::max(i, j)), static_cast<Index>(std::min(i, j))));
  }
  /// q K q^T for the weighted average over each parent's leaves.
  [[nodiscard]] std::vector<double> parent_variances(std::span<const ParentCell> parents,
                                                     std::span<const double> weight) const {
    std::vector<double> out(parents.size());
    parallel_for_blocks(parents.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const LeafGroup& g = parents[k].leaves;
        out[k] = settled_average_variance(g, weight);
        if (w_.cols() == 0) continue;
        Eigen::VectorX<T> wq = Eigen::VectorX<T>::Zero(w_.rows());
        for (std::size_t i = g.first; i < g.last; ++i) wq += static_cast<T>(weight[i]) * w_.col(static_cast<Index>(i));
        out[k] -= static_cast<double>(wq.squaredNorm());
      }
    });
    return out;
  }

  /// Folds measurements in. Throws Error, changing nothing, if S = H K H^T + R is not positive definite.
  void fuse(const NdTree&, const CellMeasurements& z) {
    dense::Matrix<T> s = detail::gather(k_, z.cells, &z.noise_variance);
    dense::cholesky<T>(s, "Full::fuse");
    dense::Matrix<T> w = rows(k_, z.cells);  // H K-
    dense::solve_lower<T>(s, w);             // W^T = L^-1 H K-, so that K+ = K- - W W^T
    dense::Matrix<T> g(static_cast<Index>(z.cells.size()), 1);
    for (std::size_t a = 0; a < z.cells.size(); ++a)
      g(static_cast<Index>(a), 0) = static_cast<T>(z.value[static_cast<Index>(a)] - mean(z.cells[a]));
    dense::solve_lower_serial<T>(s, g);
    dense::for_tiles(w.cols(), [&](Index begin, Index count) {
      for (Index i = begin; i < begin + count; ++i) {
        mean_[i] += static_cast<double>(w.col(i).dot(g.col(0)));
        variance_[i] -= static_cast<double>(w.col(i).squaredNorm());
      }
    });
    w_ = std::move(w);
  }

  /// M mu, M K M^T (eqs. 3.9, 3.10) and M W, in place: a new cell never stands behind its first part.
  void merge(const NdTree&, const Merge& m) {
    const std::size_t groups = m.groups.size();
    const auto n = static_cast<Index>(groups);
    std::vector<T> diagonal(groups);
    std::vector<std::size_t> group_of(static_cast<std::size_t>(k_.cols()));
    for (std::size_t g = 0; g < groups; ++g) {
      const auto [first, last] = m.groups[g];
      double mean = 0;
      for (std::size_t i = first; i < last; ++i) {
        mean += m.weight[i] * this->mean(i);
        group_of[i] = g;
      }
      mean_[static_cast<Index>(g)] = mean;
      diagonal[g] = static_cast<T>(settled_average_variance(m.groups[g], m.weight));
    }
    // First the rows below a column's own group, each column by itself; then the columns, to where they stand packed.
    dense::for_tiles(
        k_.cols(),
        [&](Index begin, Index count) {
          for (Index j = begin; j < begin + count; ++j) {
            T* column = k_.col(j);
            for (std::size_t g = group_of[static_cast<std::size_t>(j)] + 1; g < groups; ++g) {
              const auto [first, last] = m.groups[g];
              if (last - first == 1) {
                column[g] = column[first];
                continue;
              }
              T sum = 0;
              for (std::size_t i = first; i < last; ++i) sum += static_cast<T>(m.weight[i]) * column[i];
              column[g] = sum;
            }
          }
        },
        32);
    for (std::size_t g = 0; g < groups; ++g) {
      T* packed = k_.col(0) + static_cast<Index>(g) * n;
      combine(packed + g + 1, groups - g - 1, m.groups[g], m.weight,
              [&](std::size_t i) { return k_.col(static_cast<Index>(i)) + g + 1; });
      packed[g] = diagonal[g];
      if (w_.cols() != 0)
        combine(w_.col(static_cast<Index>(g)).data(), static_cast<std::size_t>(w_.rows()), m.groups[g], m.weight,
                [&](std::size_t i) { return w_.col(static_cast<Index>(i)).data(); });
    }
    mean_.conservativeResize(n);
    variance_.resize(n);
    k_.shrink(n, n);
    if (w_.cols() != 0) w_.conservativeResize(Eigen::NoChange, n);
    variance_ = k_.map().diagonal().template cast<double>();
    for (Index i = 0; i < w_.cols(); ++i) variance_[i] -= static_cast<double>(w_.col(i).squaredNorm());
  }

  /// Applies the pending update: K- - W W^T, the n^2 l part of the work.
  void settle() {
    if (w_.cols() == 0) return;
    dense::add_gram<T>(k_.map(), w_, T(-1));
    w_.resize(0, 0);
    variance_ = k_.map().diagonal().template cast<double>();
  }

  /// Forward simulation for eq. 3.13. With the targets' M = K[:, HS] K[HS, :], made once, the reduction by a
  /// measurement of the cells H is tr(S^-1 M[H, H]), S = K[H, H] + R. n^2 |HS| flops once, then 2 l^3 a candidate.
  class Forecaster {
   public:
    Forecaster(const Full& belief, const NdTree&, std::span<const std::uint8_t> target) : k_(&belief.k_) {
      for (std::size_t i = 0; i < target.size(); ++i)
        if (target[i]) target_.push_back(i);
    }
    /// Conditions on a measurement that is going to be made.
    void given(const CellMeasurements& z) {
      if (z.cells.empty()) return;
      dense::Matrix<T> s = detail::gather(*k_, z.cells, &z.noise_variance);
      dense::cholesky<T>(s, "Full::Forecaster");
      dense::Matrix<T> w = rows(*k_, z.cells);
      dense::solve_lower<T>(s, w);
      if (k_ != &own_) {
        own_ = *k_;
        k_ = &own_;
      }
      dense::add_gram<T>(own_.map(), w, T(-1));
    }
    void prepare(std::span<const CellMeasurements>) {
      m_ = LargeMatrix<T>(k_->rows(), k_->cols());
      if (!target_.empty()) dense::add_gram<T>(m_.map(), rows(*k_, target_), T(1));
    }
    [[nodiscard]] double reduction(const CellMeasurements& z) const {
      if (z.cells.empty() || target_.empty()) return 0;
      dense::Matrix<T> s = detail::gather(*k_, z.cells, &z.noise_variance);
      return detail::trace_of_quotient(s, detail::gather<T>(m_, z.cells, nullptr));
    }

   private:
    const LargeMatrix<T>* k_;
    LargeMatrix<T> own_, m_;
    std::vector<std::size_t> target_;
  };

  [[nodiscard]] std::size_t bytes() const {
    return k_.bytes() + static_cast<std::size_t>(w_.size()) * sizeof(T) +
           static_cast<std::size_t>(2 * mean_.size()) * sizeof(double);
  }
  void save(Sink& sink) const {
    sink.put(mean_);
    sink.put(dense::Matrix<T>(k_.map()));
  }
  void load(Source& source, const NdTree& tree) {
    Eigen::MatrixXd mean;
    dense::Matrix<T> k;
    source.get(mean);
    source.get(k);
    const auto n = static_cast<Index>(tree.size());
    if (mean.rows() != n || mean.cols() != 1 || k.rows() != n || k.cols() != n || !mean.allFinite())
      throw Error(source.where(), concat("a belief about ", mean.rows(), " cells"),
                  concat(n, " finite means and their covariance"));
    mean_ = mean;
    k_ = LargeMatrix<T>(n, n);
    k_.map() = k;
    variance_ = k.diagonal().template cast<double>();
    w_.resize(0, 0);
  }

 private:
  using Index = Eigen::Index;

  // K[cells, :] as an l x n matrix, from the lower triangle. Eight rows at a time, so that a column's eight numbers are
  // one line of the cache to write, whichever way they are read.
  static dense::Matrix<T> rows(const LargeMatrix<T>& k, std::span<const std::size_t> cells) {
    const auto l = static_cast<Index>(cells.size());
    dense::Matrix<T> g(l, k.cols());
    dense::for_tiles(
        k.cols(),
        [&](Index begin, Index count) {
          for (Index first = 0; first < l; first += 8)
            for (Index i = begin; i < begin + count; ++i)
              for (Index a = first; a < std::min(l, first + 8); ++a) {
                const auto c = static_cast<Index>(cells[static_cast<std::size_t>(a)]);
                g(a, i) = k(std::max(i, c), std::min(i, c));
              }
        },
        64);
    return g;
  }
  [[nodiscard]] double settled_average_variance(const LeafGroup& g, std::span<const double> weight) const {
    double sum = 0;
    for (std::size_t j = g.first; j < g.last; ++j) {
      const T* column = k_.col(static_cast<Index>(j));
      double below = 0;
      for (std::size_t i = j + 1; i < g.last; ++i) below += weight[i] * static_cast<double>(column[i]);
      sum += weight[j] * (weight[j] * static_cast<double>(column[j]) + 2 * below);
    }
    return sum;
  }
  // to[0, count) <- the weighted sum of a group's columns, each count values from column(i); may overwrite the first.
  template <class Column>
  static void combine(T* to, std::size_t count, const LeafGroup& g, std::span<const double> weight, Column&& column) {
    if (count == 0) return;
    if (g.last - g.first == 1) {
      std::memmove(to, column(g.first), count * sizeof(T));
      return;
    }
    const auto n = static_cast<Index>(count);
    using Values = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    Values sum = Values::Zero(n);
    for (std::size_t i = g.first; i < g.last; ++i)
      sum += static_cast<T>(weight[i]) * Eigen::Map<const Values>(column(i), n);
    std::memcpy(to, sum.data(), count * sizeof(T));
  }
  Eigen::VectorXd mean_, variance_;
  LargeMatrix<T> k_;    // lower triangle
  dense::Matrix<T> w_;  // W^T of the pending update, l x n; empty when settled
};

}  // namespace vantage

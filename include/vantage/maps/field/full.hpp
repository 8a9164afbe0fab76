// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/dense.hpp>
#include <vantage/maps/field/cell_sensor.hpp>
#include <vantage/maps/field/nd_tree.hpp>
#include <vantage/maps/field/prior.hpp>

namespace vantage {

namespace detail {

/// Entry (i, j) of a symmetric matrix kept in its lower triangle.
template <class T>
T symmetric(const dense::Matrix<T>& k, std::size_t i, std::size_t j) {
  return i >= j ? k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))
                : k(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i));
}

/// K[cells, cells] with `diagonal` added, lower triangle only; cells ascend.
template <class T>
dense::Matrix<T> gather(const dense::Matrix<T>& k, std::span<const std::size_t> cells, const Eigen::VectorXd* diagonal) {
  const auto l = static_cast<Eigen::Index>(cells.size());
  dense::Matrix<T> s(l, l);
  for (Eigen::Index b = 0; b < l; ++b) {
    const T* column = k.col(static_cast<Eigen::Index>(cells[static_cast<std::size_t>(b)])).data();
    for (Eigen::Index a = b; a < l; ++a) s(a, b) = column[cells[static_cast<std::size_t>(a)]];
  }
  if (diagonal) s.diagonal() += diagonal->template cast<T>();
  return s;
}

/// tr(S^-1 M) for symmetric matrices in their lower triangles; S is destroyed. About 5 l^3 / 3 flops.
template <class T>
double trace_of_quotient(dense::Matrix<T>& s, dense::Matrix<T> m) {
  const Eigen::LLT<Eigen::Ref<dense::Matrix<T>>> llt(s);
  if (llt.info() != Eigen::Success)
    throw Error("forecast", "the innovation covariance is not positive definite to working precision", "more noise");
  m.template triangularView<Eigen::StrictlyUpper>() = m.transpose();
  llt.matrixL().solveInPlace(m);                     // L^-1 M
  llt.matrixU().template solveInPlace<Eigen::OnTheLeft>(m);
  return static_cast<double>(m.trace());
}

}  // namespace detail

/// The full posterior: mean vector and covariance matrix, Kalman updates (eqs. 3.6, 3.7), merging (eqs. 3.9, 3.10). The
/// lower triangle of an n x n matrix: 8 n^2 bytes in double. One update of l cells: n^2 l + n l^2 + l^3 / 3 flops.
///
/// An update stays pending as K - W W^T until `settle`, so that cells which merge are merged in K and in W first, and the
/// rank-l update runs on the smaller matrix.
template <class T = double>
class Full {
 public:
  static constexpr std::string_view name = sizeof(T) == 8 ? "full" : "full_f32";
  struct Config {};

  Full(const Config&, const NdTree& tree, const Prior& prior)
      : mean_(Eigen::VectorXd::Constant(static_cast<Index>(tree.size()), prior.mean)), k_(mean_.size(), mean_.size()) {
    const Index n = mean_.size();
    const double variance = prior.variance;
    dense::for_tiles(n, [&](Index begin, Index count) {
      for (Index j = begin; j < begin + count; ++j) {
        const NdTree::Leaf& b = tree[static_cast<std::size_t>(j)];
        const double *kx = prior.kx.col(b.ix).data(), *ky = prior.ky.col(b.iy).data();
        for (Index i = j; i < n; ++i) {
          const NdTree::Leaf& a = tree[static_cast<std::size_t>(i)];
          k_(i, j) = static_cast<T>(variance * kx[a.ix] * ky[a.iy]);
        }
      }
    }, 32);
    variance_ = k_.diagonal().template cast<double>();
  }

  [[nodiscard]] double mean(std::size_t i) const { return mean_[static_cast<Index>(i)]; }
  [[nodiscard]] double variance(std::size_t i) const { return variance_[static_cast<Index>(i)]; }
  /// Posterior covariance of two cells.
  [[nodiscard]] double covariance(std::size_t i, std::size_t j) const {
    return static_cast<double>(detail::symmetric(k_, i, j));
  }
  /// q K q^T of a weighted average over a group of cells.
  [[nodiscard]] double average_variance(const LeafGroup& g, std::span<const double> weight) const {
    double sum = 0;
    for (std::size_t j = g.first; j < g.last; ++j) {
      double column = 0.5 * weight[j] * covariance(j, j);
      for (std::size_t i = j + 1; i < g.last; ++i) column += weight[i] * covariance(i, j);
      sum += 2 * weight[j] * column;
    }
    if (w_.cols() == 0) return sum;
    const auto first = static_cast<Index>(g.first), count = static_cast<Index>(g.last - g.first);
    const Eigen::Map<const Eigen::VectorXd> q(weight.data() + g.first, count);
    return sum - static_cast<double>((w_.middleCols(first, count) * q.template cast<T>()).squaredNorm());
  }

  /// Folds measurements in. Throws Error, changing nothing, if S = H K H^T + R is not positive definite.
  void fuse(const NdTree&, const CellMeasurements& z) {
    dense::Matrix<T> s = detail::gather(k_, z.cells, &z.noise_variance);
    dense::cholesky<T>(s, "Full::fuse");
    dense::Matrix<T> w = gain_rows(z.cells);                   // H K-
    dense::solve_lower<T>(s, w);                               // W^T = L^-1 H K-, so that K+ = K- - W W^T
    dense::Matrix<T> g(static_cast<Index>(z.cells.size()), 1);
    for (std::size_t a = 0; a < z.cells.size(); ++a)
      g(static_cast<Index>(a), 0) = static_cast<T>(z.value[static_cast<Index>(a)] - mean(z.cells[a]));
    s.template triangularView<Eigen::Lower>().solveInPlace(g);
    dense::for_tiles(w.cols(), [&](Index i, Index count) {
      mean_.segment(i, count) += (w.middleCols(i, count).transpose() * g).template cast<double>();
      variance_.segment(i, count) -= w.middleCols(i, count).colwise().squaredNorm().transpose().template cast<double>();
    });
    w_ = std::move(w);
  }

  /// M mu and M K M^T (eqs. 3.9, 3.10), in place: a new cell never stands behind its oldest part.
  void merge(const NdTree&, const Merge& m) {
    const auto n = static_cast<Index>(m.groups.size());
    const auto groups = std::span(m.groups);
    for (Index h = 0; h < n; ++h) {  // columns, then rows of the lower triangle
      const LeafGroup from = groups[static_cast<std::size_t>(h)];
      for (Index g = h; g < n; ++g) {
        const LeafGroup to = groups[static_cast<std::size_t>(g)];
        double sum = 0;
        for (std::size_t j = from.first; j < from.last; ++j) {
          double column = 0;
          for (std::size_t i = to.first; i < to.last; ++i) column += m.weight[i] * covariance(i, j);
          sum += m.weight[j] * column;
        }
        scratch_.resize(std::max<Index>(scratch_.size(), n));
        scratch_[g] = static_cast<T>(sum);
      }
      k_.col(h).segment(h, n - h) = scratch_.segment(h, n - h);
    }
    for (Index h = 0; h < n; ++h) {
      const LeafGroup g = groups[static_cast<std::size_t>(h)];
      double mean = 0;
      Eigen::Matrix<T, Eigen::Dynamic, 1> w = Eigen::Matrix<T, Eigen::Dynamic, 1>::Zero(w_.rows());
      for (std::size_t i = g.first; i < g.last; ++i) {
        mean += m.weight[i] * this->mean(i);
        if (w_.cols() != 0) w += static_cast<T>(m.weight[i]) * w_.col(static_cast<Index>(i));
      }
      mean_[h] = mean;
      if (w_.cols() != 0) w_.col(h) = w;
    }
    mean_.conservativeResize(n);
    if (w_.cols() != 0) w_.conservativeResize(Eigen::NoChange, n);
    k_.conservativeResize(n, n);
  }

  /// Applies the pending update: K- - W W^T, the n^2 l part of the work.
  void settle() {
    if (w_.cols() == 0) return;
    dense::add_gram<T>(k_, w_, T(-1));
    w_.resize(0, 0);
    variance_ = k_.diagonal().template cast<double>();
  }

  /// Forward simulation for eq. 3.13. With the targets' M = K[:, HS] K[HS, :], made once, the reduction by a measurement
  /// of the cells H is tr(S^-1 M[H, H]), S = K[H, H] + R. n^2 |HS| flops once, then 2 l^3 a candidate.
  class Forecaster {
   public:
    Forecaster(const Full& belief, std::span<const std::uint8_t> target) : k_(&belief.k_) {
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
      if (k_ != &own_) { own_ = *k_; k_ = &own_; }
      dense::add_gram<T>(own_, w, T(-1));
    }
    void prepare() {
      m_ = dense::Matrix<T>::Zero(k_->rows(), k_->cols());
      if (!target_.empty()) dense::add_gram<T>(m_, rows(*k_, target_), T(1));
    }
    [[nodiscard]] double reduction(const CellMeasurements& z) const {
      if (z.cells.empty() || target_.empty()) return 0;
      dense::Matrix<T> s = detail::gather(*k_, z.cells, &z.noise_variance);
      return detail::trace_of_quotient(s, detail::gather<T>(m_, z.cells, nullptr));
    }

   private:
    const dense::Matrix<T>* k_;
    dense::Matrix<T> own_, m_;
    std::vector<std::size_t> target_;
  };

  [[nodiscard]] std::size_t bytes() const {
    return static_cast<std::size_t>(k_.size() + w_.size()) * sizeof(T) + static_cast<std::size_t>(2 * mean_.size()) * sizeof(double);
  }
  void save(Sink& sink) const { sink.put(mean_); sink.put(k_); }
  void load(Source& source, const NdTree& tree) {
    Eigen::MatrixXd mean;
    dense::Matrix<T> k;
    source.get(mean);
    source.get(k);
    const auto n = static_cast<Index>(tree.size());
    if (mean.rows() != n || mean.cols() != 1 || k.rows() != n || k.cols() != n || !mean.allFinite())
      throw Error(source.where(), concat("a belief about ", mean.rows(), " cells"), concat(n, " finite means and their covariance"));
    mean_ = mean;
    k_ = std::move(k);
    variance_ = k_.diagonal().template cast<double>();
    w_.resize(0, 0);
  }

 private:
  using Index = Eigen::Index;

  // K[cells, :] as an l x n matrix, from the lower triangle; cells ascend. By tiles, so that the strided half stays in cache.
  static dense::Matrix<T> rows(const dense::Matrix<T>& k, std::span<const std::size_t> cells) {
    const auto l = static_cast<Index>(cells.size());
    dense::Matrix<T> g(l, k.cols());
    dense::for_tiles(k.cols(), [&](Index begin, Index count) {
      for (Index a = 0; a < l; ++a) {
        const auto c = static_cast<Index>(cells[static_cast<std::size_t>(a)]);
        const Index split = std::clamp<Index>(c, begin, begin + count);
        for (Index i = split; i < begin + count; ++i) g(a, i) = k(i, c);
      }
      for (Index i = begin; i < begin + count; ++i) {
        const auto from = std::upper_bound(cells.begin(), cells.end(), static_cast<std::size_t>(i));
        for (auto c = from; c != cells.end(); ++c) g(c - cells.begin(), i) = k(static_cast<Index>(*c), i);
      }
    }, 64);
    return g;
  }
  [[nodiscard]] dense::Matrix<T> gain_rows(std::span<const std::size_t> cells) const { return rows(k_, cells); }

  Eigen::VectorXd mean_, variance_;
  dense::Matrix<T> k_;                        // lower triangle
  dense::Matrix<T> w_;                        // W^T of the pending update, l x n; empty when settled
  Eigen::Matrix<T, Eigen::Dynamic, 1> scratch_;
};

}  // namespace vantage

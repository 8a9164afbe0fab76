// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/dense.hpp>
#include <vantage/core/error.hpp>
#include <vantage/maps/field/cell_sensor.hpp>
#include <vantage/maps/field/full.hpp>
#include <vantage/maps/field/nd_tree.hpp>
#include <vantage/maps/field/prior.hpp>
#include <vantage/maps/field/separable_basis.hpp>

namespace vantage {

/// A belief in the r latent coordinates of the prior's leading eigenfunctions, f = mu + Phi z, z ~ N(J^-1 h, J^-1): the
/// posterior of Full<> with the small eigenvalues of the prior left out, at r^2 instead of n^2 numbers, whatever the
/// resolution. Merging changes none of them: a parent's row of Phi is the average of its children's.
///
/// The rank follows from the error that the user allows. With e the largest eigenvalue left out and r_min the smallest
/// noise variance that the measurements of one cell add up to, a posterior variance v is too small by at most
/// 2 e (1 + v / r_min): what was left out, under the gain of the filter that does not know of it.
///
/// One update costs r^3 flops, and r^2 for each row of cells held; memory 16 r^2 bytes, and 16 bytes a cell.
/// Thread-safe const members.
template <class T = double>
class Latent {
  static_assert(std::same_as<T, double>,
                "vantage: Latent inverts matrices that single precision cannot; it is a template so that only programs "
                "that use it compile it");

 public:
  static constexpr std::string_view name = "latent";
  struct Config {
    double variance_error = 1e-8;        ///< allowed in any posterior variance, > 0, in the field's unit squared
    double least_noise_variance = 0.01;  ///< r_min above, > 0
  };

  Latent(const Config& config, const NdTree& tree, const Prior& prior)
      : prior_mean_(prior.mean), basis_(tree, prior, checked(config, prior.variance)), state_{basis_} {
    refresh(tree);
  }

  [[nodiscard]] double mean(std::size_t i) const { return mean_[static_cast<Index>(i)]; }
  [[nodiscard]] double variance(std::size_t i) const { return variance_[static_cast<Index>(i)]; }
  /// Number r of latent coordinates, and the largest eigenvalue of the prior that was left out.
  [[nodiscard]] Eigen::Index rank() const { return basis_.rank; }
  [[nodiscard]] double lost() const { return basis_.lost; }
  /// Posterior covariance of two leaves.
  [[nodiscard]] double covariance(const NdTree& tree, std::size_t i, std::size_t j) const {
    Eigen::VectorX<T> a(basis_.rank), b(basis_.rank);
    basis_.row(tree[i], a);
    basis_.row(tree[j], b);
    return a.dot(product(covariance_, b).col(0));
  }
  /// Posterior covariance of all leaves. n r (n + r) flops for n leaves.
  [[nodiscard]] Eigen::MatrixXd covariance_matrix(const NdTree& tree) const {
    const auto n = static_cast<Index>(tree.size());
    dense::Matrix<T> phi(basis_.rank, n);
    for (Index i = 0; i < n; ++i) basis_.row(tree[static_cast<std::size_t>(i)], phi.col(i));
    dense::Matrix<T> p = dense::Matrix<T>::Zero(n, n);
    dense::for_tiles(
        n,
        [&](Index begin, Index count) {
          dense::add_tn<T>(p.middleCols(begin, count), phi, product(covariance_, phi.middleCols(begin, count)), 1);
        },
        64);
    return p;
  }
  [[nodiscard]] std::vector<double> parent_variances(std::span<const ParentCell> parents,
                                                     std::span<const double>) const {
    std::vector<double> out(parents.size());
    variances(detail::CellRows<T>(basis_, parents.size(), [&](std::size_t k) { return parents[k].cell; }), out.data());
    return out;
  }

  /// J += H^T R^-1 H and h += H^T R^-1 (y - mu) in latent coordinates: eqs. 3.6 and 3.7 in information form.
  void fuse(const NdTree& tree, const CellMeasurements& z) {
    State next = state_;
    next.add(basis_, tree, z, z.value.array() - prior_mean_);
    std::swap(state_, next);
    try {
      refresh(tree);
    } catch (...) {
      std::swap(state_, next);
      throw;
    }
  }
  void merge(const NdTree& tree, const Merge& m) {
    std::vector<std::size_t> merged;
    std::vector<ParentCell> parents;
    Index to = 0;
    for (std::size_t g = 0; g < m.groups.size(); ++g, ++to) {
      const auto [first, last] = m.groups[g];
      double mean = 0;
      for (std::size_t i = first; i < last; ++i) mean += m.weight[i] * this->mean(i);
      mean_[to] = mean;
      variance_[to] = variance(first);
      if (last - first == 1) continue;
      merged.push_back(g);
      parents.push_back({tree.parent_of(m.groups[g]), m.groups[g]});
    }
    mean_.conservativeResize(to);
    variance_.conservativeResize(to);
    const std::vector<double> v = parent_variances(parents, {});
    for (std::size_t k = 0; k < merged.size(); ++k) variance_[static_cast<Index>(merged[k])] = v[k];
  }
  void settle() {}

  [[nodiscard]] std::size_t bytes() const {
    std::size_t numbers = 2 * static_cast<std::size_t>(covariance_.size()) + 2 * static_cast<std::size_t>(mean_.size());
    for (const auto& f : {&basis_.fx, &basis_.fy})
      for (const dense::Matrix<T>& level : *f) numbers += static_cast<std::size_t>(level.size());
    return numbers * sizeof(double);
  }
  void save(Sink& sink) const {
    sink.put(state_.information);
    sink.put(state_.evidence);
  }
  void load(Source& source, const NdTree& tree) {
    State next = state_;
    dense::Matrix<T> evidence;
    source.get(next.information);
    source.get(evidence);
    if (next.information.rows() != basis_.rank || next.information.cols() != basis_.rank ||
        evidence.rows() != basis_.rank || evidence.cols() != 1 || !next.information.allFinite() ||
        !evidence.allFinite())
      throw Error(source.where(), concat("a latent state of rank ", next.information.rows()),
                  concat(basis_.rank, " finite coordinates"));
    next.evidence = evidence;
    state_ = std::move(next);
    refresh(tree);
  }

 private:
  using Index = Eigen::Index;

  struct State {
    dense::Matrix<T> information;  // J, lower triangle
    Eigen::VectorX<T> evidence;    // h

    explicit State(const detail::SeparableBasis<T>& basis)
        : information(dense::Matrix<T>::Identity(basis.rank, basis.rank)),
          evidence(Eigen::VectorX<T>::Zero(basis.rank)) {}

    // J += sum_i phi_i phi_i^T / r_i. A row of cells adds X (x) fy fy^T with X = sum fx fx^T / r, so that a block (a,
    // a') of J gains FY diag(X[a, a'] of each row) FY^T: r^2 flops a row of cells, not a cell.
    template <class Innovation>
    void add(const detail::SeparableBasis<T>& basis, const NdTree& tree, const CellMeasurements& z,
             const Innovation& innovation) {
      const detail::CellRows<T> cells(basis, z.cells.size(), [&](std::size_t k) { return tree[z.cells[k]]; });
      const Index m = basis.modes(), rows = cells.y.cols();
      dense::Matrix<T> gram = dense::Matrix<T>::Zero(m * m, rows), weighted = dense::Matrix<T>::Zero(m, rows);
      for (Index g = 0; g < rows; ++g) {
        const detail::CellRow<T>& row = cells.row[static_cast<std::size_t>(g)];
        dense::Matrix<T> scaled = row.x;
        for (std::size_t k = 0; k < row.member.size(); ++k) {
          const auto i = static_cast<Index>(row.member[k]), at = static_cast<Index>(k);
          scaled.col(at) /= z.noise_variance[i];
          weighted.col(g) += innovation[i] * scaled.col(at);
        }
        dense::add_nt<T>(Eigen::Map<dense::Matrix<T>>(gram.col(g).data(), m, m), scaled, row.x, 1);
      }
      parallel_for(static_cast<std::size_t>(m), [&](std::size_t a) {
        const Index ia = static_cast<Index>(a), na = basis.count[a];
        for (Index g = 0; g < rows; ++g)
          evidence.segment(basis.offset[a], na) += weighted(ia, g) * cells.y.col(g).head(na);
        dense::Matrix<T> scaled(na, rows);
        for (std::size_t b = 0; b <= a; ++b) {
          const Index nb = basis.count[b];
          for (Index g = 0; g < rows; ++g)
            scaled.col(g) = gram(ia + m * static_cast<Index>(b), g) * cells.y.col(g).head(na);
          dense::add_nt<T>(information.block(basis.offset[a], basis.offset[b], na, nb), scaled, cells.y.topRows(nb), 1);
        }
      });
    }
  };

 public:
  /// Forward simulation for eq. 3.13 in latent coordinates, with Q = sum of phi phi^T over the targets: the reduction
  /// is tr(Q C) - tr(Q (J + H^T R^-1 H)^-1), or, for fewer cells than coordinates, tr(S^-1 H C Q C H^T) with S = H C
  /// H^T + R. No cost depends on the number of cells held.
  class Forecaster {
   public:
    Forecaster(const Latent& belief, const NdTree& tree, std::span<const std::uint8_t> target)
        : belief_(&belief), tree_(&tree), state_(belief.state_) {
      CellMeasurements all;
      for (std::size_t i = 0; i < target.size(); ++i)
        if (target[i]) all.cells.push_back(i);
      all.noise_variance = Eigen::VectorX<T>::Ones(static_cast<Index>(all.cells.size()));
      State q(belief.basis_);
      q.information.setZero();
      if (!all.cells.empty()) q.add(belief.basis_, tree, all, Eigen::VectorX<T>::Zero(all.noise_variance.size()));
      target_ = q.information.template selfadjointView<Eigen::Lower>();
    }
    void given(const CellMeasurements& z) {
      if (!z.cells.empty()) state_.add(belief_->basis_, *tree_, z, Eigen::VectorX<T>::Zero(z.noise_variance.size()));
    }
    /// Computes once what the candidates share; those of fewer cells than coordinates, C Phi and C Q C Phi of every
    /// cell that one of them sees.
    void prepare(std::span<const CellMeasurements> candidates) {
      covariance_ = inverse(state_.information);
      before_ = covariance_.cwiseProduct(target_).sum();
      std::vector<std::size_t> seen;
      column_.assign(tree_->size(), -1);
      for (const CellMeasurements& z : candidates)
        if (few(z))
          for (const std::size_t i : z.cells)
            if (column_[i] < 0) {
              column_[i] = static_cast<Index>(seen.size());
              seen.push_back(i);
            }
      const dense::Matrix<T> middle = product(covariance_, product(target_, covariance_));
      phi_.resize(belief_->rank(), static_cast<Index>(seen.size()));
      c_phi_.setZero(phi_.rows(), phi_.cols());
      m_phi_.setZero(phi_.rows(), phi_.cols());
      dense::for_tiles(
          phi_.cols(),
          [&](Index begin, Index count) {
            for (Index k = begin; k < begin + count; ++k)
              belief_->basis_.row((*tree_)[seen[static_cast<std::size_t>(k)]], phi_.col(k));
            const auto phi = phi_.middleCols(begin, count);
            dense::add_tn<T>(c_phi_.middleCols(begin, count), covariance_, phi, 1);
            dense::add_tn<T>(m_phi_.middleCols(begin, count), middle, phi, 1);
          },
          64);
    }
    [[nodiscard]] double reduction(const CellMeasurements& z) const {
      if (z.cells.empty()) return 0;
      if (!few(z)) {
        State after = state_;
        after.add(belief_->basis_, *tree_, z, Eigen::VectorX<T>::Zero(z.noise_variance.size()));
        return before_ - inverse(after.information).cwiseProduct(target_).sum();
      }
      std::vector<Index> at;
      for (const std::size_t i : z.cells) at.push_back(column_[i]);
      const dense::Matrix<T> phi = phi_(Eigen::all, at);
      dense::Matrix<T> s = lower_product(phi, c_phi_(Eigen::all, at));
      s.diagonal() += z.noise_variance;
      return detail::trace_of_quotient<T>(s, lower_product(phi, m_phi_(Eigen::all, at)));
    }

   private:
    [[nodiscard]] bool few(const CellMeasurements& z) const {
      return static_cast<Index>(z.cells.size()) < belief_->rank();
    }

    const Latent* belief_;
    const NdTree* tree_;
    State state_;
    dense::Matrix<T> target_, covariance_;
    double before_ = 0;
    std::vector<Index> column_;  // of a cell in the following, or -1
    dense::Matrix<T> phi_, c_phi_, m_phi_;
  };

 private:
  // The eigenvalues that may be left out.
  static double checked(const Config& c, double prior_variance) {
    Check check("Latent::Config");
    check.positive("variance_error", c.variance_error);
    check.positive("least_noise_variance", c.least_noise_variance);
    check.done();
    return c.variance_error / (2 * (1 + prior_variance / c.least_noise_variance));
  }
  // A^T B.
  static dense::Matrix<T> product(const dense::ConstRef<T>& a, const dense::ConstRef<T>& b) {
    dense::Matrix<T> c = dense::Matrix<T>::Zero(a.cols(), b.cols());
    dense::add_tn<T>(c, a, b, 1);
    return c;
  }
  // A^T B, known to be symmetric: its lower triangle, by columns of tiles.
  static dense::Matrix<T> lower_product(const dense::Matrix<T>& a, const dense::Matrix<T>& b) {
    constexpr Index size = 64;
    const Index n = a.cols();
    dense::Matrix<T> c = dense::Matrix<T>::Zero(n, n);
    for (Index j = 0; j < n; j += size) {
      const Index nj = std::min(size, n - j);
      dense::add_tn<T>(c.block(j, j, n - j, nj), a.rightCols(n - j), b.middleCols(j, nj), 1);
    }
    return c;
  }
  static dense::Matrix<T> inverse(dense::Matrix<T> information) {
    dense::cholesky<double>(information, "Latent");
    dense::Matrix<T> c;
    dense::inverse_from_cholesky<double>(information, c);
    return c;
  }

  // C = J^-1, then mean and variance of every leaf.
  void refresh(const NdTree& tree) {
    dense::Matrix<T> covariance = inverse(state_.information);
    const auto n = static_cast<Index>(tree.size());
    Eigen::VectorX<T> mean(n), variance(n);
    covariance_.swap(covariance);
    const detail::CellRows<T> cells(basis_, tree.size(), [&](std::size_t i) { return tree[i]; });
    variances(cells, variance.data());
    const Eigen::VectorX<T> z = product(covariance_, state_.evidence);
    const Index m = basis_.modes();
    Eigen::VectorX<T> along_x(m);  // sum over b of z[(a, b)] fy[b]
    for (std::size_t g = 0; g < cells.row.size(); ++g) {
      for (Index a = 0; a < m; ++a) {
        const auto k = static_cast<std::size_t>(a);
        along_x[a] =
            z.segment(basis_.offset[k], basis_.count[k]).dot(cells.y.col(static_cast<Index>(g)).head(basis_.count[k]));
      }
      for (std::size_t k = 0; k < cells.row[g].member.size(); ++k)
        mean[static_cast<Index>(cells.row[g].member[k])] =
            prior_mean_ + cells.row[g].x.col(static_cast<Index>(k)).dot(along_x);
    }
    mean_.swap(mean);
    variance_.swap(variance);
  }

  // phi^T C phi of every cell: C is contracted with fy of each row of cells from both sides, 2 r^2 flops a row, which
  // leaves an m x m matrix for the row; then with fx of each cell.
  void variances(const detail::CellRows<T>& cells, double* out) const {
    const Index m = basis_.modes(), rows = cells.y.cols();
    if (rows == 0) return;
    std::vector<dense::Matrix<T>> contracted(static_cast<std::size_t>(m));  // [a'](a, row), a <= a'
    parallel_for(static_cast<std::size_t>(m), [&](std::size_t order) {
      const std::size_t b = static_cast<std::size_t>(m) - 1 - order;
      const Index above = basis_.offset[b] + basis_.count[b];
      const dense::Matrix<T> half =  // C is symmetric
          product(covariance_.block(basis_.offset[b], 0, basis_.count[b], above), cells.y.topRows(basis_.count[b]));
      contracted[b].resize(m, rows);
      for (std::size_t a = 0; a <= b; ++a)
        contracted[b].row(static_cast<Index>(a)) = half.middleRows(basis_.offset[a], basis_.count[a])
                                                       .cwiseProduct(cells.y.topRows(basis_.count[a]))
                                                       .colwise()
                                                       .sum();
    });
    parallel_for(cells.row.size(), [&](std::size_t g) {
      const detail::CellRow<T>& row = cells.row[g];
      dense::Matrix<T> c(m, m);
      for (Index b = 0; b < m; ++b)
        for (Index a = 0; a <= b; ++a)
          c(a, b) = c(b, a) = contracted[static_cast<std::size_t>(b)](a, static_cast<Index>(g));
      const dense::Matrix<T> cx = product(c, row.x);  // c is symmetric
      for (std::size_t k = 0; k < row.member.size(); ++k)
        out[row.member[k]] = row.x.col(static_cast<Index>(k)).dot(cx.col(static_cast<Index>(k)));
    });
  }

  double prior_mean_;
  detail::SeparableBasis<T> basis_;
  State state_;
  dense::Matrix<T> covariance_;  // C = J^-1
  Eigen::VectorX<T> mean_, variance_;
};

}  // namespace vantage

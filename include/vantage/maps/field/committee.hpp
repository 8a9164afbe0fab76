// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include <vantage/core/dense.hpp>
#include <vantage/maps/field/accumulated.hpp>
#include <vantage/maps/field/batch.hpp>

namespace vantage {

/// Tresp's Bayesian committee machine ("A Bayesian Committee Machine", Neural Computation 12, 2000): each batch i of
/// measurements has a regression of its own, m_i and C_i over the n cells, and M of them are combined as
///
///     C^-1 = -(M - 1) K^-1 + sum_i C_i^-1,    m = mu + C sum_i C_i^-1 (m_i - mu).
///
/// None of these inverses is formed; over cells much smaller than the kernel's length, K is singular to working
/// precision. With L L^T = K + jitter, A_i = L^-1 K_*i and F_i F_i^T = K_ii + R_i - A_i^T A_i, the matrix inversion
/// lemma gives
///
///     C = L (I + Z Z^T)^-1 L^T,    m = mu + L (I + Z Z^T)^-1 Z e,    Z_i = A_i F_i^-T,    e_i = F_i^-1 (y_i - mu),
///
/// n^2 (2 l + 5 n / 3) flops. Where there are fewer measurements than cells, the same is cheaper by one regression
/// whose measurements covary exactly within a batch, and across batches only through the cells, A_i^T A_j
/// (Quinonero-Candela & Rasmussen, JMLR 6, 2005, section 6: transductive PITC). Exact where the measured cells are
/// among the queried ones; what is lost is what pruned cells cannot carry from one batch to another.
///
/// A template only so that programs which do not use it need not compile it.
template <std::same_as<double> T = double>
struct CommitteeRegression {
  static constexpr std::string_view name = "committee";
  static constexpr bool infers_after_merge = true;  // the committee meets again over the new cells

  [[nodiscard]] CellPosterior infer(const NodePrior& prior, double prior_mean, const MeasurementHistory& h,
                                    std::span<const NdTree::Leaf> cells, double jitter) const {
    if (h.batch_end.size() < 2) return ExactRegression<T>{}.infer(prior, prior_mean, h, cells, jitter);
    dense::Matrix<T> l = prior.covariance(cells);
    l.diagonal().array() += jitter;
    dense::cholesky<T>(l, "Committee");
    dense::Matrix<T> a = prior.covariance(cells, h.cell);
    forward(l, a);
    return h.size() < cells.size() ? by_measurements(a, prior, prior_mean, h, cells, jitter)
                                   : by_cells(l, a, prior, prior_mean, h, jitter);
  }

  /// Cells are pruned; the measurements stay what they were.
  void merge(MeasurementHistory&, const NdTree&, const Merge&) const {}

 private:
  // f(first measurement, number) for each batch.
  template <class F>
  static void for_batches(const MeasurementHistory& h, F&& f) {
    std::size_t begin = 0;
    for (const std::size_t end : h.batch_end) {
      f(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
      begin = end;
    }
  }
  // a <- l^-1 a, in narrower tiles than dense::solve_lower: a batch is a few hundred columns.
  static void forward(const dense::Matrix<T>& l, dense::Matrix<T>& a) {
    dense::for_tiles(
        a.cols(),
        [&](Eigen::Index j, Eigen::Index count) {
          auto columns = a.middleCols(j, count);
          l.template triangularView<Eigen::Lower>().solveInPlace(columns);
        },
        128);
  }

  static CellPosterior by_measurements(const dense::Matrix<T>& a, const NodePrior& prior, double prior_mean,
                                       const MeasurementHistory& h, std::span<const NdTree::Leaf> cells,
                                       double jitter) {
    dense::Matrix<T> s = prior.covariance(h.cell);
    for_batches(h, [&](Eigen::Index b, Eigen::Index size) {  // the rows below this batch's own square
      const Eigen::Index first = b + size;
      dense::for_tiles(s.rows() - first, [&](Eigen::Index i, Eigen::Index count) {
        s.block(first + i, b, count, size).noalias() =
            a.middleCols(first + i, count).transpose() * a.middleCols(b, size);
      });
    });
    return ExactRegression<T>::regress(std::move(s), prior, prior_mean, h, cells, jitter);
  }

  static CellPosterior by_cells(const dense::Matrix<T>& l, dense::Matrix<T>& a, const NodePrior& prior,
                                double prior_mean, const MeasurementHistory& h, double jitter) {
    dense::Matrix<T> z(a.cols(), a.rows());  // Z^T
    Eigen::VectorX<T> e = h.value.array() - prior_mean;
    for_batches(h, [&](Eigen::Index b, Eigen::Index size) {
      const auto ai = a.middleCols(b, size);
      dense::Matrix<T> f =
          prior.covariance(std::span(h.cell).subspan(static_cast<std::size_t>(b), static_cast<std::size_t>(size)));
      f.diagonal().array() += h.noise_variance.segment(b, size).array() + jitter;
      dense::add_gram<T>(f, ai, -1.0);
      dense::cholesky<T>(f, "Committee");
      auto zi = z.middleRows(b, size);
      zi = ai.transpose();
      dense::solve_lower<T>(f, zi);
      auto ei = e.segment(b, size);
      f.template triangularView<Eigen::Lower>().solveInPlace(ei);
    });
    dense::Matrix<T> u = dense::Matrix<T>::Identity(l.rows(), l.cols());
    dense::add_gram<T>(u, z, 1.0);
    dense::cholesky<T>(u, "Committee");
    Eigen::VectorX<T> g = z.transpose() * e;
    u.template triangularView<Eigen::Lower>().solveInPlace(g);
    CellPosterior p;
    p.reduces_prior = false;
    p.root = dense::Matrix<T>(l.template triangularView<Eigen::Lower>()).transpose();
    dense::solve_lower<T>(u, p.root);
    p.mean = (p.root.transpose() * g).array() + prior_mean;
    return p;
  }
};

/// The belief of AR-BCM (section 3.2.1, after Wang et al.), best with CellCentre: queries are the centres of the tree's
/// leaves, and a parent's centre replaces those of its uninteresting children.
using Committee = Accumulated<CommitteeRegression<>>;

}  // namespace vantage

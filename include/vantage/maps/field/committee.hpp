// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

#include <vantage/core/dense.hpp>
#include <vantage/maps/field/accumulated.hpp>

namespace vantage {

/// Tresp's Bayesian committee machine ("A Bayesian Committee Machine", Neural Computation 12, 2000): each batch i of
/// measurements has a regression of its own, m_i and C_i over the n cells, and M of them are combined as
///
///     C^-1 = -(M - 1) K^-1 + sum_i C_i^-1,    m = mu + C sum_i C_i^-1 (m_i - mu).
///
/// None of these inverses is formed; over cells much smaller than the kernel's length, K is singular to working precision.
/// By the matrix inversion lemma the committee is one regression whose measurements covary exactly within a batch, and
/// across batches only through the cells,
///
///     Q_ij = K_i* (K** + jitter)^-1 K_*j   (Quinonero-Candela & Rasmussen, JMLR 6, 2005, section 6: transductive PITC).
///
/// It is exact where the measured cells are among the queried ones, and loses what pruned cells cannot carry. Adds
/// n^3 / 3 + n^2 l + n l^2 flops to an update.
struct CommitteeRegression {
  static constexpr std::string_view name = "committee";
  static constexpr bool infers_after_merge = true;  // the committee meets again over the new cells

  [[nodiscard]] Eigen::MatrixXd covariance(const NodePrior& prior, const MeasurementHistory& h, std::span<const NdTree::Leaf> cells, double jitter) const {
    Eigen::MatrixXd s = prior.covariance(h.cell);
    if (h.batch_end.size() < 2) return s;
    Eigen::MatrixXd k = prior.covariance(cells);
    k.diagonal().array() += jitter;
    dense::cholesky<double>(k, "Committee");
    Eigen::MatrixXd a = prior.covariance(cells, h.cell);
    dense::solve_lower<double>(k, a);
    std::size_t begin = 0;
    for (const std::size_t end : h.batch_end) {  // rows below this batch's own square, in its columns
      const auto b = static_cast<Eigen::Index>(begin), e = static_cast<Eigen::Index>(end), below = s.rows() - e;
      dense::for_tiles(below, [&](Eigen::Index i, Eigen::Index count) {
        s.block(e + i, b, count, e - b).noalias() = a.middleCols(e + i, count).transpose() * a.middleCols(b, e - b);
      });
      begin = end;
    }
    return s;
  }

  /// Cells are pruned; the measurements stay what they were.
  void merge(MeasurementHistory&, const NdTree&, const Merge&) const {}
};

/// The belief of AR-BCM (section 3.2.1, after Wang et al.), best with CellCentre: queries are the centres of the tree's
/// leaves, and a parent's centre replaces those of its uninteresting children.
using Committee = Accumulated<CommitteeRegression>;

}  // namespace vantage

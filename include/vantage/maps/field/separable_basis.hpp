// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <vantage/core/dense.hpp>
#include <vantage/core/error.hpp>
#include <vantage/maps/field/nd_tree.hpp>
#include <vantage/maps/field/prior.hpp>

namespace vantage::detail {

/// The leading part of a separable prior as Phi Phi^T (K- is a Kronecker product, so that its eigenvectors are
/// products). A cell's row of Phi is itself a product, phi[(a, b)] = fx[a] fy[b], at every level of the tree: a merge
/// averages rows. Modes (a, b) with b < count[a] are kept, a staircase, and stand at offset[a] + b.
template <class T>
struct SeparableBasis {
  std::vector<dense::Matrix<T>> fx, fy;  ///< per level of the tree: cells of the level x modes
  std::vector<Eigen::Index> count, offset;
  Eigen::Index rank = 0;
  double lost = 0;  ///< the largest eigenvalue of K- that was left out, or their working precision if that is larger

  SeparableBasis(const NdTree& tree, const Prior& prior, double tolerance) {
    const Eigen::SelfAdjointEigenSolver<dense::Matrix<T>> ex(prior.kx), ey(prior.ky);
    const Eigen::VectorX<T> lx = prior.variance * ex.eigenvalues().reverse(), ly = ey.eigenvalues().reverse();
    const double precision = std::numeric_limits<double>::epsilon() * static_cast<double>(ly.size()) * lx[0] * ly[0];
    tolerance = std::max(tolerance, precision);
    lost = precision;
    for (Eigen::Index a = 0; a < lx.size(); ++a) {
      Eigen::Index b = 0;
      while (b < ly.size() && ly[b] > 0 && lx[a] * ly[b] > tolerance) ++b;
      if (b < ly.size()) lost = std::max(lost, lx[a] * ly[b]);
      if (b == 0) break;
      offset.push_back(rank);
      count.push_back(b);
      rank += b;
    }
    const auto modes = [&](const auto& eigen, const Eigen::VectorX<T>& value, Eigen::Index n) {
      std::vector<dense::Matrix<T>> f(static_cast<std::size_t>(tree.config().depth) + 1);
      f.back() =
          eigen.eigenvectors().rowwise().reverse().leftCols(n) * value.head(n).cwiseMax(0).cwiseSqrt().asDiagonal();
      for (std::size_t level = f.size() - 1; level-- > 0;) {  // a parent is the average of its children
        const Eigen::Index branches = tree.config().branching, cells = f[level + 1].rows() / branches;
        f[level].setZero(cells, n);
        for (Eigen::Index c = 0; c < branches; ++c)
          f[level] += f[level + 1](Eigen::seqN(c, cells, branches), Eigen::all) / static_cast<double>(branches);
      }
      return f;
    };
    if (rank == 0) throw Error("Latent", "the allowed variance_error leaves no mode of the prior", "a smaller one");
    fx = modes(ex, lx, static_cast<Eigen::Index>(count.size()));
    fy = modes(ey, ly, count.front());
  }

  [[nodiscard]] auto x(const NdTree::Leaf& c) const { return fx[static_cast<std::size_t>(c.level)].row(c.ix); }
  [[nodiscard]] auto y(const NdTree::Leaf& c) const { return fy[static_cast<std::size_t>(c.level)].row(c.iy); }
  [[nodiscard]] Eigen::Index modes() const { return static_cast<Eigen::Index>(count.size()); }
  /// phi of one cell.
  void row(const NdTree::Leaf& c, Eigen::Ref<Eigen::VectorX<T>> phi) const {
    const auto cx = x(c);
    const auto cy = y(c);
    for (Eigen::Index a = 0; a < modes(); ++a) {
      const auto k = static_cast<std::size_t>(a);
      phi.segment(offset[k], count[k]) = cx[a] * cy.head(count[k]).transpose();
    }
  }
};

/// Cells that share a row of the tree (level and iy), so that what depends on fy is computed once for all of them.
template <class T>
struct CellRow {
  std::vector<std::size_t> member;  ///< positions in the list of cells that was grouped
  dense::Matrix<T> x;               ///< modes x members: their fx
};
template <class T>
struct CellRows {
  std::vector<CellRow<T>> row;
  dense::Matrix<T> y;  ///< modes x rows: fy

  /// Groups cells [0, n), cell(k) being a leaf or a parent.
  template <class CellOf>
  CellRows(const SeparableBasis<T>& basis, std::size_t n, CellOf&& cell) {
    std::map<std::pair<int, int>, std::vector<std::size_t>> groups;
    for (std::size_t k = 0; k < n; ++k) {
      const NdTree::Leaf c = cell(k);
      groups[{c.level, c.iy}].push_back(k);
    }
    y.resize(basis.count.front(), static_cast<Eigen::Index>(groups.size()));
    for (auto& [key, member] : groups) {
      y.col(static_cast<Eigen::Index>(row.size())) = basis.y(cell(member.front())).transpose();
      dense::Matrix<T> x(basis.modes(), static_cast<Eigen::Index>(member.size()));
      for (std::size_t k = 0; k < member.size(); ++k)
        x.col(static_cast<Eigen::Index>(k)) = basis.x(cell(member[k])).transpose();
      row.push_back({std::move(member), std::move(x)});
    }
  }
};

}  // namespace vantage::detail

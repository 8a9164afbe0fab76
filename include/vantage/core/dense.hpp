// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>

// Dense symmetric algebra on all threads of the caller's arena: Eigen's kernels on tiles of a fixed size, so that
// results do not depend on the number of threads. Eigen's own decompositions use one thread.
namespace vantage::dense {

using Index = Eigen::Index;
template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <class T>
using MatrixRef = Eigen::Ref<Matrix<T>, 0, Eigen::OuterStride<>>;
template <class T>
using ConstRef = Eigen::Ref<const Matrix<T>, 0, Eigen::OuterStride<>>;

inline constexpr Index tile = 256;

/// f(begin, size) for the tiles of [0, n), concurrently.
template <class F>
void for_tiles(Index n, F&& f, Index size = tile) {
  parallel_for_blocks(static_cast<std::size_t>(n), static_cast<std::size_t>(size),
                      [&](std::size_t b, std::size_t e) { f(static_cast<Index>(b), static_cast<Index>(e - b)); });
}

/// f(row, rows, column, columns) for the tiles of the lower triangle of an n x n matrix, concurrently.
template <class F>
void for_lower_tiles(Index n, F&& f, Index size = tile) {
  const Index blocks = (n + size - 1) / size;
  std::vector<std::pair<Index, Index>> tiles;
  for (Index j = 0; j < blocks; ++j)
    for (Index i = j; i < blocks; ++i) tiles.emplace_back(i * size, j * size);
  parallel_for(tiles.size(), [&](std::size_t t) {
    const auto [i, j] = tiles[t];
    f(i, std::min(size, n - i), j, std::min(size, n - j));
  });
}

/// Lower triangle of C += alpha A^T A; A is k x n. n^2 k flops.
template <class T>
void add_gram(MatrixRef<T> c, const ConstRef<T>& a, T alpha) {
  for_lower_tiles(a.cols(), [&](Index i, Index ni, Index j, Index nj) {
    const auto ai = a.middleCols(i, ni), aj = a.middleCols(j, nj);
    auto cij = c.block(i, j, ni, nj);
    if (i == j)
      cij.template selfadjointView<Eigen::Lower>().rankUpdate(ai.transpose(), alpha);
    else
      cij.noalias() += alpha * (ai.transpose() * aj);
  });
}

/// B <- L^-1 B for the lower triangle L (n x n) and m columns. n^2 m flops.
template <class T>
void solve_lower(const ConstRef<T>& l, MatrixRef<T> b) {
  for_tiles(b.cols(), [&](Index j, Index nj) {
    auto block = b.middleCols(j, nj);
    l.template triangularView<Eigen::Lower>().solveInPlace(block);
  });
}

/// Cholesky factor in the lower triangle, in place (right-looking, tiled); the upper triangle is not touched. n^3 / 3
/// flops. Throws Error naming the row at which the matrix is not positive definite to working precision.
template <class T>
void cholesky(MatrixRef<T> a, std::string_view where = "cholesky") {
  const Index n = a.rows(), size = n > 2048 ? 256 : 96;
  for (Index k = 0; k < n; k += size) {
    const Index nk = std::min(size, n - k), rest = n - k - nk;
    auto diagonal = a.block(k, k, nk, nk);
    Eigen::LLT<Eigen::Ref<Matrix<T>, 0, Eigen::OuterStride<>>> llt(diagonal);
    if (llt.info() != Eigen::Success || !diagonal.diagonal().allFinite())
      throw Error(where, concat("the matrix is not positive definite to working precision near row ", k, " of ", n),
                  "a kernel and a noise variance that make it so");
    if (rest == 0) break;
    auto panel = a.block(k + nk, k, rest, nk);
    for_tiles(rest, [&](Index i, Index ni) {
      auto rows = panel.middleRows(i, ni);
      diagonal.template triangularView<Eigen::Lower>().transpose().template solveInPlace<Eigen::OnTheRight>(rows);
    });
    auto trailing = a.block(k + nk, k + nk, rest, rest);
    for_lower_tiles(rest, [&](Index i, Index ni, Index j, Index nj) {
      const auto pi = panel.middleRows(i, ni), pj = panel.middleRows(j, nj);
      auto t = trailing.block(i, j, ni, nj);
      if (i == j)
        t.template selfadjointView<Eigen::Lower>().rankUpdate(pi, T(-1));
      else
        t.noalias() -= pi * pj.transpose();
    });
  }
}

/// C <- (L L^T)^-1, both triangles, for the lower triangle L. 2 n^3 / 3 flops.
template <class T>
void inverse_from_cholesky(const ConstRef<T>& l, Matrix<T>& c) {
  constexpr Index size = 96;
  const Index n = l.rows();
  Matrix<T> x = Matrix<T>::Zero(n, n);  // L^-1, lower
  for_tiles(
      n,
      [&](Index j, Index nj) {
        auto block = x.block(j, j, n - j, nj);
        block.topRows(nj).setIdentity();
        l.block(j, j, n - j, n - j).template triangularView<Eigen::Lower>().solveInPlace(block);
      },
      size);
  c.resize(n, n);
  for_lower_tiles(
      n,
      [&](Index i, Index ni, Index j, Index nj) {
        c.block(i, j, ni, nj).noalias() = x.block(i, i, n - i, ni).transpose() * x.block(i, j, n - i, nj);
        if (i != j) c.block(j, i, nj, ni) = c.block(i, j, ni, nj).transpose();
      },
      size);
}

}  // namespace vantage::dense

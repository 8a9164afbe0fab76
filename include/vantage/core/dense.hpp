// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
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

// The three products that everything else is made of: one instantiation of Eigen's kernels each, whoever calls them.

/// C += alpha A^T B, on one thread.
template <class T>
void add_tn(MatrixRef<T> c, const ConstRef<T>& a, const ConstRef<T>& b, T alpha) {
  c.noalias() += (alpha * a.transpose()) * b;
}
/// C += alpha A B^T, on one thread.
template <class T>
void add_nt(MatrixRef<T> c, const ConstRef<T>& a, const ConstRef<T>& b, T alpha) {
  c.noalias() += (alpha * a) * b.transpose();
}
/// B <- L^-1 B for the lower triangle L, on one thread.
template <class T>
void solve_lower_serial(const ConstRef<T>& l, MatrixRef<T> b) {
  l.template triangularView<Eigen::Lower>().solveInPlace(b);
}

/// Lower triangle of C += alpha A^T A; A is k x n. The tiles on the diagonal are computed whole. n^2 k flops.
template <class T>
void add_gram(MatrixRef<T> c, const ConstRef<T>& a, T alpha) {
  for_lower_tiles(
      a.cols(),
      [&](Index i, Index ni, Index j, Index nj) {
        add_tn<T>(c.block(i, j, ni, nj), a.middleCols(i, ni), a.middleCols(j, nj), alpha);
      },
      tile / 2);
}

/// B <- L^-1 B for the lower triangle L (n x n) and m columns. n^2 m flops.
template <class T>
void solve_lower(const ConstRef<T>& l, MatrixRef<T> b) {
  for_tiles(b.cols(), [&](Index j, Index nj) { solve_lower_serial<T>(l, b.middleCols(j, nj)); });
}

namespace detail {

inline constexpr Index leaf = 48;  // what recursion ends at
inline Index half(Index n) { return (n / 2 + leaf - 1) / leaf * leaf; }

// B <- B L^-T by halves, on one thread.
template <class T>
void solve_right(const ConstRef<T>& l, MatrixRef<T> b) {
  const Index n = l.rows();
  if (n <= leaf) {
    for (Index j = 0; j < n; ++j) {
      for (Index k = 0; k < j; ++k) b.col(j) -= l(j, k) * b.col(k);
      b.col(j) /= l(j, j);
    }
    return;
  }
  const Index h = half(n), r = n - h;
  solve_right<T>(l.topLeftCorner(h, h), b.leftCols(h));
  add_nt<T>(b.rightCols(r), b.leftCols(h), l.block(h, 0, r, h), T(-1));
  solve_right<T>(l.bottomRightCorner(r, r), b.rightCols(r));
}

// The first column at which the matrix is not positive definite, or -1.
template <class T>
Index cholesky_by_halves(MatrixRef<T> a) {
  const Index n = a.rows();
  if (n <= leaf) {
    for (Index j = 0; j < n; ++j) {
      if (!(a(j, j) > 0)) return j;
      a.col(j).tail(n - j) /= std::sqrt(a(j, j));
      for (Index k = j + 1; k < n; ++k) a.col(k).tail(n - k) -= a(k, j) * a.col(j).tail(n - k);
    }
    return -1;
  }
  const Index h = half(n), r = n - h;
  if (const Index bad = cholesky_by_halves<T>(a.topLeftCorner(h, h)); bad >= 0) return bad;
  auto panel = a.block(h, 0, r, h);
  for_tiles(r, [&](Index i, Index ni) { solve_right<T>(a.topLeftCorner(h, h), panel.middleRows(i, ni)); });
  for_lower_tiles(r, [&](Index i, Index ni, Index j, Index nj) {
    add_nt<T>(a.block(h + i, h + j, ni, nj), panel.middleRows(i, ni), panel.middleRows(j, nj), T(-1));
  });
  const Index bad = cholesky_by_halves<T>(a.bottomRightCorner(r, r));
  return bad < 0 ? bad : h + bad;
}

}  // namespace detail

/// Cholesky factor in the lower triangle, in place; the upper triangle is scratch. By halves, so that nearly all of the
/// n^3 / 3 flops are large products. Throws Error naming the row at which the matrix is not positive definite to
/// working precision; it is then half done.
template <class T>
void cholesky(MatrixRef<T> a, std::string_view where = "cholesky") {
  const Index bad = detail::cholesky_by_halves<T>(a);
  if (bad >= 0 || !a.diagonal().allFinite())
    throw Error(where,
                concat("the matrix is not positive definite to working precision at row ", bad, " of ", a.rows()),
                "a kernel and a noise variance that make it so");
}

/// X = L^-1 for the lower triangle L; zero above. n^3 / 3 flops.
template <class T>
Matrix<T> inverse_lower(const ConstRef<T>& l, Index size = 96) {
  const Index n = l.rows();
  Matrix<T> x = Matrix<T>::Zero(n, n);
  for_tiles(
      n,
      [&](Index j, Index nj) {
        x.block(j, j, nj, nj).setIdentity();
        solve_lower_serial<T>(l.block(j, j, n - j, n - j), x.block(j, j, n - j, nj));
      },
      size);
  return x;
}

/// C <- (L L^T)^-1, both triangles, for the lower triangle L. 2 n^3 / 3 flops.
template <class T>
void inverse_from_cholesky(const ConstRef<T>& l, Matrix<T>& c) {
  const Index n = l.rows();
  const Matrix<T> x = inverse_lower<T>(l);
  c.setZero(n, n);
  for_lower_tiles(
      n,
      [&](Index i, Index ni, Index j, Index nj) {
        add_tn<T>(c.block(i, j, ni, nj), x.block(i, i, n - i, ni), x.block(i, j, n - i, nj), T(1));
        for (Index k = 0; k < nj; ++k)  // the mirror, row by row
          for (Index r = i == j ? k + 1 : 0; r < ni; ++r) c(j + k, i + r) = c(i + r, j + k);
      },
      96);
}

}  // namespace vantage::dense

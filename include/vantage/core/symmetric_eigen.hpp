// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vantage {

/// A = V diag(values) V^T for a small symmetric matrix, by Jacobi's rotations (Golub and Van Loan, "Matrix
/// computations", 8.5): each turns one pair of axes so that their entry vanishes. To working precision relative to the
/// largest eigenvalue. O(N^3) a sweep, 5 to 8 sweeps. It is here because it compiles in a twentieth of the time that
/// Eigen's solver of fixed size takes.
template <int N>
struct SymmetricEigen {
  std::array<double, N> values = {};  ///< in no particular order
  Eigen::Matrix<double, N, N> V;      ///< eigenvectors in the columns

  /// Only the lower triangle of `a` is read. NaN in, NaN out.
  explicit SymmetricEigen(Eigen::Matrix<double, N, N> a) {
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) {
        V(i, j) = i == j ? 1 : 0;
        if (i < j) a(i, j) = a(j, i);
      }
    for (int sweep = 0; sweep < most_sweeps && !is_diagonal(a); ++sweep)
      for (int p = 0; p < N; ++p)
        for (int q = p + 1; q < N; ++q) rotate(a, p, q);
    for (int i = 0; i < N; ++i) values[static_cast<std::size_t>(i)] = a(i, i);
  }

  [[nodiscard]] double smallest() const { return *std::min_element(values.begin(), values.end()); }
  [[nodiscard]] double largest() const { return *std::max_element(values.begin(), values.end()); }
  /// A^-1 b; not finite if A is singular.
  [[nodiscard]] Eigen::Matrix<double, N, 1> solve(const Eigen::Matrix<double, N, 1>& b) const {
    Eigen::Matrix<double, N, 1> x = Eigen::Matrix<double, N, 1>::Zero();
    for (int k = 0; k < N; ++k) {
      double along = 0;
      for (int i = 0; i < N; ++i) along += V(i, k) * b[i];
      along /= values[static_cast<std::size_t>(k)];
      for (int i = 0; i < N; ++i) x[i] += along * V(i, k);
    }
    return x;
  }

 private:
  static constexpr int most_sweeps = 30;

  static bool is_diagonal(const Eigen::Matrix<double, N, N>& a) {
    double off = 0, on = 0;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j <= i; ++j) (i == j ? on : off) += a(i, j) * a(i, j);
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    return off <= epsilon * epsilon / 16 * on;
  }
  void rotate(Eigen::Matrix<double, N, N>& a, int p, int q) {
    if (a(p, q) == 0) return;
    const double half = (a(q, q) - a(p, p)) / (2 * a(p, q));
    const double t = std::copysign(1 / (std::abs(half) + std::hypot(half, 1.0)), half);  // tangent of the angle
    const double c = 1 / std::hypot(t, 1.0), s = t * c;
    const auto turn = [c, s](double& x, double& y) {
      const double old = x;
      x = c * old - s * y;
      y = s * old + c * y;
    };
    for (int k = 0; k < N; ++k) turn(a(k, p), a(k, q));
    for (int k = 0; k < N; ++k) turn(a(p, k), a(q, k));
    for (int k = 0; k < N; ++k) turn(V(k, p), V(k, q));
  }
};

}  // namespace vantage

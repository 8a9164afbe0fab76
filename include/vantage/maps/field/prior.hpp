// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <functional>

#include <vantage/maps/field/kernel.hpp>
#include <vantage/maps/field/nd_tree.hpp>

namespace vantage {

/// The prior over the cells of a full-depth tree (eq. 3.5). A separable kernel over a regular grid is a Kronecker
/// product, K-(i, j) = variance Kx(ix_i, ix_j) Ky(iy_i, iy_j): two small Toeplitz matrices say it all.
struct Prior {
  double mean = 0, variance = 1;
  Eigen::MatrixXd kx, ky;  ///< resolution x resolution
  std::function<double(const Interval&, const Interval&)> correlation =
      {};  ///< one axis' factor, for cells of any level

  template <class Cells, SeparableKernel K>
  static Prior make(const NdTree& tree, double mean, const K& kernel, Cells = {}) {
    const int n = tree.resolution(), depth = tree.config().depth;
    const auto toeplitz = [&](auto&& interval) {
      Eigen::VectorXd c(n);
      for (int d = 0; d < n; ++d) {
        c[d] = Cells::correlation(kernel, interval(0), interval(d));
        if (std::abs(c[d]) < 1e-100) c[d] = 0;  // denormal products slow every later factorisation
      }
      Eigen::MatrixXd k(n, n);
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) k(i, j) = c[std::abs(i - j)];
      return k;
    };
    return {mean, kernel.variance, toeplitz([&](int i) { return tree.x_interval(depth, i); }),
            toeplitz([&](int i) { return tree.y_interval(depth, i); }),
            [kernel](const Interval& a, const Interval& b) { return Cells::correlation(kernel, a, b); }};
  }
};

}  // namespace vantage

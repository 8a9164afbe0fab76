// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <string_view>

#include <vantage/maps/field/kernel.hpp>
#include <vantage/maps/field/matern.hpp>

// Kernels between points in any dimension, on blocks, in vectorised form.
namespace vantage {

/// In place: squared distances over squared lengths, q = (d / l)^2, become correlations c(d); where `slope` is asked
/// for, it becomes d log c / d log l. To use a kernel of your own for regression, overload this for it.
inline void correlate(const SquaredExponential&, Eigen::Ref<Eigen::ArrayXXd> q, Eigen::ArrayXXd* slope = nullptr) {
  if (slope) *slope = q;
  q = (-0.5 * q).exp();
}
template <int P, int Q>
void correlate(const Matern<P, Q>&, Eigen::Ref<Eigen::ArrayXXd> q, Eigen::ArrayXXd* slope = nullptr) {
  q = (static_cast<double>(P) * q).sqrt();  // s = sqrt(2 nu) d / l
  if constexpr (P == 1) {
    if (slope) *slope = q;
    q = (-q).exp();
  }
  if constexpr (P == 3) {
    if (slope) *slope = q.square() / (1 + q);
    q = (1 + q) * (-q).exp();
  }
  if constexpr (P == 5) {
    if (slope) *slope = q.square() * (1 + q) / (3 + 3 * q + q.square());
    q = (1 + q + q.square() / 3) * (-q).exp();
  }
}

/// A kernel that regression over points can use.
template <class K>
concept PointKernel = SeparableKernel<K> && requires(const K k, Eigen::ArrayXXd q, Eigen::ArrayXXd* slope) {
  correlate(k, q, slope);
};

/// Points as rows: n x D, so that one coordinate of all points is contiguous.
using Points = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic>;

/// The kernel of the Euclidean distance, k(x, x') = sigma^2 c(|x - x'|): what is commonly meant by a Matern.
struct Isotropic {
  static constexpr std::string_view name = "isotropic";
  /// c(i, j) of rows [a, a + c.rows()) of x and [b, b + c.cols()) of y; differences, not products, so that near points
  /// keep their digits. `slope`: d log c / d log l.
  template <PointKernel K>
  static void correlations(const K& kernel, const Points& x, Eigen::Index a, const Points& y, Eigen::Index b,
                           Eigen::Ref<Eigen::ArrayXXd> c, Eigen::ArrayXXd* slope = nullptr) {
    const double scale = 1 / kernel.length_m;
    for (Eigen::Index j = 0; j < c.cols(); ++j) {
      auto column = c.col(j);
      column = ((x.col(0).segment(a, c.rows()) - y(b + j, 0)) * scale).square();
      for (Eigen::Index k = 1; k < x.cols(); ++k)
        column += ((x.col(k).segment(a, c.rows()) - y(b + j, k)) * scale).square();
    }
    correlate(kernel, c, slope);
  }
};

/// The product of one-dimensional kernels over the axes, as the maps' cells use it. The same as Isotropic for the
/// squared exponential, and only for it.
struct Product {
  static constexpr std::string_view name = "product";
  template <PointKernel K>
  static void correlations(const K& kernel, const Points& x, Eigen::Index a, const Points& y, Eigen::Index b,
                           Eigen::Ref<Eigen::ArrayXXd> c, Eigen::ArrayXXd* slope = nullptr) {
    const double scale = 1 / kernel.length_m;
    Eigen::ArrayXXd axis(c.rows(), c.cols()), axis_slope;
    for (Eigen::Index k = 0; k < x.cols(); ++k) {
      for (Eigen::Index j = 0; j < c.cols(); ++j)
        axis.col(j) = ((x.col(k).segment(a, c.rows()) - y(b + j, k)) * scale).square();
      correlate(kernel, axis, slope ? &axis_slope : nullptr);
      if (k == 0) {
        c = axis;
        if (slope) *slope = axis_slope;
      } else {
        c *= axis;
        if (slope) *slope += axis_slope;
      }
    }
  }
};

}  // namespace vantage

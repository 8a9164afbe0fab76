// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <vantage/core/dense.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/large_matrix.hpp>
#include <vantage/maps/field/point_kernel.hpp>

namespace vantage {

/// Means and variances of the function (not of noisy measurements of it) at query points.
struct Prediction {
  Eigen::VectorXd mean, variance;
};

/// Gaussian-process regression over points in any dimension, eqs. 2.5 to 2.8: a constant mean, independent noise of
/// equal variance. `Form` says how the one-dimensional kernel becomes one of points: Isotropic (default) or Product.
///
/// The constructor fits: n^3 / 3 flops and n^2 numbers. Const members are thread-safe.
///
///     GpRegression<Matern32> gp({.kernel = {2, 40}, .noise_variance = 0.1}, points, values);
///     Prediction p = gp.predict(queries);
template <PointKernel Kernel = SquaredExponential, class Form = Isotropic>
class GpRegression {
 public:
  struct Config {
    Kernel kernel = {};
    double noise_variance = 0.01;  ///< sigma^2 of eq. 2.4, > 0, in the values' unit squared
    double mean = 0;               ///< constant mu, finite
  };

  /// `points` is n x D [m], a row a point; `values` holds n. Throws Error on sizes that disagree, values that are not
  /// finite or a covariance that is not positive definite to working precision.
  GpRegression(const Config& config, Points points, Eigen::VectorXd values)
      : config_(validated(config)), points_(std::move(points)), values_(std::move(values)) {
    constexpr std::string_view where = "GpRegression";
    const Eigen::Index n = points_.rows();
    if (n == 0 || points_.cols() == 0)
      throw Error(where, concat(n, " points of ", points_.cols(), " dimensions"), "at least one of each");
    if (values_.size() != n) throw Error(where, concat(values_.size(), " values for ", n, " points"), "one each");
    if (!points_.allFinite() || !values_.allFinite())
      throw Error(where, "a point or a value is not finite", "finite numbers");
    factor_ = LargeMatrix<double>(n, n);
    auto k = factor_.map();
    dense::for_lower_tiles(
        n,
        [&](Eigen::Index i, Eigen::Index ni, Eigen::Index j, Eigen::Index nj) {
          thread_local Eigen::ArrayXXd c;
          c.resize(ni, nj);
          Form::correlations(config_.kernel, points_, i, points_, j, c);
          k.block(i, j, ni, nj) = config_.kernel.variance * c;
        },
        128);
    k.diagonal().array() += config_.noise_variance;
    dense::cholesky<double>(k, where);
    alpha_ = values_.array() - config_.mean;
    lower().solveInPlace(alpha_);
    half_quadratic_ = 0.5 * alpha_.squaredNorm();
    lower().adjoint().solveInPlace(alpha_);
  }

  /// Eqs. 2.7 and 2.8 at m query points (m x D): m n^2 flops. Queries run in blocks, concurrently, so that no n x m
  /// matrix is held. Throws Error on a wrong dimension or queries that are not finite.
  [[nodiscard]] Prediction predict(const Points& queries) const {
    check(queries);
    Prediction p;
    p.mean.resize(queries.rows());
    p.variance.resize(queries.rows());
    constexpr Eigen::Index block = 256;
    dense::for_tiles(
        queries.rows(),
        [&](Eigen::Index begin, Eigen::Index count) {
          Eigen::MatrixXd k = covariance(queries, begin, count);
          p.mean.segment(begin, count).noalias() = k.transpose() * alpha_;
          p.mean.segment(begin, count).array() += config_.mean;
          forward(k);
          p.variance.segment(begin, count) =
              (config_.kernel.variance - k.colwise().squaredNorm().array()).max(0.0).transpose();
        },
        block);
    return p;
  }
  /// Eq. 2.7 alone: m n flops.
  [[nodiscard]] Eigen::VectorXd predict_mean(const Points& queries) const {
    check(queries);
    Eigen::VectorXd mean(queries.rows());
    dense::for_tiles(queries.rows(), [&](Eigen::Index begin, Eigen::Index count) {
      mean.segment(begin, count).noalias() = covariance(queries, begin, count).transpose() * alpha_;
      mean.segment(begin, count).array() += config_.mean;
    });
    return mean;
  }

  /// Eq. 2.4 of the values it was fitted to.
  [[nodiscard]] double log_marginal_likelihood() const {
    const auto n = static_cast<double>(size());
    return -half_quadratic_ - factor_.map().diagonal().array().log().sum() - 0.5 * n * std::log(2 * std::numbers::pi);
  }

  /// For each value, what the others predict for it (noise included in the variance), without n fits: Rasmussen &
  /// Williams 2006, eq. 5.12. 2 n^3 / 3 flops.
  [[nodiscard]] Prediction leave_one_out() const {
    Eigen::MatrixXd inverse;
    dense::inverse_from_cholesky<double>(factor_.map(), inverse);
    return {values_.array() - alpha_.array() / inverse.diagonal().array(), inverse.diagonal().array().inverse()};
  }

  [[nodiscard]] Eigen::Index size() const { return points_.rows(); }
  [[nodiscard]] const Config& config() const { return config_; }

 private:
  static const Config& validated(const Config& c) {
    Check check("GpRegression::Config");
    check.positive("noise_variance", c.noise_variance);
    check.finite("mean", c.mean);
    check.done();
    c.kernel.validate();
    return c;
  }
  void check(const Points& queries) const {
    if (queries.rows() != 0 && queries.cols() != points_.cols())
      throw Error("GpRegression::predict", concat("queries of dimension ", queries.cols()), concat(points_.cols()));
    if (!queries.allFinite()) throw Error("GpRegression::predict", "a query is not finite", "finite numbers");
  }
  [[nodiscard]] auto lower() const { return factor_.map().template triangularView<Eigen::Lower>(); }

  // K_{X, X*} for some queries, n x count.
  [[nodiscard]] Eigen::MatrixXd covariance(const Points& queries, Eigen::Index begin, Eigen::Index count) const {
    constexpr Eigen::Index rows = 128;
    Eigen::MatrixXd k(size(), count);
    Eigen::ArrayXXd c;
    for (Eigen::Index i = 0; i < size(); i += rows) {
      c.resize(std::min(rows, size() - i), count);
      Form::correlations(config_.kernel, points_, i, queries, begin, c);
      k.middleRows(i, c.rows()) = config_.kernel.variance * c;
    }
    return k;
  }
  // k <- L^-1 k, on this thread: left-looking by blocks of rows, so that nearly all of it is matrix products.
  void forward(Eigen::MatrixXd& k) const {
    constexpr Eigen::Index block = 256;
    const auto l = factor_.map();
    for (Eigen::Index i = 0; i < size(); i += block) {
      const Eigen::Index ni = std::min(block, size() - i);
      auto rows = k.middleRows(i, ni);
      if (i != 0) rows.noalias() -= l.block(i, 0, ni, i) * k.topRows(i);
      l.block(i, i, ni, ni).template triangularView<Eigen::Lower>().solveInPlace(rows);
    }
  }

  Config config_;
  Points points_;
  Eigen::VectorXd values_, alpha_;  // alpha = (K + sigma^2 I)^-1 (y - mu)
  LargeMatrix<double> factor_;      // its Cholesky factor, lower triangle
  double half_quadratic_ = 0;       // (y - mu)^T alpha / 2
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <vantage/core/dense.hpp>
#include <vantage/core/error.hpp>
#include <vantage/maps/field/regression.hpp>

namespace vantage {

/// The logarithm of the marginal likelihood, eq. 2.4, of values at points, as a function of the logarithms of
/// {variance, length, noise variance}, with its gradient (Rasmussen & Williams 2006, eq. 5.9). The constant mean is
/// given, or the one that maximises the likelihood under each hyperparameters (generalised least squares). Immutable;
/// thread-safe.
template <PointKernel Kernel = SquaredExponential, class Form = Isotropic>
class MarginalLikelihood {
 public:
  using Parameters = Eigen::Vector3d;  ///< log variance, log length [m], log noise variance

  /// `points` is n x D, `values` n. Throws Error on sizes that disagree or numbers that are not finite.
  MarginalLikelihood(Points points, Eigen::VectorXd values, std::optional<double> mean = std::nullopt)
      : points_(std::move(points)), values_(std::move(values)), mean_(mean) {
    constexpr std::string_view where = "MarginalLikelihood";
    if (points_.rows() < 2 || points_.cols() == 0)
      throw Error(where, concat(points_.rows(), " points of ", points_.cols(), " dimensions"), "at least two points");
    if (values_.size() != points_.rows())
      throw Error(where, concat(values_.size(), " values for ", points_.rows(), " points"), "one each");
    if (!points_.allFinite() || !values_.allFinite() || !std::isfinite(mean.value_or(0)))
      throw Error(where, "a point, a value or the mean is not finite", "finite numbers");
  }

  struct Value {
    double log_likelihood = -std::numeric_limits<double>::infinity();
    Parameters gradient = Parameters::Zero();
    double mean = 0;
  };
  /// -infinity where the covariance is not positive definite to working precision. About 4 n^3 / 3 flops, 2 n^2
  /// numbers.
  [[nodiscard]] Value operator()(const Parameters& p) const {
    const Eigen::Index n = values_.size();
    const double noise = std::exp(p[2]);
    const Kernel kernel = kernel_of(p);
    Eigen::MatrixXd factor(n, n);
    dense::for_lower_tiles(
        n,
        [&](Eigen::Index i, Eigen::Index ni, Eigen::Index j, Eigen::Index nj) {
          Eigen::ArrayXXd c(ni, nj);
          Form::correlations(kernel, points_, i, points_, j, c);
          factor.block(i, j, ni, nj) = kernel.variance * c;
        },
        tile);
    factor.diagonal().array() += noise;
    Value v;
    try {
      dense::cholesky<double>(factor);
    } catch (const Error&) { return v; }
    const auto solve = [&](Eigen::VectorXd b) {
      factor.triangularView<Eigen::Lower>().solveInPlace(b);
      factor.triangularView<Eigen::Lower>().adjoint().solveInPlace(b);
      return b;
    };
    const Eigen::VectorXd ones = solve(Eigen::VectorXd::Ones(n));
    v.mean = mean_.value_or(ones.dot(values_) / ones.sum());
    const Eigen::VectorXd residual = values_.array() - v.mean, alpha = solve(residual);
    v.log_likelihood = -0.5 * residual.dot(alpha) - factor.diagonal().array().log().sum() -
                       0.5 * static_cast<double>(n) * std::log(2 * std::numbers::pi);

    // Half the sum of (alpha alpha^T - K^-1) times dK, entry by entry; by tiles, added in their order.
    Eigen::MatrixXd inverse;
    dense::inverse_from_cholesky<double>(factor, inverse);
    const Eigen::Index tiles = (n + tile - 1) / tile;
    std::vector<Parameters> part(static_cast<std::size_t>(tiles * tiles), Parameters::Zero());
    dense::for_lower_tiles(
        n,
        [&](Eigen::Index i, Eigen::Index ni, Eigen::Index j, Eigen::Index nj) {
          Eigen::ArrayXXd c(ni, nj), slope;
          Form::correlations(kernel, points_, i, points_, j, c, &slope);
          c *= kernel.variance * ((alpha.segment(i, ni) * alpha.segment(j, nj).transpose()).array() -
                                  inverse.block(i, j, ni, nj).array());
          const double times = i == j ? 0.5 : 1;  // tiles below the diagonal stand for those above it
          part[static_cast<std::size_t>(i / tile * tiles + j / tile)] = {times * c.sum(), times * (c * slope).sum(), 0};
        },
        tile);
    for (const Parameters& g : part) v.gradient += g;
    v.gradient[2] = 0.5 * noise * (alpha.squaredNorm() - inverse.trace());
    return v;
  }

  static Kernel kernel_of(const Parameters& p) {
    Kernel kernel;
    kernel.variance = std::exp(p[0]);
    kernel.length_m = std::exp(p[1]);
    return kernel;
  }
  [[nodiscard]] const Points& points() const { return points_; }
  [[nodiscard]] const Eigen::VectorXd& values() const { return values_; }

 private:
  static constexpr Eigen::Index tile = 128;
  Points points_;
  Eigen::VectorXd values_;
  std::optional<double> mean_;
};

struct MaximumConfig {
  int iterations = 100;     ///< at most, 1 to 10000
  double tolerance = 1e-5;  ///< stops where no free component of the gradient is larger, > 0
  double longest_step = 1;  ///< > 0
};

/// Maximum of a smooth function in a box, from a start inside it: BFGS with the bounds that hold it back kept fixed for
/// a step, and backtracking. `f(x)` has log_likelihood, which may be -infinity, and gradient. Returns the best x found,
/// f there, and whether the gradient vanished.
template <class F, class Vector>
auto maximise(const F& f, Vector x, const Vector& low, const Vector& high, const MaximumConfig& config = {}) {
  using Matrix = Eigen::Matrix<double, Vector::RowsAtCompileTime, Vector::RowsAtCompileTime>;
  struct Maximum {
    Vector x;
    decltype(f(x)) at;
    int evaluations = 1;
    bool converged = false;
  };
  const Eigen::Index n = x.size();
  Maximum best{x, f(x)};
  Matrix inverse = Matrix::Identity(n, n);  // of minus the Hessian
  for (int iteration = 0; iteration < config.iterations && std::isfinite(best.at.log_likelihood); ++iteration) {
    Vector free = Vector::Ones(n);
    for (Eigen::Index i = 0; i < n; ++i)
      if ((best.x[i] <= low[i] && best.at.gradient[i] < 0) || (best.x[i] >= high[i] && best.at.gradient[i] > 0))
        free[i] = 0;
    const Vector gradient = best.at.gradient.cwiseProduct(free);
    if (gradient.template lpNorm<Eigen::Infinity>() < config.tolerance) {
      best.converged = true;
      break;
    }
    Vector step = (inverse * gradient).cwiseProduct(free);
    if (!(step.dot(gradient) > 0)) {
      inverse.setIdentity(n, n);
      step = gradient;
    }
    step *= std::min(1.0, config.longest_step / step.template lpNorm<Eigen::Infinity>());
    bool moved = false;
    for (int halving = 0; halving < 40 && !moved; ++halving, step *= 0.5) {
      const Vector next = (best.x + step).cwiseMax(low).cwiseMin(high), s = next - best.x;
      if (s.isZero(0)) break;
      const auto there = f(next);
      ++best.evaluations;
      if (!(there.log_likelihood >= best.at.log_likelihood + 1e-4 * gradient.dot(s))) continue;
      const Vector y = best.at.gradient - there.gradient;  // of -f, the gradient's change
      if (const double sy = s.dot(y); sy > 1e-10 * s.norm() * y.norm()) {
        if (iteration == 0) inverse *= sy / y.squaredNorm();
        const Matrix left = Matrix::Identity(n, n) - s * y.transpose() / sy;
        inverse = left * inverse * left.transpose() + s * s.transpose() / sy;
      }
      best.x = next;
      best.at = there;
      moved = true;
    }
    if (moved) continue;
    if (inverse.isIdentity(0)) break;  // not even uphill: as good as the arithmetic allows
    inverse.setIdentity(n, n);
  }
  return best;
}

/// Hyperparameters and what they are worth.
template <class Regression>
struct HyperparameterFit {
  typename Regression::Config config;  ///< kernel, noise variance, mean: ready for regression; the kernel for maps
  double log_likelihood = 0;
  bool converged = false;  ///< the gradient vanished, but for bounds that were reached
  int evaluations = 0;
};

/// Hyperparameters by maximum marginal likelihood, eq. 2.3, from an earlier campaign's samples: `points` n x D [m],
/// `values` n. The best of four starts, at lengths from 1/30 to the whole of the points' extent. Bounds: lengths from
/// 1/1000 to 10 extents, variance from 1e-6 to 1e4 and noise variance from 1e-8 to 10 times that of the values. `Form`:
/// Isotropic for regression, Product for the kernel of a map's cells (the same for the squared exponential).
///
/// Some 60 to 150 likelihoods, see MarginalLikelihood: above some 2000 samples, give every k-th. The same bits with
/// any number of threads. Throws Error on input that is not finite, fewer than 3 samples, points at one place, equal
/// values.
template <PointKernel Kernel = SquaredExponential, class Form = Isotropic>
HyperparameterFit<GpRegression<Kernel, Form>> fit_hyperparameters(Points points, Eigen::VectorXd values,
                                                                  std::optional<double> mean = std::nullopt,
                                                                  const MaximumConfig& config = {}) {
  constexpr std::string_view where = "fit_hyperparameters";
  Check check(where);
  check(config.iterations >= 1 && config.iterations <= 10000, "iterations", config.iterations, "1 to 10000");
  check.positive("tolerance", config.tolerance);
  check.positive("longest_step", config.longest_step);
  check.done();
  const MarginalLikelihood<Kernel, Form> likelihood(std::move(points), std::move(values), mean);
  const Eigen::VectorXd& y = likelihood.values();
  const Points& x = likelihood.points();
  const double spread = (y.array() - mean.value_or(y.mean())).square().mean();
  const double extent = (x.colwise().maxCoeff() - x.colwise().minCoeff()).maxCoeff();
  if (y.size() < 3) throw Error(where, concat(y.size(), " samples"), "at least 3");
  if (!(extent > 0)) throw Error(where, "all points are at one place", "points apart");
  if (!(spread > 0)) throw Error(where, "all values are equal", "values that vary");
  using P = Eigen::Vector3d;
  const auto logs = [&](double variance, double length, double noise) {
    return P(std::log(variance * spread), std::log(length * extent), std::log(noise * spread));
  };
  const P low = logs(1e-6, 1e-3, 1e-8), high = logs(1e4, 10, 10);
  HyperparameterFit<GpRegression<Kernel, Form>> best;
  best.log_likelihood = -std::numeric_limits<double>::infinity();
  int evaluations = 0;
  for (const double length : {1.0 / 30, 0.1, 0.3, 1.0}) {
    const auto found = maximise(likelihood, logs(0.8, length, 0.2), low, high, config);
    evaluations += found.evaluations;
    if (!(found.at.log_likelihood > best.log_likelihood)) continue;
    best = {{.kernel = likelihood.kernel_of(found.x), .noise_variance = std::exp(found.x[2]), .mean = found.at.mean},
            found.at.log_likelihood,
            found.converged,
            0};
  }
  if (!std::isfinite(best.log_likelihood))
    throw Error(where, "no start has a covariance that is positive definite to working precision",
                "points that are not all but equal");
  best.evaluations = evaluations;
  return best;
}

}  // namespace vantage

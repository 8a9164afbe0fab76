// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include <vantage/core/rng.hpp>
#include <vantage/maps/field/hyperparameters.hpp>

namespace {

using namespace vantage;

Points random_points(Eigen::Index n, double extent, Rng& rng) {
  return Points::NullaryExpr(n, 2, [&] { return rng.uniform(0, extent); });
}
// A sample of the Gaussian process itself, with noise.
template <class Form, class Kernel>
Eigen::VectorXd sample(const Kernel& kernel, double noise_variance, double mean, const Points& x, Rng& rng) {
  const Eigen::Index n = x.rows();
  Eigen::ArrayXXd c(n, n);
  Form::correlations(kernel, x, 0, x, 0, c);
  Eigen::MatrixXd k = kernel.variance * c;
  k.diagonal().array() += noise_variance;
  const Eigen::VectorXd z = Eigen::VectorXd::NullaryExpr(n, [&] { return rng.normal(); });
  return (k.llt().matrixL() * z).array() + mean;
}

template <class K, class Form>
struct Case {
  using Kernel = K;
  using FormType = Form;
};
template <class C>
struct Hyperparameters : testing::Test {};
using Cases = testing::Types<Case<SquaredExponential, Isotropic>, Case<Matern12, Product>, Case<Matern32, Isotropic>,
                             Case<Matern52, Product>>;
TYPED_TEST_SUITE(Hyperparameters, Cases);

TYPED_TEST(Hyperparameters, GradientIsThatOfCentralDifferences) {
  Rng rng(1);
  const Points x = random_points(150, 10, rng);  // more than one tile
  const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(150, [&] { return rng.normal(); });
  for (const std::optional<double> mean : {std::optional<double>(), std::optional<double>(0.4)}) {
    const MarginalLikelihood<typename TypeParam::Kernel, typename TypeParam::FormType> likelihood(x, y, mean);
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(0.2, 0.3, -1), Eigen::Vector3d(-1, 1.2, -2.5), Eigen::Vector3d(1, -0.7, 0.1)}) {
      const Eigen::Vector3d gradient = likelihood(p).gradient;
      for (int k = 0; k < 3; ++k) {
        const double h = 1e-4;
        const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(k);
        const double numerical = (likelihood(p + d).log_likelihood - likelihood(p - d).log_likelihood) / (2 * h);
        EXPECT_NEAR(gradient[k], numerical, 1e-5 * (1 + std::abs(numerical)))
            << "parameter " << k << " at " << p.transpose();
      }
    }
  }
}

TYPED_TEST(Hyperparameters, ValueIsThatOfTheRegression) {
  using Regression = GpRegression<typename TypeParam::Kernel, typename TypeParam::FormType>;
  Rng rng(2);
  const Points x = random_points(140, 10, rng);
  const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(140, [&] { return rng.normal(); });
  const MarginalLikelihood<typename TypeParam::Kernel, typename TypeParam::FormType> likelihood(x, y);
  const Eigen::Vector3d p(0.3, 0.1, -1.5);
  const auto v = likelihood(p);
  typename Regression::Config c{
      .kernel = {std::exp(p[0]), std::exp(p[1])}, .noise_variance = std::exp(p[2]), .mean = v.mean};
  EXPECT_NEAR(v.log_likelihood, Regression(c, x, y).log_marginal_likelihood(), 1e-9);
  for (const double off : {-0.01, 0.01}) {  // the mean is the best one
    c.mean = v.mean + off;
    EXPECT_LT(Regression(c, x, y).log_marginal_likelihood(), v.log_likelihood);
  }
}

// 200 samples over 8 x 8 lengths, 5 draws. The truth is never likelier, and not much less likely either: twice the gain
// in log likelihood is chi-squared with 4 degrees of freedom, above 20 once in 2000. Logarithms of variance and length
// are right to 0.45 in the mean square (so few independent patches say no more), that of the noise to 0.3, but for the
// Matern 1/2, on which noise cannot be told from roughness.
TYPED_TEST(Hyperparameters, RecoversThoseThatSamplesWereDrawnWith) {
  using Kernel = typename TypeParam::Kernel;
  using Form = typename TypeParam::FormType;
  const Kernel truth{.variance = 2.5, .length_m = 1.7};
  const double noise = 0.3;
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  const int draws = 5;
  for (int draw = 0; draw < draws; ++draw) {
    Rng rng(static_cast<std::uint64_t>(100 + draw));
    const Points x = random_points(200, 14, rng);
    const Eigen::VectorXd y = sample<Form>(truth, noise, 11, x, rng);
    const auto fit = fit_hyperparameters<Kernel, Form>(x, y);
    EXPECT_TRUE(fit.converged) << "draw " << draw;
    EXPECT_LT(fit.evaluations, 400);
    EXPECT_NEAR(fit.config.mean, 11, 1.5);
    const MarginalLikelihood<Kernel, Form> likelihood(x, y);
    const double gain = fit.log_likelihood - likelihood({std::log(2.5), std::log(1.7), std::log(noise)}).log_likelihood;
    EXPECT_GE(gain, 0);
    EXPECT_LT(2 * gain, 20);
    square += Eigen::Vector3d(std::log(fit.config.kernel.variance / 2.5), std::log(fit.config.kernel.length_m / 1.7),
                              std::log(fit.config.noise_variance / noise))
                  .cwiseAbs2() /
              draws;
  }
  EXPECT_LT(std::sqrt(square[0]), 0.45);
  EXPECT_LT(std::sqrt(square[1]), 0.45);
  if (!std::is_same_v<Kernel, Matern12>) { EXPECT_LT(std::sqrt(square[2]), 0.3); }
}

TEST(HyperparameterFit, GiveTheSameBitsWithAnyNumberOfThreads) {
  Rng rng(3);
  const Points x = random_points(300, 10, rng);
  const Eigen::VectorXd y = sample<Isotropic>(Matern32{1, 2}, 0.1, 0, x, rng);
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const auto run = [&](int threads) {
    double likelihood = 0;
    tbb::task_arena(threads).execute([&] { likelihood = fit_hyperparameters<Matern32>(x, y).log_likelihood; });
    return likelihood;
  };
  const double one = run(1);
  EXPECT_EQ(run(2), one);
  EXPECT_EQ(run(8), one);
}

TEST(HyperparameterFit, OfWhiteNoiseAreNoise) {
  Rng rng(4);
  const Points x = random_points(200, 10, rng);
  const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(200, [&] { return 3 * rng.normal(); });
  const auto fit = fit_hyperparameters(x, y, 0.0);
  EXPECT_NEAR(fit.log_likelihood,
              MarginalLikelihood<>(x, y, 0.0)({-20, 0, std::log(y.squaredNorm() / 200)}).log_likelihood, 3);
  EXPECT_EQ(fit.config.mean, 0);
}

TEST(HyperparameterFit, BadSamplesAreRefused) {
  Rng rng(5);
  const Points x = random_points(5, 10, rng);
  const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(5, 0, 1);
  EXPECT_THROW((void)fit_hyperparameters(x, Eigen::VectorXd(y.head(4))), Error);
  EXPECT_THROW((void)fit_hyperparameters(x.topRows(2), Eigen::VectorXd(y.head(2))), Error);
  EXPECT_THROW((void)fit_hyperparameters(Points::Ones(5, 2), y), Error);
  EXPECT_THROW((void)fit_hyperparameters(x, Eigen::VectorXd::Ones(5)), Error);
  EXPECT_THROW((void)fit_hyperparameters(x, Eigen::VectorXd::Constant(5, std::nan(""))), Error);
  EXPECT_THROW((void)fit_hyperparameters(x, y, std::numeric_limits<double>::infinity()), Error);
  EXPECT_THROW((void)fit_hyperparameters(x, y, std::nullopt, {.iterations = 0}), Error);
}

// Rosenbrock's valley, upside down, whose maximum a bound cuts off.
TEST(Maximise, FindsAMaximumInsideAndAtABound) {
  struct Value {
    double log_likelihood;
    Eigen::Vector2d gradient;
  };
  const auto f = [](const Eigen::Vector2d& x) {
    const double a = 1 - x[0], b = x[1] - x[0] * x[0];
    return Value{-a * a - 100 * b * b, {2 * a + 400 * b * x[0], -200 * b}};
  };
  const Eigen::Vector2d start(-1.2, 1), low(-2, -2), high(2, 2);
  const auto inside = maximise(f, start, low, high, {.iterations = 500});
  EXPECT_TRUE(inside.converged);
  EXPECT_LT((inside.x - Eigen::Vector2d(1, 1)).norm(), 1e-5);
  const auto bound = maximise(f, start, low, Eigen::Vector2d(0.5, 2), {.iterations = 500});
  EXPECT_TRUE(bound.converged);
  EXPECT_LT((bound.x - Eigen::Vector2d(0.5, 0.25)).norm(), 1e-6);
}

}  // namespace

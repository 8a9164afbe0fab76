// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include <vantage/core/rng.hpp>
#include <vantage/maps/field/regression.hpp>

namespace {

using namespace vantage;

Points random_points(Eigen::Index n, Eigen::Index dimension, Rng& rng) {
  return Points::NullaryExpr(n, dimension, [&] { return rng.uniform(0, 10); });
}

// The definition, one pair at a time.
template <class K>
double entry(const K& k, Isotropic, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return k.variance * k.correlation((a - b).norm());
}
template <class K>
double entry(const K& k, Product, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double c = k.variance;
  for (Eigen::Index i = 0; i < a.size(); ++i) c *= k.correlation(a[i] - b[i]);
  return c;
}
template <class K, class Form>
Eigen::MatrixXd matrix(const K& kernel, Form form, const Points& x, const Points& y) {
  Eigen::MatrixXd k(x.rows(), y.rows());
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    for (Eigen::Index j = 0; j < y.rows(); ++j)
      k(i, j) = entry(kernel, form, x.row(i).transpose().matrix(), y.row(j).transpose().matrix());
  return k;
}

template <class K, class Form>
struct Case {
  using Kernel = K;
  using FormType = Form;
};
template <class C>
struct Regression : testing::Test {};
using Cases = testing::Types<Case<SquaredExponential, Isotropic>, Case<SquaredExponential, Product>,
                             Case<Matern12, Isotropic>, Case<Matern12, Product>, Case<Matern32, Isotropic>,
                             Case<Matern32, Product>, Case<Matern52, Isotropic>, Case<Matern52, Product>>;
TYPED_TEST_SUITE(Regression, Cases);

TYPED_TEST(Regression, IsTheDefinition) {
  using Kernel = typename TypeParam::Kernel;
  using Form = typename TypeParam::FormType;
  Rng rng(1);
  for (const Eigen::Index dimension : {1, 2, 3}) {
    const Eigen::Index n = 300;  // more than one tile
    const Points x = random_points(n, dimension, rng), q = random_points(270, dimension, rng);
    const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(n, [&] { return rng.normal(); });
    const typename GpRegression<Kernel, Form>::Config c{
        .kernel = {.variance = 2, .length_m = 1.5}, .noise_variance = 0.05, .mean = 0.3};
    const GpRegression<Kernel, Form> gp(c, x, y);
    const Prediction p = gp.predict(q);

    Eigen::MatrixXd k = matrix(c.kernel, Form{}, x, x);
    k.diagonal().array() += c.noise_variance;
    const Eigen::MatrixXd inverse = k.inverse(), kq = matrix(c.kernel, Form{}, q, x);
    const Eigen::VectorXd mean = (kq * inverse * (y.array() - c.mean).matrix()).array() + c.mean;
    const Eigen::VectorXd variance = c.kernel.variance - (kq * inverse).cwiseProduct(kq).rowwise().sum().array();
    EXPECT_LT((p.mean - mean).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((p.variance - variance).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((gp.predict_mean(q) - mean).cwiseAbs().maxCoeff(), 1e-9);

    const Eigen::VectorXd r = y.array() - c.mean;
    const double likelihood = -0.5 * r.dot(inverse * r) -
                              0.5 * k.partialPivLu().matrixLU().diagonal().array().abs().log().sum() -
                              0.5 * n * std::log(2 * std::acos(-1.0));
    EXPECT_NEAR(gp.log_marginal_likelihood(), likelihood, 1e-7);
  }
}

TYPED_TEST(Regression, SlopeIsTheDerivativeByTheLogarithmOfTheLength) {
  using Form = typename TypeParam::FormType;
  Rng rng(2);
  const Points x = random_points(20, 2, rng), y = random_points(30, 2, rng);
  typename TypeParam::Kernel kernel{.variance = 1, .length_m = 2.5};
  Eigen::ArrayXXd c(20, 30), slope, up(20, 30), down(20, 30);
  Form::correlations(kernel, x, 0, y, 0, c, &slope);
  const double h = 1e-5;
  kernel.length_m = 2.5 * std::exp(h);
  Form::correlations(kernel, x, 0, y, 0, up);
  kernel.length_m = 2.5 * std::exp(-h);
  Form::correlations(kernel, x, 0, y, 0, down);
  EXPECT_LT((c * slope - (up - down) / (2 * h)).abs().maxCoeff(), 1e-9);
}

TEST(GpRegression, ProductAndIsotropicAgreeForTheSquaredExponentialOnly) {
  Rng rng(3);
  const Points x = random_points(40, 2, rng);
  const auto difference = [&](const auto& kernel) {
    return (matrix(kernel, Isotropic{}, x, x) - matrix(kernel, Product{}, x, x)).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(difference(SquaredExponential{1, 2}), 1e-15);
  EXPECT_GT(difference(Matern52{1, 2}), 0.01);
}

TEST(GpRegression, LeaveOneOutIsARefitWithoutThePoint) {
  Rng rng(4);
  const Eigen::Index n = 40;
  const Points x = random_points(n, 2, rng);
  const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(n, [&] { return rng.normal(); });
  const GpRegression<Matern32>::Config c{.kernel = {.variance = 1, .length_m = 2}, .noise_variance = 0.1, .mean = 0.2};
  const Prediction all = GpRegression<Matern32>(c, x, y).leave_one_out();
  for (const Eigen::Index out : {0, 17, 39}) {
    Points others(n - 1, 2);
    Eigen::VectorXd values(n - 1);
    for (Eigen::Index i = 0, k = 0; i < n; ++i)
      if (i != out) {
        others.row(k) = x.row(i);
        values[k++] = y[i];
      }
    const Prediction p = GpRegression<Matern32>(c, others, values).predict(x.row(out));
    EXPECT_NEAR(all.mean[out], p.mean[0], 1e-11);
    EXPECT_NEAR(all.variance[out], p.variance[0] + c.noise_variance, 1e-11);
  }
}

TEST(GpRegression, GivesTheSameBitsWithAnyNumberOfThreads) {
  Rng rng(5);
  const Points x = random_points(700, 2, rng), q = random_points(600, 2, rng);
  const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(700, [&] { return rng.normal(); });
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const auto run = [&](int threads) {
    Prediction p;
    tbb::task_arena(threads).execute([&] {
      p = GpRegression<>({.kernel = {1, 1}, .noise_variance = 0.1}, x, y).predict(q);
    });
    return p;
  };
  const Prediction one = run(1), two = run(2), eight = run(8);
  EXPECT_EQ(one.mean, two.mean);
  EXPECT_EQ(one.variance, two.variance);
  EXPECT_EQ(one.mean, eight.mean);
  EXPECT_EQ(one.variance, eight.variance);
}

TEST(GpRegression, RefusesBadInput) {
  Rng rng(6);
  const Points x = random_points(5, 2, rng);
  const Eigen::VectorXd y = Eigen::VectorXd::Ones(5);
  const auto make = [](GpRegression<>::Config c, const Points& points, const Eigen::VectorXd& values) {
    GpRegression<> gp(c, points, values);
  };
  EXPECT_THROW(make({.noise_variance = 0}, x, y), Error);
  EXPECT_THROW(make({.mean = std::nan("")}, x, y), Error);
  EXPECT_THROW(make({.kernel = {-1, 1}}, x, y), Error);
  EXPECT_THROW(make({}, x, Eigen::VectorXd::Ones(4)), Error);
  EXPECT_THROW(make({}, Points(0, 2), Eigen::VectorXd(0)), Error);
  Points bad = x;
  bad(2, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(make({}, bad, y), Error);
  EXPECT_THROW(make({}, x, Eigen::VectorXd::Constant(5, std::nan(""))), Error);
  // Two points at one place with hardly any noise: singular to working precision.
  Points twice = x;
  twice.row(1) = twice.row(0);
  EXPECT_THROW(make({.noise_variance = 1e-20}, twice, y), Error);
  const GpRegression<> gp({}, x, y);
  EXPECT_THROW((void)gp.predict(Points::Zero(3, 1)), Error);
  EXPECT_THROW((void)gp.predict(Points::Constant(3, 2, std::nan(""))), Error);
  EXPECT_EQ(gp.predict(Points(0, 2)).mean.size(), 0);
}

TEST(GpRegression, PredictsTheMeanFarFromTheDataAndTheDataNearIt) {
  Rng rng(7);
  const Points x = random_points(30, 2, rng);
  const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(30, [&] { return rng.normal(); });
  const GpRegression<Matern12> gp({.kernel = {1, 1}, .noise_variance = 1e-6, .mean = 7}, x, y);
  const Prediction far = gp.predict(Points::Constant(1, 2, 1e6)), near = gp.predict(x);
  EXPECT_DOUBLE_EQ(far.mean[0], 7);
  EXPECT_DOUBLE_EQ(far.variance[0], 1);
  EXPECT_LT((near.mean - y).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(near.variance.maxCoeff(), 1e-5);
  EXPECT_GE(near.variance.minCoeff(), 0);
}

}  // namespace

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Hyperparameters learned from real samples: zinc in the Meuse flood plain, spring temperatures in Colorado.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include <vantage/io/csv.hpp>
#include <vantage/maps/field/hyperparameters.hpp>

#ifndef VANTAGE_DATA_DIR
#define VANTAGE_DATA_DIR ""
#endif

namespace {

using namespace vantage;

struct Samples {
  Points points;
  Eigen::VectorXd values;
};

// Two coordinates, brought to metres by `scale`, and a value; rows without one are left out.
template <class Transform>
Samples samples(const char* file, const char* x, const char* y, const char* value, const Eigen::Array2d& scale,
                Transform&& f) {
  const CsvTable t = read_csv(std::string(VANTAGE_DATA_DIR) + "/fields/" + file);
  std::vector<double> px, py, v;
  for (std::size_t row = 0; row < t.rows(); ++row) {
    if (std::isnan(t.column(value)[row])) continue;
    px.push_back(t.column(x)[row] * scale[0]);
    py.push_back(t.column(y)[row] * scale[1]);
    v.push_back(f(t.column(value)[row]));
  }
  const auto n = static_cast<Eigen::Index>(v.size());
  Samples s{Points(n, 2), Eigen::Map<Eigen::VectorXd>(v.data(), n)};
  s.points << Eigen::Map<Eigen::ArrayXd>(px.data(), n), Eigen::Map<Eigen::ArrayXd>(py.data(), n);
  return s;
}

template <class Regression>
double leave_one_out_rmse(const typename Regression::Config& c, const Samples& s) {
  return std::sqrt((Regression(c, s.points, s.values).leave_one_out().mean - s.values).squaredNorm() /
                   static_cast<double>(s.values.size()));
}

// Better, in likelihood and in what is left out, than the defaults and than a sensible guess: the values' variance, a
// tenth of the extent, a tenth of noise.
template <class Kernel>
void expect_learned(const Samples& s, double most_rmse) {
  using Regression = GpRegression<Kernel>;
  const auto fit = fit_hyperparameters<Kernel>(s.points, s.values);
  EXPECT_TRUE(fit.converged) << Kernel::name;
  const double mean = s.values.mean(), variance = (s.values.array() - mean).square().mean();
  const double extent = (s.points.colwise().maxCoeff() - s.points.colwise().minCoeff()).maxCoeff();
  const typename Regression::Config plain{.mean = mean};
  const typename Regression::Config guess{
      .kernel = {variance, 0.1 * extent}, .noise_variance = 0.1 * variance, .mean = mean};
  const double rmse = leave_one_out_rmse<Regression>(fit.config, s);
  for (const auto& other : {plain, guess}) {
    EXPECT_GT(fit.log_likelihood, Regression(other, s.points, s.values).log_marginal_likelihood() + 1) << Kernel::name;
    EXPECT_LT(rmse, leave_one_out_rmse<Regression>(other, s)) << Kernel::name;
  }
  EXPECT_LT(rmse, most_rmse) << Kernel::name;
  testing::Test::RecordProperty(std::string(Kernel::name) + "_rmse", std::to_string(rmse));

  // On the fifth of the samples that learning did not see: a smaller error than the guess, and honest variances.
  std::vector<Eigen::Index> seen, unseen;
  for (Eigen::Index i = 0; i < s.values.size(); ++i) (i % 5 == 2 ? unseen : seen).push_back(i);
  const Points x = s.points(seen, Eigen::all), q = s.points(unseen, Eigen::all);
  const Eigen::VectorXd y = s.values(seen), truth = s.values(unseen);
  const auto learned = fit_hyperparameters<Kernel>(x, y);
  const auto error = [&](const typename Regression::Config& c) {
    return (Regression(c, x, y).predict_mean(q) - truth).norm();
  };
  EXPECT_LT(error(learned.config), error(plain)) << Kernel::name;
  EXPECT_LT(error(learned.config), 1.02 * error(guess)) << Kernel::name;
  const Prediction p = Regression(learned.config, x, y).predict(q);
  const double z = ((p.mean - truth).array().square() / (p.variance.array() + learned.config.noise_variance)).mean();
  EXPECT_GT(z, 0.4) << Kernel::name;
  EXPECT_LT(z, 2.5) << Kernel::name;
}

class RealSamples : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(VANTAGE_DATA_DIR).empty()) GTEST_SKIP() << "VANTAGE_DATA_DIR is not set";
  }
};

TEST_F(RealSamples, ZincOfTheMeuse) {
  const Samples s = samples("meuse_soil_metals.csv", "x", "y", "zinc", {1, 1}, [](double v) { return std::log(v); });
  ASSERT_EQ(s.values.size(), 155);
  const double deviation = std::sqrt((s.values.array() - s.values.mean()).square().mean());
  EXPECT_NEAR(deviation, 0.72, 0.01);
  expect_learned<SquaredExponential>(s, 0.42);
  expect_learned<Matern12>(s, 0.40);
  expect_learned<Matern32>(s, 0.40);
  expect_learned<Matern52>(s, 0.41);
}

TEST_F(RealSamples, SpringInColorado) {
  const double degree = 111195, latitude = std::cos(39 * std::acos(-1.0) / 180);
  const Samples s = samples("colorado_spring_temperature.csv", "lon", "lat", "tmax", {degree * latitude, degree},
                            [](double v) { return v; });
  ASSERT_GT(s.values.size(), 200);
  expect_learned<SquaredExponential>(s, 1.8);
  expect_learned<Matern32>(s, 1.7);
}

}  // namespace

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// An exact oracle for whole missions: when every cell is measured once with the same noise variance r, the posterior is
// that of one batch regression, K - K (K + r I)^-1 K, whose K = sigma^2 Ky (x) Kx is diagonal in the product of two
// small eigenbases. It shares nothing with the filter but the kernel.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstddef>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/maps/field/matern.hpp>

namespace {

using namespace vantage;

struct Oracle {
  Eigen::MatrixXd mean, variance;  // (iy, ix)
};

template <class Cells, class Kernel>
Oracle oracle(const Kernel& kernel, const NdTree& tree, double prior_mean, double noise_variance,
              const Eigen::MatrixXd& y) {
  const int n = tree.resolution(), depth = tree.config().depth;
  const auto eigen = [&](auto&& interval) {
    Eigen::MatrixXd k(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) k(i, j) = Cells::correlation(kernel, interval(i), interval(j));
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k);
  };
  const auto x = eigen([&](int i) { return tree.x_interval(depth, i); });
  const auto v = eigen([&](int i) { return tree.y_interval(depth, i); });
  const Eigen::ArrayXXd lambda = kernel.variance * (v.eigenvalues() * x.eigenvalues().transpose()).array();
  const Eigen::MatrixXd coefficients =
      v.eigenvectors().transpose() * (y.array() - prior_mean).matrix() * x.eigenvectors();
  const Eigen::MatrixXd shrunk = coefficients.array() * lambda / (lambda + noise_variance);
  const Eigen::MatrixXd left = lambda * noise_variance / (lambda + noise_variance);
  return {(v.eigenvectors() * shrunk * x.eigenvectors().transpose()).array() + prior_mean,
          v.eigenvectors().cwiseAbs2() * left * x.eigenvectors().cwiseAbs2().transpose()};
}

// 16 images from 2.5 m, 4 x 4, that cover the field once; the noise is that of the height, alike for all cells.
template <class Map>
void expect_oracle(typename Map::Config c, double tolerance) {
  using Cells = typename Map::CellsType;
  Map map(c);
  const int n = map.tree().resolution();
  Eigen::MatrixXd y(n, n);
  Rng rng(5);
  const int pixels = n / 4;
  for (int step = 0; step < 16; ++step) {
    const int row = step / 4, column = row % 2 ? 3 - step % 4 : step % 4;  // boustrophedon
    FieldImage image;
    image.view = nadir(2.5 + 5 * column, 2.5 + 5 * row, 2.5);
    image.footprint = c.sensor.camera.footprint(image.view);
    image.values = Image<double>::NullaryExpr(pixels, pixels, [&] { return rng.uniform(); });
    y.block(row * pixels, column * pixels, pixels, pixels) = image.values.matrix();
    map.integrate(image, rng);
  }
  ASSERT_EQ(map.size(), static_cast<std::size_t>(n * n));
  const double noise = map.config().sensor.covered(map.tree(), c.tree.area, 2.5).noise_variance[0];
  const Oracle exact = oracle<Cells>(c.kernel, map.tree(), c.prior_mean, noise, y);
  double mean_error = 0, variance_error = 0;
  for (int iy = 0; iy < n; ++iy)
    for (int ix = 0; ix < n; ++ix) {
      const std::size_t i = map.tree().leaf_of_cell(ix, iy);
      mean_error = std::max(mean_error, std::abs(map.mean(i) - exact.mean(iy, ix)));
      variance_error = std::max(variance_error, std::abs(map.variance(i) - exact.variance(iy, ix)));
    }
  EXPECT_LT(mean_error, tolerance);
  EXPECT_LT(variance_error, tolerance);
}

template <class Kernel, class Cells, class Resolution>
struct Gp : IntegralGp<Kernel, Cells, Full<>, Resolution> {
  using IntegralGp<Kernel, Cells, Full<>, Resolution>::IntegralGp;
  using CellsType = Cells;
};

template <class Map>
typename Map::Config config(int depth) {
  typename Map::Config c;
  c.tree.depth = depth;
  c.sensor.alpha = 0.01;
  c.sensor.partial.beta = 0;
  return c;
}

TEST(EigenproblemOracle, FixedResolutionAtCellCentres) {
  using Map = Gp<SquaredExponential, CellCentre, Fixed<>>;
  expect_oracle<Map>(config<Map>(4), 1e-11);
  expect_oracle<Map>(config<Map>(5), 1e-11);
}

TEST(EigenproblemOracle, AveragesThatNeverMerge) {
  using Map = Gp<SquaredExponential, CellAverage, Merging<>>;
  for (const int depth : {3, 5}) {
    auto c = config<Map>(depth);
    c.resolution.interest.threshold = -1e6;  // everything is of interest
    expect_oracle<Map>(c, 1e-11);
  }
}

TEST(EigenproblemOracle, Materns) {
  using Rough = Gp<Matern12, CellAverage, Fixed<>>;
  expect_oracle<Rough>(config<Rough>(4), 1e-11);
  using Smooth = Gp<Matern52, CellAverage, Fixed<>>;
  expect_oracle<Smooth>(config<Smooth>(4), 1e-11);
}

TEST(EigenproblemOracle, ThreeBranchesAnAxisOnARectangle) {
  using Map = Gp<Matern32, CellAverage, Fixed<>>;
  auto c = config<Map>(2);
  c.tree = {.area = {Eigen::Vector2d(-3, 4), Eigen::Vector2d(15, 13)}, .branching = 3, .depth = 2};
  Map map(c);
  Rng rng(6);
  const CellMeasurements all = c.sensor.covered(map.tree(), c.tree.area, 2);
  ASSERT_EQ(all.cells.size(), 81u);
  Eigen::MatrixXd y(9, 9);
  for (const bool even : {true, false}) {  // two updates of every second leaf
    CellMeasurements z;
    std::vector<double> value;
    for (std::size_t i = even ? 0 : 1; i < 81; i += 2) {
      const double v = rng.uniform();
      z.cells.push_back(i);
      value.push_back(v);
      y(map.tree()[i].iy, map.tree()[i].ix) = v;
    }
    z.value = Eigen::Map<const Eigen::VectorXd>(value.data(), static_cast<Eigen::Index>(value.size()));
    z.noise_variance.setConstant(z.value.size(), 0.02);
    map.fuse(z);
  }
  const Oracle exact = oracle<CellAverage>(c.kernel, map.tree(), c.prior_mean, 0.02, y);
  for (std::size_t i = 0; i < 81; ++i) {
    const auto& leaf = map.tree()[i];
    EXPECT_NEAR(map.mean(i), exact.mean(leaf.iy, leaf.ix), 1e-12);
    EXPECT_NEAR(map.variance(i), exact.variance(leaf.iy, leaf.ix), 1e-12);
  }
}

}  // namespace

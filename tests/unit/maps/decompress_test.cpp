// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include <vantage/maps/field/decompress.hpp>
#include <vantage/maps/field/latent.hpp>
#include <vantage/maps/field/matern.hpp>
#include <vantage/maps/field/methods.hpp>
#include <vantage/sim/random_field.hpp>

#include "lawnmower.hpp"

namespace {

using namespace vantage;

template <class Map>
Map mapped(int depth, double threshold = 0.7, std::size_t steps = 16) {
  auto c = configured<Map, preset::reference>();
  c.kernel.variance = 1;
  c.kernel.length_m = 2.36;
  c.sensor.alpha = 0.05;
  c.tree.depth = depth;
  c.resolution.interest.threshold = threshold;
  Map map(c);
  Rng rng;
  const std::vector<FieldImage> images = testing_::lawnmower(0.125, 4);
  for (std::size_t i = 0; i < steps; ++i) map.integrate(images[i], rng);
  return map;
}

template <class M>
struct Decompress : testing::Test {};
using Reference = preset::reference;
using Maps = testing::Types<Ours<Reference>, Ours<Reference, Latent<>>,
                            Ours<Reference, Full<>, detail::AboveThreshold<Reference>, Matern32>>;
TYPED_TEST_SUITE(Decompress, Maps);

TYPED_TEST(Decompress, OfTheLeavesIsTheLeaves) {
  const TypeParam map = mapped<TypeParam>(5);
  ASSERT_LT(map.size(), 500u);
  std::vector<Box2> leaves;
  for (std::size_t i = 0; i < map.size(); ++i) leaves.push_back(map.cell(i));
  const Decompressed d = decompress(map, leaves);
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_NEAR(d.mean[static_cast<Eigen::Index>(i)], map.mean(i), 1e-5);
    EXPECT_NEAR(d.variance[static_cast<Eigen::Index>(i)], map.variance(i), 1e-6);
  }
}

// A whole mission at the finest level is one batch regression, and so is what is inferred from it.
TYPED_TEST(Decompress, OfAMapThatNeverMergedIsTheBatchRegression) {
  const TypeParam map = mapped<TypeParam>(3, -1e6, 7);
  ASSERT_EQ(map.size(), 64u);
  const auto& c = map.config();
  std::vector<Box2> cells;
  std::vector<double> y, r;
  const std::vector<FieldImage> images = testing_::lawnmower(0.125, 4);
  for (std::size_t step = 0; step < 7; ++step) {
    const CellMeasurements z = c.sensor.measure(map.tree(), images[step]);
    for (std::size_t k = 0; k < z.cells.size(); ++k) {
      cells.push_back(map.cell(z.cells[k]));
      y.push_back(z.value[static_cast<Eigen::Index>(k)]);
      r.push_back(z.noise_variance[static_cast<Eigen::Index>(k)]);
    }
  }
  const auto l = static_cast<Eigen::Index>(cells.size());
  Eigen::MatrixXd s = average_covariance(c.kernel, cells, cells);
  s.diagonal() += Eigen::Map<Eigen::VectorXd>(r.data(), l);
  const std::vector<Box2> boxes = grid_boxes(c.tree.area, 50, 30);
  const Eigen::MatrixXd cross = average_covariance(c.kernel, boxes, cells), weights = cross * s.inverse();
  const Eigen::VectorXd mean =
      (weights * (Eigen::Map<Eigen::VectorXd>(y.data(), l).array() - c.prior_mean).matrix()).array() + c.prior_mean;
  const Decompressed d = decompress(map, boxes);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double prior =
        average_covariance(c.kernel, std::span(boxes).subspan(i, 1), std::span(boxes).subspan(i, 1))(0, 0);
    EXPECT_NEAR(d.mean[k], mean[k], 1e-5);
    EXPECT_NEAR(d.variance[k], prior - weights.row(k).dot(cross.row(k)), 1e-5);
  }
}

// Fig. 3.4h: what merging averaged away is largely still there, in the correlations.
TEST(DecompressedField, IsNearerToTheTruthThanTheCells) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const ScalarField truth = random_field(Rng(seed), {.columns = 100, .rows = 100});
    auto c = configured<Ours<Reference>, Reference>();
    c.kernel = {.variance = 1, .length_m = 2.36};
    c.sensor.alpha = 0.05;
    Ours<Reference> map(c);
    Rng rng(seed + 10);
    for (FieldImage image : testing_::lawnmower(0, 0)) {
      for (Eigen::Index row = 0; row < 20; ++row)
        for (Eigen::Index column = 0; column < 20; ++column) {
          const Eigen::Vector2d offset(0.25 * (static_cast<double>(column) + 0.5),
                                       0.25 * (static_cast<double>(row) + 0.5));
          image.values(row, column) = truth.at(image.footprint.min() + offset) + 0.125 * rng.normal();
        }
      map.integrate(image, rng);
    }
    ASSERT_LT(map.size(), 700u);
    const std::vector<Box2> boxes = grid_boxes(c.tree.area, 50, 50);
    const Decompressed d = decompress(map, boxes);
    double fine = 0, coarse = 0;
    for (Eigen::Index row = 0; row < truth.rows(); ++row)
      for (Eigen::Index column = 0; column < truth.columns(); ++column) {
        const Eigen::Vector2d p = truth.centre(row, column);
        const auto box = static_cast<Eigen::Index>(p.y() / 0.4) * 50 + static_cast<Eigen::Index>(p.x() / 0.4);
        fine += std::pow(d.mean[box] - truth.at(p), 2);
        coarse += std::pow(map.mean(map.cell_at(p)) - truth.at(p), 2);
      }
    EXPECT_LT(std::sqrt(fine), 0.6 * std::sqrt(coarse)) << "seed " << seed;
    EXPECT_GE(d.variance.minCoeff(), 0);
  }
}

TEST(AverageCovariance, IsTheKernelOfEachPair) {
  Rng rng(1);
  std::vector<Box2> a, b;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d p(rng.uniform(0, 9), rng.uniform(0, 9)), q(rng.uniform(0, 9), rng.uniform(0, 9));
    a.emplace_back(p, p + Eigen::Vector2d(1, rng.uniform(0.1, 2)));
    b.emplace_back(q, q + Eigen::Vector2d(rng.uniform(0.1, 2), 1));
  }
  const Matern12 kernel{.variance = 3, .length_m = 1};
  const Eigen::MatrixXd k = average_covariance(kernel, a, b);
  for (std::size_t i = 0; i < 20; ++i)
    for (std::size_t j = 0; j < 20; ++j)
      EXPECT_DOUBLE_EQ(k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                       3 * kernel.average({a[i].min().x(), a[i].max().x()}, {b[j].min().x(), b[j].max().x()}) *
                           kernel.average({a[i].min().y(), a[i].max().y()}, {b[j].min().y(), b[j].max().y()}));
}

TEST(DecompressInput, BadBoxesAndJitterAreRefused) {
  const auto map = mapped<Ours<preset::reference>>(3);
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)decompress(map, std::vector<Box2>{Box2(Eigen::Vector2d(1, 1), Eigen::Vector2d(1, 2))}), Error);
  EXPECT_THROW((void)decompress(map, std::vector<Box2>{Box2(Eigen::Vector2d(1, 1), Eigen::Vector2d(2, inf))}), Error);
  EXPECT_THROW((void)decompress(map, std::vector<Box2>{Box2()}), Error);
  EXPECT_THROW((void)decompress(map, std::vector<Box2>{}, 0), Error);
  EXPECT_EQ(decompress(map, std::vector<Box2>{}).mean.size(), 0);
  EXPECT_THROW((void)grid_boxes(map.config().tree.area, 0, 3), Error);
  const std::vector<Box2> grid = grid_boxes({Eigen::Vector2d(-1, 2), Eigen::Vector2d(3, 4)}, 4, 2);
  ASSERT_EQ(grid.size(), 8u);
  EXPECT_TRUE(grid[5].isApprox(Box2(Eigen::Vector2d(0, 3), Eigen::Vector2d(1, 4))));
}

}  // namespace

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/eval/field_metrics.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <vantage/core/rng.hpp>

#include "cell_map.hpp"

namespace vantage {
namespace {

using test::CellMap;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct HotAbove {
  double threshold = 0.7;
  [[nodiscard]] bool hot(double value) const { return value > threshold; }
};

Box2 box(double x0, double y0, double x1, double y1) { return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)}; }

// n x n cells over a square, random means.
CellMap lattice(int n, double side, std::uint64_t seed) {
  Rng rng(seed);
  CellMap map;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      map.cells.push_back(
          {box(side * column / n, side * row / n, side * (column + 1) / n, side * (row + 1) / n), rng.uniform(), 1});
  return map;
}
ScalarField noise(int rows, int columns, double side, std::uint64_t seed, double masked) {
  Rng rng(seed);
  Image<double> values(rows, columns);
  for (double& v : values.reshaped()) v = rng.uniform() < masked ? nan : rng.uniform();
  return {box(0, 0, side, side), values};
}
// By looking up every pixel, a centre on an edge in the upper right cell.
FieldMetrics slow(const CellMap& map, const ScalarField& truth, const HotAbove& interest) {
  double all = 0, hot = 0, pixels = 0, hot_pixels = 0, both = 0, either = 0;
  for (Eigen::Index row = 0; row < truth.rows(); ++row)
    for (Eigen::Index column = 0; column < truth.columns(); ++column) {
      const double v = truth.values()(row, column);
      if (std::isnan(v)) continue;
      const double mean = map.mean(map.cell_at(truth.centre(row, column) + Eigen::Vector2d::Constant(1e-7)));
      all += (mean - v) * (mean - v), ++pixels;
      if (interest.hot(v)) hot += (mean - v) * (mean - v), ++hot_pixels;
      both += interest.hot(v) && interest.hot(mean);
      either += interest.hot(v) || interest.hot(mean);
    }
  return {std::sqrt(all / pixels),          std::sqrt(hot / hot_pixels),         both / either, map.size(),
          static_cast<std::size_t>(pixels), static_cast<std::size_t>(hot_pixels)};
}

TEST(FieldMetrics, CountsByHand) {
  Image<double> values(2, 2);
  values << 0.0, 0.8,  //
      0.9, nan;
  const ScalarField truth(box(0, 0, 2, 2), values);
  const CellMap map{{{box(0, 0, 2, 1), 0.8, 1}, {box(0, 1, 2, 2), 0.5, 1}}};
  const FieldMetrics m = field_metrics(map, truth, HotAbove{});
  EXPECT_DOUBLE_EQ(m.rmse, std::sqrt((0.64 + 0 + 0.16) / 3));
  EXPECT_DOUBLE_EQ(m.rmse_hotspots, std::sqrt(0.16 / 2));
  EXPECT_DOUBLE_EQ(m.iou, 1.0 / 3);
  EXPECT_EQ(m.cells, 2u);
  EXPECT_EQ(m.pixels, 3u);
  EXPECT_EQ(m.hotspot_pixels, 2u);
}

TEST(FieldMetrics, AgreesWithLookingUpEveryPixel) {
  for (const auto& [cells, rows, columns] :
       {std::tuple{4, 64, 64}, std::tuple{8, 50, 70}, std::tuple{64, 48, 48}, std::tuple{16, 33, 129}}) {
    const CellMap map = lattice(cells, 20, 1);
    const ScalarField truth = noise(rows, columns, 20, 2, 0.2);
    const FieldMetrics fast = field_metrics(map, truth, HotAbove{}), obvious = slow(map, truth, HotAbove{});
    EXPECT_EQ(fast.pixels, obvious.pixels);
    EXPECT_EQ(fast.hotspot_pixels, obvious.hotspot_pixels);
    EXPECT_NEAR(fast.rmse, obvious.rmse, 1e-12);
    EXPECT_NEAR(fast.rmse_hotspots, obvious.rmse_hotspots, 1e-12);
    EXPECT_NEAR(fast.iou, obvious.iou, 1e-12);
  }
}

TEST(FieldMetrics, EveryPixelCountsOnceEvenOnEdges) {
  const ScalarField truth = noise(200, 200, 20, 3, 0);
  for (const int n : {1, 3, 7, 16, 64, 200, 333})  // 16: pixel centres on the edges
    EXPECT_EQ(field_metrics(lattice(n, 20, 1), truth, HotAbove{}).pixels, 40'000u) << n;
}

TEST(FieldMetrics, PixelsThatNoCellCoversDoNotCount) {
  const ScalarField truth = noise(20, 20, 20, 3, 0);
  EXPECT_EQ(field_metrics(CellMap{{{box(-5, -5, 10, 10), 0.5, 1}}}, truth, HotAbove{}).pixels, 100u);
  EXPECT_THROW(static_cast<void>(field_metrics(CellMap{{{box(30, 30, 40, 40), 0.5, 1}}}, truth, HotAbove{})), Error);
  EXPECT_THROW(static_cast<void>(field_metrics(CellMap{}, truth, HotAbove{})), Error);
}

TEST(FieldMetrics, WithoutHotspots) {
  const ScalarField truth = noise(20, 20, 20, 3, 0);
  const CellMap map = lattice(4, 20, 1);
  const FieldMetrics none = field_metrics(map, truth, HotAbove{2});
  EXPECT_TRUE(std::isnan(none.rmse_hotspots));
  EXPECT_EQ(none.iou, 1) << "both agree that there are none";
  CellMap wrong = map;
  wrong.cells[5].mean = 3;
  EXPECT_EQ(field_metrics(wrong, truth, HotAbove{2}).iou, 0);
}

TEST(FieldMetrics, DoesNotDependOnTheThreads) {
  const CellMap map = lattice(64, 20, 1);
  const ScalarField truth = noise(400, 400, 20, 2, 0.1);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return field_metrics(map, truth, HotAbove{});
  };
  const FieldMetrics one = run(1);
  for (const std::size_t threads : {2u, 8u}) {
    EXPECT_EQ(run(threads).rmse, one.rmse);
    EXPECT_EQ(run(threads).rmse_hotspots, one.rmse_hotspots);
  }
}

TEST(FieldMetrics, RefusesAMapGoneWrong) {
  CellMap map = lattice(4, 20, 1);
  map.cells[3].mean = nan;
  EXPECT_THROW(static_cast<void>(field_metrics(map, noise(20, 20, 20, 3, 0), HotAbove{})), Error);
}

TEST(RmseAt, ComparesTheCellsOfThePoints) {
  const CellMap map{{{box(0, 0, 1, 1), 2, 1}, {box(1, 0, 2, 1), 5, 1}}};
  const std::vector<FieldSample> samples{{{0.5, 0.5}, 1}, {{1.5, 0.2}, 8}};
  EXPECT_DOUBLE_EQ(rmse_at(map, samples), std::sqrt((1 + 9) / 2.0));
  EXPECT_THROW(static_cast<void>(rmse_at(map, {})), Error);
  const std::vector<FieldSample> outside{{{3, 3}, 1}}, blank{{{0.5, 0.5}, nan}};
  EXPECT_THROW(static_cast<void>(rmse_at(map, outside)), Error);
  EXPECT_THROW(static_cast<void>(rmse_at(map, blank)), Error);
}

}  // namespace
}  // namespace vantage

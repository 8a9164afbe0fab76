// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/field_world.hpp>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/concepts/world.hpp>

namespace vantage {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// 20 m x 20 m, 0.5 m pixels, the value tells the place.
ScalarField plane(double masked_below_x = 0) {
  Image<double> values(40, 40);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column)
      values(row, column) = column < 2 * masked_below_x ? nan : column + 100.0 * row;
  return {{Eigen::Vector2d(0, 0), Eigen::Vector2d(20, 20)}, values};
}
const DeviationByHeight silent{.alpha = 0};

struct AnyMap {
  using Measurement = FieldImage;
  void integrate(const FieldImage&, Rng&) {}
  [[nodiscard]] Box3 bounds() const { return {}; }
};
static_assert(WorldFor<FieldWorld<>, AnyMap> && WorldFor<FieldWorld<VarianceByHeight>, AnyMap>);
static_assert(Posed<FieldImage> && Persistent<FieldWorld<>>);

TEST(FieldWorld, SeesTheTruthBelowItRowsAlongY) {
  FieldWorld world(plane(), silent, Rng(1));
  const auto z = world.observe(nadir(10, 7, 5));  // 10 m x 10 m from (5, 2): pixels of 0.5 m on the truth's own
  ASSERT_TRUE(z);
  EXPECT_TRUE(z->footprint.isApprox(Box2(Eigen::Vector2d(5, 2), Eigen::Vector2d(15, 12))));
  EXPECT_TRUE(z->view.T_W_C.isApprox(nadir(10, 7, 5).T_W_C));
  ASSERT_EQ(z->values.rows(), 20);
  ASSERT_EQ(z->values.cols(), 20);
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 20; ++column) EXPECT_EQ(z->values(row, column), (column + 10) + 100 * (row + 4));
}

TEST(FieldWorld, TakesTheNearestPixelOfTheTruth) {
  FieldWorld world(plane(), silent, Rng(1), {.sensor = {.pixels = 7}});
  const auto z = world.observe(nadir(10, 10, 3));
  ASSERT_TRUE(z);
  for (int row = 0; row < 7; ++row)
    for (int column = 0; column < 7; ++column) {
      const Eigen::Vector2d centre(7 + 6 * (column + 0.5) / 7, 7 + 6 * (row + 0.5) / 7);
      EXPECT_EQ(z->values(row, column), std::floor(2 * centre.x()) + 100 * std::floor(2 * centre.y()));
    }
}

TEST(FieldWorld, PixelsOutsideAndMaskedAreNaN) {
  FieldWorld world(plane(10), silent, Rng(1));
  const auto edge = world.observe(nadir(20, 10, 5));
  ASSERT_TRUE(edge);
  EXPECT_TRUE(edge->values.leftCols(10).isFinite().all());
  EXPECT_TRUE(edge->values.rightCols(10).isNaN().all());
  const auto masked = world.observe(nadir(5, 10, 2));
  ASSERT_TRUE(masked) << "over the area, but masked";
  EXPECT_TRUE(masked->values.isNaN().all());
  EXPECT_FALSE(world.observe(nadir(-5, 10, 5))) << "touches the area only";
  EXPECT_FALSE(world.observe(nadir(100, 100, 5)));
  EXPECT_EQ(world.measurements(), 2u) << "no image, no measurement";
}

TEST(FieldWorld, RefusesViewsThatItCannotFly) {
  FieldWorld world(plane(), silent, Rng(1));
  EXPECT_THROW(world.observe(nadir(10, 10, 0)), Error);
  EXPECT_THROW(world.observe(nadir(10, 10, -1)), Error);
  EXPECT_THROW(world.observe(nadir(nan, 10, 1)), Error);
  EXPECT_THROW(world.observe(look_at({10, 10, 5}, {12, 10, 0})), Error);
  EXPECT_EQ(world.measurements(), 0u);
}

// Standard deviation of the noise that the world adds, measured over many pixels.
template <class Noise>
double measured_deviation(const Noise& noise, double height_m, std::optional<double> unit) {
  FieldWorld world(plane(), noise, Rng(9), {.sensor = {.pixels = 100}, .noise_unit = unit});
  FieldWorld still(plane(), silent, Rng(9), {.sensor = {.pixels = 100}});
  double sum = 0, squares = 0, n = 0;
  for (int i = 0; i < 10; ++i) {
    const View view = nadir(10, 10, height_m);
    const Image<double> d = world.observe(view)->values - still.observe(view)->values;
    sum += d.sum();
    squares += d.square().sum();
    n += static_cast<double>(d.size());
  }
  EXPECT_NEAR(sum / n, 0, 5 * world.noise_deviation(height_m) / std::sqrt(n));
  EXPECT_DOUBLE_EQ(world.noise_deviation(height_m), noise.deviation(height_m) * world.noise_unit());
  return std::sqrt(squares / n);
}

TEST(FieldWorld, NoiseFollowsItsPolicyAndTheUnit) {
  EXPECT_NEAR(measured_deviation(DeviationByHeight{0.05}, 2.5, 1.0), 0.125, 0.002);
  EXPECT_NEAR(measured_deviation(VarianceByHeight{0.03}, 3.0, 1.0), 0.3, 0.005);
  EXPECT_NEAR(measured_deviation(DeviationByHeight{0.05}, 2.0, 30.0), 3.0, 0.05);
  EXPECT_NEAR(measured_deviation(DeviationByHeight{0.05}, 2.0, {}), 0.1 * 3939, 7) << "by default the truth's range";
}

TEST(FieldWorld, NoiseDependsOnTheSeedAndTheCountOnly) {
  FieldWorld a(plane(), DeviationByHeight{}, Rng(4)), b(plane(), DeviationByHeight{}, Rng(4)),
      other(plane(), DeviationByHeight{}, Rng(5));
  const View here = nadir(10, 10, 5), there = nadir(4, 4, 2);
  const auto a1 = a.observe(here), a2 = a.observe(here);
  static_cast<void>(b.observe(there));  // looks elsewhere first
  const auto b2 = b.observe(here);
  EXPECT_TRUE((a2->values == b2->values).all());
  EXPECT_FALSE((a1->values == a2->values).any());
  EXPECT_FALSE((a1->values == other.observe(here)->values).any());
}

TEST(FieldWorld, ResumesInTheSameBytes) {
  FieldWorld whole(plane(), DeviationByHeight{}, Rng(4));
  for (int i = 0; i < 3; ++i) static_cast<void>(whole.observe(nadir(10, 10, 5)));
  Sink sink;
  whole.save(sink);
  FieldWorld resumed(plane(), DeviationByHeight{}, Rng(77));  // the checkpoint knows the seed
  Source source(sink.bytes());
  resumed.load(source);
  source.done();
  EXPECT_EQ(resumed.measurements(), 3u);
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE((whole.observe(nadir(8, 8, 4))->values == resumed.observe(nadir(8, 8, 4))->values).all());
}

TEST(FieldWorld, LoadRefusesAnotherFieldAndTruncation) {
  FieldWorld world(plane(), DeviationByHeight{}, Rng(4));
  static_cast<void>(world.observe(nadir(10, 10, 5)));
  Sink sink;
  world.save(sink);
  FieldWorld other(plane(3), DeviationByHeight{}, Rng(1));
  Source source(sink.bytes());
  EXPECT_THROW(other.load(source), Error);
  for (std::size_t size = 0; size < sink.bytes().size(); ++size) {
    FieldWorld fresh(plane(), DeviationByHeight{}, Rng(1)), untouched = fresh;
    Source cut(sink.bytes().first(size));
    EXPECT_THROW(fresh.load(cut), Error);
    EXPECT_EQ(fresh.measurements(), 0u);
    EXPECT_TRUE((fresh.observe(nadir(9, 9, 1))->values == untouched.observe(nadir(9, 9, 1))->values).all());
  }
}

TEST(FieldWorld, RefusesBadConfig) {
  EXPECT_THROW(FieldWorld(plane(), DeviationByHeight{-1}, Rng(1)), Error);
  EXPECT_THROW(FieldWorld(plane(), VarianceByHeight{nan}, Rng(1)), Error);
  EXPECT_THROW(FieldWorld(plane(), silent, Rng(1), {.sensor = {.pixels = 0}}), Error);
  EXPECT_THROW(FieldWorld(plane(), silent, Rng(1), {.noise_unit = -1}), Error);
}

}  // namespace
}  // namespace vantage

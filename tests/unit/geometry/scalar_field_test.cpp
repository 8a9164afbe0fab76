// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/geometry/scalar_field.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

namespace vantage {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Box2 area_m{Eigen::Vector2d(1, 2), Eigen::Vector2d(5, 4)};  // 4 m x 2 m

Image<double> four_by_two() {
  Image<double> values(2, 4);
  values << 1, 2, 3, 4,  //
      5, 6, nan, 8;
  return values;
}

TEST(ScalarField, KnowsItsSizeRangeAndMask) {
  const ScalarField f(area_m, four_by_two(), {"elevation", "m"});
  EXPECT_EQ(f.rows(), 2);
  EXPECT_EQ(f.columns(), 4);
  EXPECT_EQ(f.pixel_m(), Eigen::Vector2d(1, 1));
  EXPECT_EQ(f.valid_pixels(), 7);
  EXPECT_EQ(f.minimum(), 1);
  EXPECT_EQ(f.maximum(), 8);
  EXPECT_EQ(f.range(), 7);
  EXPECT_EQ(f.quantity().unit, "m");
  EXPECT_EQ(f.centre(1, 3), Eigen::Vector2d(4.5, 3.5));
}

TEST(ScalarField, LooksUpThePixelThatHoldsAPoint) {
  const ScalarField f(area_m, four_by_two());
  for (Eigen::Index row = 0; row < f.rows(); ++row)
    for (Eigen::Index column = 0; column < f.columns(); ++column)
      for (const double d : {-0.499, 0.0, 0.499}) {
        const double found = f.at(f.centre(row, column) + Eigen::Vector2d(d, -d)), there = f.values()(row, column);
        EXPECT_TRUE(found == there || (std::isnan(found) && std::isnan(there))) << row << ' ' << column << ' ' << d;
      }
  EXPECT_EQ(f.at({1, 2}), 1) << "lower left corner";
  EXPECT_EQ(f.at({5, 4}), 8) << "upper right corner";
  EXPECT_TRUE(std::isnan(f.at({0.999, 3})));
  EXPECT_TRUE(std::isnan(f.at({3, 4.001})));
  EXPECT_TRUE(std::isnan(f.at({nan, 3})));
  EXPECT_TRUE(std::isnan(f.at({std::numeric_limits<double>::infinity(), 3})));
}

TEST(ScalarField, AveragesOverRectangles) {
  const ScalarField f(area_m, four_by_two());
  EXPECT_DOUBLE_EQ(f.average(area_m), (1 + 2 + 3 + 4 + 5 + 6 + 8) / 7.0) << "masked pixels do not count";
  EXPECT_DOUBLE_EQ(f.average({Eigen::Vector2d(1, 2), Eigen::Vector2d(3, 3)}), 1.5);
  EXPECT_DOUBLE_EQ(f.average({Eigen::Vector2d(1.5, 2.5), Eigen::Vector2d(2.5, 3.5)}), (1 + 2 + 5 + 6) / 4.0);
  EXPECT_DOUBLE_EQ(f.average({Eigen::Vector2d(1.75, 2), Eigen::Vector2d(2.25, 2.5)}), 1.5);
  EXPECT_DOUBLE_EQ(f.average({Eigen::Vector2d(-9, -9), Eigen::Vector2d(2, 3)}), 1.0) << "outer parts do not count";
  EXPECT_TRUE(std::isnan(f.average({Eigen::Vector2d(3.1, 3.1), Eigen::Vector2d(3.9, 3.9)}))) << "masked";
  EXPECT_TRUE(std::isnan(f.average({Eigen::Vector2d(6, 6), Eigen::Vector2d(7, 7)}))) << "outside";
  EXPECT_TRUE(std::isnan(f.average({Eigen::Vector2d(2, 2), Eigen::Vector2d(2, 3)}))) << "no area";
}

TEST(ScalarField, AverageAgreesWithManySamples) {
  Rng rng(3);
  Image<double> values(30, 20);
  for (double& v : values.reshaped()) v = rng.uniform() < 0.1 ? nan : rng.normal();
  const ScalarField f({Eigen::Vector2d(-1, 0), Eigen::Vector2d(1, 3)}, values);
  for (int i = 0; i < 20; ++i) {
    Box2 box(Eigen::Vector2d(rng.uniform(-1.2, 1.2), rng.uniform(-0.2, 3.2)));
    box.extend(Eigen::Vector2d(rng.uniform(-1.2, 1.2), rng.uniform(-0.2, 3.2)));
    double sum = 0, count = 0;
    for (int row = 0; row < 500; ++row)
      for (int column = 0; column < 500; ++column) {
        const double v = f.at(box.min() + box.sizes().cwiseProduct(Eigen::Vector2d(column + 0.5, row + 0.5) / 500));
        if (!std::isnan(v)) sum += v, ++count;
      }
    if (count == 0) continue;
    EXPECT_NEAR(f.average(box), sum / count, 0.02) << box.min().transpose() << " " << box.max().transpose();
  }
}

TEST(ScalarField, RefusesNonsense) {
  EXPECT_THROW(ScalarField(Box2(), four_by_two()), Error) << "empty area";
  EXPECT_THROW(ScalarField({Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 1)}, four_by_two()), Error) << "no width";
  EXPECT_THROW(ScalarField({Eigen::Vector2d(0, 0), Eigen::Vector2d(nan, 1)}, four_by_two()), Error);
  EXPECT_THROW(ScalarField(area_m, Image<double>()), Error);
  EXPECT_THROW(ScalarField(area_m, Image<double>::Constant(2, 2, nan)), Error);
  Image<double> infinite = four_by_two();
  infinite(1, 1) = -std::numeric_limits<double>::infinity();
  try {
    ScalarField(area_m, infinite);
    FAIL();
  } catch (const Error& e) { EXPECT_NE(std::string(e.what()).find("row 1, column 1"), std::string::npos) << e.what(); }
}

}  // namespace
}  // namespace vantage

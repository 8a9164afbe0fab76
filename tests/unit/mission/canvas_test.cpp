// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vantage/mission/canvas.hpp>

namespace {

using namespace vantage;

constexpr Rgb white = {255, 255, 255}, black = {0, 0, 0}, red = {255, 0, 0};
const Box2 ground(Eigen::Vector2d(10, 20), Eigen::Vector2d(14, 22));

int painted(const Canvas& canvas, Rgb colour) {
  int n = 0;
  for (int row = 0; row < canvas.picture().height(); ++row)
    for (int column = 0; column < canvas.picture().width(); ++column) n += canvas.picture()(row, column) == colour;
  return n;
}

TEST(Canvas, KeepsProportionsAndPutsYUp) {
  Canvas canvas(ground, 200);
  EXPECT_EQ(canvas.picture().width(), 200);
  EXPECT_EQ(canvas.picture().height(), 100);
  EXPECT_TRUE(canvas.to_px({10, 22}).isApprox(Eigen::Vector2d(0, 0)));
  EXPECT_TRUE(canvas.to_px({14, 20}).isApprox(Eigen::Vector2d(200, 100)));
  canvas.fill([](const Eigen::Vector2d& p) { return p.y() > 21 && p.x() < 12 ? black : white; });
  EXPECT_EQ(painted(canvas, black), 100 * 50);
  EXPECT_EQ(canvas.picture()(0, 0), black);
  EXPECT_EQ(canvas.picture()(99, 0), white);
  EXPECT_EQ(canvas.picture()(0, 199), white);
}

TEST(Canvas, CentresAreInsideAndInvertToPixels) {
  const Canvas canvas(ground, 64);
  for (int row = 0; row < canvas.picture().height(); ++row)
    for (int column = 0; column < canvas.picture().width(); ++column) {
      const Eigen::Vector2d p = canvas.centre(row, column);
      EXPECT_TRUE(ground.contains(p));
      EXPECT_TRUE(canvas.to_px(p).isApprox(Eigen::Vector2d(column + 0.5, row + 0.5), 1e-9));
    }
}

TEST(Canvas, LinesHaveTheirLengthAndWidth) {
  Canvas canvas(ground, 400);
  canvas.fill([](const Eigen::Vector2d&) { return white; });
  canvas.line({11, 21}, {13, 21}, 6, black);
  EXPECT_NEAR(painted(canvas, black), 200 * 6, 40);
  const int row = static_cast<int>(canvas.to_px({12, 21}).y());
  EXPECT_EQ(canvas.picture()(row, 200), black);
  EXPECT_EQ(canvas.picture()(row - 10, 200), white);
}

TEST(Canvas, DotsHaveTheirArea) {
  Canvas canvas(ground, 400);
  canvas.fill([](const Eigen::Vector2d&) { return white; });
  canvas.dot({12, 21}, 20, red);
  EXPECT_NEAR(painted(canvas, red), M_PI * 20 * 20, 80);
}

TEST(Canvas, OpacityMixes) {
  Canvas canvas(ground, 100);
  canvas.fill([](const Eigen::Vector2d&) { return white; });
  canvas.dot({12, 21}, 20, black, 0.5);
  const Rgb mixed = canvas.picture()(25, 50);
  EXPECT_NEAR(mixed[0], 128, 1);
}

TEST(Canvas, WhatLiesOutsideIsCutOff) {
  Canvas canvas(ground, 100);
  canvas.fill([](const Eigen::Vector2d&) { return white; });
  canvas.line({-1e5, 21}, {1e5, 21}, 3, black);
  canvas.dot({1e6, 1e6}, 50, red);
  canvas.rectangle(Box2(Eigen::Vector2d(0, 0), Eigen::Vector2d(40, 40)), 2, red);
  EXPECT_NEAR(painted(canvas, black), 300, 110);
  EXPECT_EQ(painted(canvas, red), 0);
}

TEST(Canvas, OutlinesWhereAnAnswerChanges) {
  Canvas canvas(ground, 100);
  canvas.fill([](const Eigen::Vector2d&) { return white; });
  canvas.outline([](const Eigen::Vector2d& p) { return p.x() > 12; }, black);
  EXPECT_NE(canvas.picture()(20, 49), white);
  EXPECT_EQ(canvas.picture()(20, 40), white);
  EXPECT_EQ(canvas.picture()(20, 60), white);
}

TEST(Canvas, RefusesWhatIsNoPicture) {
  EXPECT_THROW(Canvas(ground, 3), Error);
  EXPECT_THROW(Canvas(ground, 1 << 20), Error);
  EXPECT_THROW(Canvas(Box2(), 100), Error);
  EXPECT_THROW(Canvas(Box2(Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 1)), 100), Error);
  EXPECT_THROW(Canvas(Box2(Eigen::Vector2d(0, 0), Eigen::Vector2d(std::numeric_limits<double>::infinity(), 1)), 100),
               Error);
}

}  // namespace

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/geometry/frame.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace vantage {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

Frame frame() {  // no multiple of a vector's width
  Frame f;
  f.camera = Camera::from_fov(37, 23, 1.0);
  for (Image<float>* plane : {&f.colour.r, &f.colour.g, &f.colour.b}) plane->setConstant(23, 37, 0.5F);
  f.depth.setConstant(23, 37, 2);
  return f;
}

std::string refusal(const Frame& f) {
  try {
    f.validate("test");
  } catch (const Error& error) { return error.what(); }
  return "";
}

TEST(Frame, TakesWhatASensorGives) {
  Frame f = frame();
  f.colour.r(0, 0) = 0;
  f.colour.b(22, 36) = 1;
  f.depth(3, 4) = nan;
  f.depth(22, 36) = std::numeric_limits<float>::max();
  f.depth(5, 6) = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(refusal(f), "");
  EXPECT_EQ(refusal({.camera = f.camera, .view = {}, .colour = {}, .depth = {}, .labels = {}}), "");
}

TEST(Frame, NamesTheFirstBadPixelWhereverItIs) {
  for (const auto& [row, column] : {std::pair{0, 0}, std::pair{11, 5}, std::pair{22, 36}}) {
    const std::string place = " at row " + std::to_string(row) + ", column " + std::to_string(column);
    for (const float bad : {-1e-6F, 1.00001F, nan, infinity, -infinity}) {
      Frame f = frame();
      f.colour.g(row, column) = bad;
      EXPECT_NE(refusal(f).find("colour"), std::string::npos) << refusal(f);
      EXPECT_NE(refusal(f).find(place), std::string::npos) << refusal(f);
    }
    for (const float bad : {0.F, -1.F, infinity, -infinity}) {
      Frame f = frame();
      f.depth(row, column) = bad;
      f.depth(22, 36) = bad;
      EXPECT_NE(refusal(f).find("depth"), std::string::npos) << refusal(f);
      EXPECT_NE(refusal(f).find(place), std::string::npos) << refusal(f);
    }
  }
}

TEST(Frame, WithinARangeNothingBeyondHasDepth) {
  Frame f = frame();
  f.depth(1, 2) = 1.5F;
  f.depth(3, 4) = nan;
  f.depth(5, 6) = 3;
  const Frame near = within(f, 2);
  EXPECT_EQ(near.depth(0, 0), 2);
  EXPECT_EQ(near.depth(1, 2), 1.5F);
  EXPECT_TRUE(std::isnan(near.depth(3, 4)));
  EXPECT_TRUE(std::isnan(near.depth(5, 6)));
  EXPECT_EQ(near.colour.r(5, 6), 0.5F);
  EXPECT_EQ(refusal(near), "");
  f.depth.resize(0, 0);
  EXPECT_EQ(within(f, 2).depth.size(), 0);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vantage/mission/plot.hpp>
#include <vector>

#include "toy/markup.hpp"

namespace {

using namespace vantage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using toy::between, toy::count;

void expect_balanced(const std::string& svg) { EXPECT_EQ(toy::unbalanced(svg), "") << svg; }

Plot two_curves() {
  return {
      .title = "Error & <more>",
      .x_label = "time [s]",
      .y_label = "m",
      .curves = {
          {.name = "ours", .x = {0, 10, 20, 30}, .y = {4, 2, nan, 1}, .low = {3, 1, nan, 0}, .high = {5, 3, nan, 2}},
          {.name = "\"theirs\"", .x = {0, 15, 30}, .y = {4, 3, 2}}}};
}

TEST(Plot, DrawsEveryKnownPoint) {
  const std::string svg = svg_document(two_curves());
  expect_balanced(svg);
  EXPECT_EQ(count(svg, "<circle"), 6u);
  EXPECT_EQ(count(svg, "class=\"band\""), 1u);
  EXPECT_NE(svg.find("Error &amp; &lt;more&gt;"), svg.npos);
  EXPECT_EQ(svg.find("<more>"), svg.npos);
  EXPECT_NE(svg.find("ours: 4 at 0"), svg.npos);
  EXPECT_EQ(svg.find("nan"), svg.npos);
  EXPECT_EQ(svg.find(" id="), svg.npos);  // several plots share a page
}

TEST(Plot, NaNLiftsThePen) {
  const std::string svg = svg_element(two_curves());
  const std::string path = between(svg, "<path class=\"curve\" d=\"", "\"");
  EXPECT_EQ(count(path, "M"), 2u);
  EXPECT_EQ(count(path, "L"), 1u);
}

TEST(Plot, CoordinatesAreInsideAndRightWayUp) {
  const Plot plot{.title = "t", .x_label = "x", .y_label = "y", .curves = {{.name = "c", .x = {0, 1}, .y = {0, 100}}}};
  const std::string svg = svg_element(plot);
  const std::string path = between(svg, "<path class=\"curve\" d=\"", "\"");
  double x0 = -1, y0 = -1, x1 = -1, y1 = -1;
  ASSERT_EQ(std::sscanf(path.c_str(), "M%lf %lfL%lf %lf", &x0, &y0, &x1, &y1), 4) << path;
  EXPECT_LT(x0, x1);
  EXPECT_GT(y0, y1);  // larger is higher up
  EXPECT_GE(x0, 0);
  EXPECT_LE(x1, plot.width_px);
  EXPECT_GE(y1, 0);
  EXPECT_LE(y0, plot.height_px);
}

TEST(Plot, TicksAreRoundAndCover) {
  for (const double low : {0.0, -3.7, 1e-9, 41.3, -1e6})
    for (const double width : {1e-12, 3e-4, 1.0, 97.0, 1e9}) {
      const detail::Ticks t(low, low + width, 5);
      if (!(low + width > low)) continue;  // lost in rounding
      EXPECT_LE(t.low, low + 1e-6 * width);
      EXPECT_GE(t.high, low + width - 1e-6 * width);
      EXPECT_GE(t.count(), 3);
      EXPECT_LE(t.count(), 12);
      const double digit = t.step / std::pow(10, std::floor(std::log10(t.step) + 1e-9));
      EXPECT_TRUE(std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 || std::abs(digit - 5) < 1e-6) << t.step;
    }
}

TEST(Plot, DrawsWhatHasNoExtent) {
  for (const Plot& plot :
       {Plot{.title = "none", .x_label = "", .y_label = "", .curves = {}},
        Plot{.title = "empty", .x_label = "", .y_label = "", .curves = {{.name = "a", .x = {}, .y = {}}}},
        Plot{.title = "unknown", .x_label = "", .y_label = "", .curves = {{.name = "a", .x = {0, 1}, .y = {nan, nan}}}},
        Plot{.title = "one point", .x_label = "", .y_label = "", .curves = {{.name = "a", .x = {3}, .y = {5}}}},
        Plot{.title = "flat zero", .x_label = "", .y_label = "", .curves = {{.name = "a", .x = {0, 1}, .y = {0, 0}}}},
        Plot{.title = "flat", .x_label = "", .y_label = "", .curves = {{.name = "a", .x = {0, 1}, .y = {-7, -7}}}},
        Plot{.title = "tiny on huge",
        .x_label = "",
        .y_label = "",
        .curves = {{.name = "a", .x = {0, 1}, .y = {1e15, 1e15 + 0.125}}},
        .from_zero = false}}) {
    const std::string svg = svg_document(plot);
    expect_balanced(svg);
    EXPECT_EQ(svg.find("nan"), svg.npos) << svg;
    EXPECT_EQ(svg.find("inf"), svg.npos) << svg;
    EXPECT_LT(svg.size(), 20'000u);
  }
}

TEST(Plot, RefusesWhatItCannotDraw) {
  Plot plot = two_curves();
  plot.curves[0].y.pop_back();
  EXPECT_THROW(svg_element(plot), Error);
  plot = two_curves();
  plot.curves[0].low.pop_back();
  EXPECT_THROW(svg_element(plot), Error);
  plot = two_curves();
  plot.curves[1].y[0] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(svg_element(plot), Error);
  plot = two_curves();
  plot.width_px = 10;
  plot.height_px = 1 << 20;
  EXPECT_THROW(svg_element(plot), Error);
}

}  // namespace

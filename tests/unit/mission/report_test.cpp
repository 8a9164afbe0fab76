// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vantage/mission/report.hpp>
#include <vector>

#include "toy/markup.hpp"

namespace {

using namespace vantage;

MissionRecord record() {
  MissionRecord r;
  r.config = {{"method", "<ours>"}, {"resolution", 32}};
  r.seed = 7;
  r.steps = {StepRecord{.index = 0, .view = nadir(0, 0, 0), .metrics = {{"rmse", 4.5}}},
             StepRecord{.index = 1,
                        .view = nadir(1, 2, 3),
                        .planned = true,
                        .utility = 8,
                        .best_utility = 9,
                        .candidates = 314,
                        .planning_s = 1,
                        .mapping_s = 1,
                        .action_s = 2,
                        .elapsed_s = 4,
                        .travelled_m = 2,
                        .metrics = {{"rmse", 1.25}}},
             StepRecord{.index = 2,
                        .view = nadir(2, 2, 3),
                        .elapsed_s = 5,
                        .metrics = {{"rmse", std::numeric_limits<double>::quiet_NaN()}}}};
  return r;
}

Report page() {
  Report report{.title = "A & B", .lead = "What was <done>."};
  report.figures = {{"RMSE", "1.25", "m", "small"}};
  report.pictures = {{.title = "The map",
                      .caption = "cells",
                      .png = {std::byte{'f'}, std::byte{'o'}, std::byte{'o'}},
                      .scale = {.colours = {{0, 0, 0}, {255, 128, 0}}, .low = 1, .high = 2.5, .unit = "m"}}};
  report.plots = {metric_plot(record(), "Error", "m", {"rmse"})};
  report.command = "run field --field 'a b'";
  return report;
}

TEST(Report, HoldsEverythingItself) {
  const std::string html = report_html(page(), record());
  for (const char* part :
       {"A &amp; B", "What was &lt;done&gt;.", "1.25", "data:image/png;base64,Zm9v", "rgb(0 0 0),rgb(255 128 0)",
        "2.5 m", "<svg class=\"plot\"", "planning 1 s (25 %)", "travel 2 s (50 %)", "run field --field &#39;a b&#39;",
        "&lt;ours&gt;", "314", "<th>rmse", "prefers-color-scheme:dark"})
    EXPECT_NE(html.find(part), html.npos) << part;
  // Nothing is fetched and nothing is run.
  for (const char* part : {"<script", "<link", "@import", "href=", "url("})
    EXPECT_EQ(html.find(part), html.npos) << part;
  EXPECT_EQ(toy::count(html, "src=\""), toy::count(html, "src=\"data:"));
  EXPECT_EQ(toy::count(html, "http"), toy::count(html, "xmlns=\"http"));
  EXPECT_EQ(html, report_html(page(), record()));
}

TEST(Report, AnEmptyMissionIsAPageToo) {
  const std::string html = report_html(Report{.title = "Nothing"}, MissionRecord{});
  EXPECT_NE(html.find("</html>"), html.npos);
  EXPECT_EQ(html.find("<table><thead>"), html.npos);
}

TEST(Report, AnUnknownMetricIsAGap) {
  const Plot plot = metric_plot(record(), "t", "", {"rmse", "none"});
  ASSERT_EQ(plot.curves.size(), 2u);
  EXPECT_EQ(plot.curves[0].y[1], 1.25);
  EXPECT_TRUE(std::isnan(plot.curves[0].y[2]));
  EXPECT_TRUE(std::isnan(plot.curves[1].y[0]));
  EXPECT_EQ(plot.curves[0].x[1], 4);
}

}  // namespace

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../../../benchmarks/studies/field_claims.hpp"
#include "../../../benchmarks/studies/planning_claims.hpp"
#include "../../../benchmarks/studies/published_clock.hpp"
#include "../../../benchmarks/studies/statistics.hpp"
#include "../../../benchmarks/studies/table.hpp"
#include "../../../benchmarks/studies/table_3_1.hpp"

namespace study {
namespace {

TEST(Statistics, MeanAndSampleDeviation) {
  const Summary s = Summary::of(std::vector{2.0, 4.0, nan, 4.0, 6.0});
  EXPECT_EQ(s.count, 4u);
  EXPECT_DOUBLE_EQ(s.mean, 4);
  EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(8.0 / 3));
  EXPECT_DOUBLE_EQ(s.standard_error(), std::sqrt(8.0 / 3) / 2);
  EXPECT_EQ(Summary::of(std::vector{3.0}).deviation, 0);
  EXPECT_TRUE(std::isnan(Summary::of(std::vector<double>{}).mean));
  EXPECT_TRUE(std::isnan(Summary::of(std::vector{nan}).mean));
}

TEST(Statistics, DifferencesAreTakenPairByPair) {
  const Summary d = difference(std::vector{1.0, 12.0, 23.0}, std::vector{0.0, 10.0, 20.0});
  EXPECT_DOUBLE_EQ(d.mean, 2);
  EXPECT_DOUBLE_EQ(d.deviation, 1);
  EXPECT_THROW((void)difference(std::vector{1.0}, std::vector{1.0, 2.0}), vantage::Error);
}

TEST(Statistics, Median) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Statistics, AHistoryOnAGrid) {
  const std::vector<double> grid = time_grid(10, 2.5);
  EXPECT_EQ(grid, (std::vector<double>{0, 2.5, 5, 7.5, 10}));
  EXPECT_EQ(time_grid(300, 0.1).size(), 3001u);
  EXPECT_EQ(held(std::vector{0.0, 2.5, 2.6, 9.0}, std::vector{1.0, 2.0, 3.0, 4.0}, grid),
            (std::vector<double>{1, 2, 3, 3, 4}));
  const std::vector<double> late = held(std::vector{5.0}, std::vector{7.0}, grid);
  EXPECT_TRUE(std::isnan(late[0]) && std::isnan(late[1]));
  EXPECT_EQ(late[2], 7);
  EXPECT_EQ(late[4], 7);
  EXPECT_THROW((void)held(std::vector{2.0, 1.0}, std::vector{1.0, 1.0}, grid), vantage::Error);
  EXPECT_THROW((void)held(std::vector{2.0}, std::vector{1.0, 1.0}, grid), vantage::Error);
}

TEST(Statistics, LooksOnAGrid) {
  const std::vector<double> grid = time_grid(10, 2.5), looks = {1, 6}, seen = {4, 14};
  const std::vector<double> values = between_looks(looks, seen, grid);
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_DOUBLE_EQ(values[1], 7);
  EXPECT_DOUBLE_EQ(values[2], 12);
  EXPECT_EQ(values[3], 14);
  EXPECT_EQ(values[4], 14);
  EXPECT_EQ(between_looks(looks, seen, looks), seen);
  EXPECT_EQ(between_looks(std::vector{1.0, 1.0}, std::vector{2.0, 3.0}, std::vector{1.0})[0], 3);
  EXPECT_THROW((void)between_looks(std::vector{2.0, 1.0}, seen, grid), vantage::Error);
}

TEST(Tables, Csv) {
  const Json rows = {{{"name", "a, \"b\""}, {"value", 0.5}, {"none", nullptr}},
                     {{"name", "c"}, {"value", 3}, {"none", 1}}};
  EXPECT_EQ(csv(rows), "name,value,none\n\"a, \"\"b\"\"\",0.5,\nc,3,1\n");
  EXPECT_EQ(csv(Json::array()), "");
}

TEST(Tables, Markdown) {
  const std::string header[] = {"a", "b"}, row[] = {"1", "x | y"};
  study::Markdown table(header);
  table.row(row);
  EXPECT_EQ(table.text(), "| a | b |\n|---|---|\n| 1 | x \\| y |\n");
  EXPECT_THROW(table.row(std::vector<std::string>{"1"}), vantage::Error);
  EXPECT_EQ(with_deviation(0.0264, 0.0023, 3), "0.026 ± 0.002");
  EXPECT_EQ(with_deviation(nan, 1, 3), "-");
  EXPECT_EQ(with_deviation(0.0264, nan, 3), "0.026");
}

Figures thesis(int size) {
  return [size](std::string_view method, std::string_view metric) {
    const PrintedRow* row = printed(method, size);
    if (!row) return nan;
    if (metric == "rmse") return row->rmse.mean;
    if (metric == "rmse_hotspots") return row->rmse_hotspots.mean;
    if (metric == "iou") return row->iou.mean;
    if (metric == "mapping_ms") return row->mapping_ms.mean;
    if (metric == "memory_percent") return row->memory_percent.mean;
    return row->cells.mean;
  };
}

std::optional<bool> met(const std::vector<Tested>& claims, const std::string& beginning) {
  for (const Tested& c : claims)
    if (c.text.rfind(beginning, 0) == 0) return c.met;
  ADD_FAILURE() << "no claim begins with: " << beginning;
  return std::nullopt;
}

// What the printed table says of its own text, read off by hand.
TEST(FieldClaims, OnThePrintedTable) {
  for (const int size : {16, 32, 64}) {
    const std::vector<Tested> claims = test_claims(thesis(size));
    EXPECT_EQ(met(claims, "Assuming independent cells (FR-IDP, AR-IDP)"), size == 64)
        << size;  // 0.045 < 0.071, 0.065 < 0.071
    EXPECT_EQ(met(claims, "Assuming independent cells yields the highest RMSE in hotspots"), true);
    EXPECT_EQ(met(claims, "Assuming independent cells yields the lowest IoU"), true);
    EXPECT_EQ(met(claims, "Merging costs"), true);
    EXPECT_EQ(met(claims, "All GP approaches are comparably"), true);
    EXPECT_EQ(met(claims, "AR-BCM is the slowest"), true);
    EXPECT_EQ(met(claims, "AR-GPR-IK is slower"), true);
    EXPECT_EQ(met(claims, "AR-IDP is slower"), true);
    EXPECT_EQ(met(claims, "Ours has the fastest"), true);
    EXPECT_EQ(met(claims, "FR-GPF takes the most"), true);
    EXPECT_EQ(met(claims, "Ours compresses best"), true);
    EXPECT_EQ(met(claims, "AR-IDP merges worst"), true);
    EXPECT_EQ(met(claims, "Ours is more accurate"), true);
  }
}

TEST(FieldClaims, AFalseFigureIsNoticedAndAMissingOneLeavesItOpen) {
  const auto changed = [&](std::string_view method, std::string_view metric, double to) {
    return test_claims([=](std::string_view m, std::string_view name) {
      return m == method && name == metric ? to : thesis(32)(m, name);
    });
  };
  EXPECT_EQ(met(changed("ours", "mapping_ms", 500), "Ours has the fastest"), false);
  EXPECT_EQ(met(changed("ours", "mapping_ms", nan), "Ours has the fastest"), std::nullopt);
  EXPECT_EQ(met(changed("ours", "rmse_hotspots", 0.03), "All GP approaches are comparably"), false);
  EXPECT_EQ(met(changed("ours", "rmse_hotspots", 0.07), "Ours is more accurate"), false);
  EXPECT_EQ(met(changed("ar_idp", "iou", 0.9), "Assuming independent cells yields the lowest IoU"), false);
  EXPECT_EQ(met(changed("fr_gpf", "memory_percent", nan), "FR-GPF takes"), std::nullopt);
}

TEST(PlanningClaims, FieldByFieldAndOverTime) {
  const std::vector<double> grid = time_grid(120, 30);  // three times count: 60, 90, 120
  const PerField figure = [](std::string_view method, std::string_view name) -> std::vector<double> {
    if (name == "planning_s") return method == "ours" ? std::vector{2.0, 4.0} : std::vector{5.0, 5.0};
    return method == "ours" ? std::vector{0.1, 0.2} : std::vector{0.2, 0.4};
  };
  const auto verdict_of = [&](const OverTime& curve, std::string_view text) {
    for (const Claim& c : test_planning_claims(figure, curve, grid))
      if (c.text.rfind(text, 0) == 0) return c;
    throw std::logic_error("no such claim");
  };
  const auto with_ours = [](std::vector<double> ours) -> OverTime {
    return [ours](std::string_view method, std::string_view) {
      return method == "ours" ? ours : std::vector<double>{0, 0, 3, 3, 3};
    };
  };
  EXPECT_EQ(verdict_of(with_ours({9, 9, 2, 2, 2}), "Ours is best consistently").met, true);
  EXPECT_EQ(verdict_of(with_ours({9, 9, 2, 4, 2}), "Ours is best consistently").met, false);
  EXPECT_EQ(
      verdict_of([](std::string_view, std::string_view) { return std::vector<double>{}; }, "Ours is best consistently")
          .met,
      std::nullopt);
  const Claim planning = verdict_of(with_ours({}), "Ours spends less time planning");
  EXPECT_EQ(planning.met, true);
  EXPECT_EQ(planning.numbers, "Ours 3.00 - FR-GPF 5.00 = -2.00 ± 1.00");
  EXPECT_EQ(verdict_of(with_ours({}), "Ours has the lowest RMSE").met, true);
  EXPECT_EQ(verdict_of(with_ours({}), "Ours has the highest IoU").met, false);
}

struct SizedMap {
  std::size_t cells;
  [[nodiscard]] std::size_t size() const { return cells; }
};

TEST(PublishedClock, ChargesWhatWasPublished) {
  SizedMap map{1024};
  const auto planning_s = [&](std::string_view method, std::size_t cells) {
    map.cells = cells;
    PublishedClock clock(map, published_costs(method));
    clock.begin();
    clock.planned();
    return clock.elapsed_s();
  };
  EXPECT_DOUBLE_EQ(planning_s("fr_gpf", 1024), 3.6);
  EXPECT_DOUBLE_EQ(planning_s("ours", 1024), 4.5);
  EXPECT_NEAR(planning_s("ours", 199), 0.17, 0.001);
  EXPECT_NEAR(planning_s("fr_idp", 1024), 0.24, 0.005);
  EXPECT_NEAR(planning_s("ar_idp", 300), 0.53, 0.005);
  PublishedClock clock(map, published_costs("fr_gpf"));
  clock.travelled(2);
  clock.begin();
  clock.mapped();
  EXPECT_NEAR(clock.elapsed_s(), 2 + 0.430843 / 16, 1e-9);
}

}  // namespace
}  // namespace study

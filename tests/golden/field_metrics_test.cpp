// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/eval/field_metrics.hpp>

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include <vantage/io/csv.hpp>

#include "cell_map.hpp"
#include "golden.hpp"

namespace vantage {
namespace {

struct HotAbove {
  [[nodiscard]] static bool hot(double value) { return value > 0.7; }
};

test::CellMap read_cells(const std::filesystem::path& path) {
  const CsvTable t = read_csv(path);
  test::CellMap map;
  for (std::size_t i = 0; i < t.rows(); ++i)
    map.cells.push_back({{Eigen::Vector2d(t.column("xmin")[i], t.column("ymin")[i]),
                          Eigen::Vector2d(t.column("xmax")[i], t.column("ymax")[i])},
                         t.column("mean")[i],
                         t.column("var")[i]});
  return map;
}

struct GoldenFieldMetrics : test::Golden {
  GoldenFieldMetrics() : Golden("field") {}
};

TEST_F(GoldenFieldMetrics, ThePublishedCodesNumbers) {
  const CsvTable table = read_csv(test::golden("field/b_8x8_gt.csv"));
  Image<double> values(static_cast<Eigen::Index>(table.rows()), static_cast<Eigen::Index>(table.columns()));
  for (std::size_t column = 0; column < table.columns(); ++column)
    for (std::size_t row = 0; row < table.rows(); ++row)
      values(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = table.column(column)[row];
  const ScalarField truth({Eigen::Vector2d(0, 0), Eigen::Vector2d(20, 20)}, values);
  ASSERT_EQ(truth.valid_pixels(), 200 * 200);

  const CsvTable expected = read_csv(test::golden("field/b_8x8_metrics.csv"));
  ASSERT_EQ(expected.rows(), 2u);
  const std::string mappers[] = {"Ours", "FR-GPF"};  // in the order of the file
  for (std::size_t i = 0; i < expected.rows(); ++i) {
    const auto cells =
        read_cells(test::golden(i == 0 ? "field/b_8x8_final_cells.csv" : "field/b_8x8_FR-GPF_final_cells.csv"));
    const FieldMetrics m = field_metrics(cells, truth, HotAbove{});
    EXPECT_EQ(m.pixels, 40'000u);
    EXPECT_EQ(m.cells, cells.size());
    EXPECT_NEAR(m.rmse, expected.column("rmse")[i], 1e-12) << mappers[i];
    EXPECT_NEAR(m.rmse_hotspots, expected.column("rmse_hotspot")[i], 1e-12) << mappers[i];
    EXPECT_NEAR(m.iou, expected.column("iou")[i], 1e-12) << mappers[i];
  }
}

}  // namespace
}  // namespace vantage

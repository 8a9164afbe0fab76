// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/sampled_field.hpp>

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>
#include <vantage/io/field_file.hpp>

namespace vantage {
namespace {

struct RealField {
  const char* file;
  const char* column;
  const char* quantity;
  const char* unit;
  bool gridded;
  std::size_t held_out_at_least, held_out_at_most;
  double low, high;         // range of the file's values: an interpolation stays inside
  double reached;           // share of that range that the truth has, at least
  double valid, tolerance;  // share of the square that is not masked
};

// Ranges and blanks as the files hold them; shares of the square from the extents:
// volcano 860 x 600 m; Rocky Mountains 12 deg cos(38.5 deg) x 10.2 deg; the rest masked in the data or outside the
// hull.
const RealField fields[] = {
    {"volcano_elevation", "", "elevation", "m", true, 0, 0, 94, 195, 0.99, 0.698, 0.005},
    {"rocky_mountain_elevation", "", "elevation", "m", true, 0, 0, 441.96, 3804.21, 0.85, 0.92, 0.02},
    {"luxembourg_elevation", "", "elevation", "m", true, 0, 0, 141, 547, 0.95, 0.36, 0.02},
    {"sea_surface_temperature", "", "sst", "degC", true, 0, 0, -1.8, 32.97, 0.95, 0.34, 0.02},
    {"colorado_spring_temperature", "", "tmin", "degC", false, 30, 43, -11.2274, 4.82222, 0.7, 0.69, 0.05},
    {"colorado_spring_temperature", "tmax", "tmax", "degC", false, 30, 43, 2.53016, 21.4565, 0.7, 0.69, 0.05},
    {"meuse_soil_metals", "zinc", "zinc", "mg/kg", false, 22, 31, 113, 1839, 0.8, 0.36, 0.03},
    {"meuse_soil_metals", "lead", "lead", "mg/kg", false, 22, 31, 37, 654, 0.7, 0.36, 0.03},
};

class RealFields : public testing::TestWithParam<RealField> {};

TEST_P(RealFields, BecomeSaneTruths) {
  if (std::string(VANTAGE_DATA_DIR).empty()) GTEST_SKIP() << "VANTAGE_DATA_DIR is not set";
  const RealField& expected = GetParam();
  const std::string path = std::string(VANTAGE_DATA_DIR) + "/fields/" + expected.file + ".csv";
  const FieldSamples data = *expected.column ? read_field(path, expected.column) : read_field(path);
  EXPECT_EQ(data.quantity.name, expected.quantity);
  EXPECT_EQ(data.quantity.unit, expected.unit);
  const SampledField f = sampled_field(data, Rng(1));
  EXPECT_EQ(f.gridded, expected.gridded);
  EXPECT_GE(f.held_out.size(), expected.held_out_at_least);
  EXPECT_LE(f.held_out.size(), expected.held_out_at_most);
  EXPECT_EQ(f.truth.rows(), 400);
  EXPECT_EQ(f.truth.columns(), 400);
  EXPECT_GE(f.truth.minimum(), expected.low - 1e-9);
  EXPECT_LE(f.truth.maximum(), expected.high + 1e-9);
  EXPECT_GE(f.truth.range(), expected.reached * (expected.high - expected.low));
  EXPECT_NEAR(static_cast<double>(f.truth.valid_pixels()) / 160'000, expected.valid, expected.tolerance);
  double squared = 0;
  for (const FieldSample& s : f.held_out) {
    EXPECT_TRUE(s.value >= expected.low && s.value <= expected.high);
    squared += std::pow(f.truth.at(s.position) - s.value, 2);
  }
  if (f.gridded) return;
  // Neighbours tell something: better than a blind guess over the range.
  EXPECT_LT(std::sqrt(squared / static_cast<double>(f.held_out.size())), 0.2 * (expected.high - expected.low));
}
INSTANTIATE_TEST_SUITE_P(All, RealFields, testing::ValuesIn(fields), [](const auto& field) {
  return std::string(field.param.file) + (*field.param.column ? std::string("_") + field.param.column : "");
});

// A place that everybody knows: 0 is in the middle of the file's lower left corner, north is up.
TEST(RealFields, LieTheRightWayUp) {
  if (std::string(VANTAGE_DATA_DIR).empty()) GTEST_SKIP() << "VANTAGE_DATA_DIR is not set";
  const SampledField sst =
      sampled_field(read_field(std::string(VANTAGE_DATA_DIR) + "/fields/sea_surface_temperature.csv"), Rng(1));
  const auto at = [&](double longitude, double latitude) {
    return sst.truth.at({10 + (longitude - 179) * sst.scale, 10 + latitude * sst.scale});
  };
  EXPECT_GT(at(160, 0), 27) << "western Pacific, on the equator";
  EXPECT_LT(at(200, -60), 6) << "Southern Ocean";
  EXPECT_TRUE(std::isnan(at(135, -25))) << "Australia";
  EXPECT_TRUE(std::isnan(at(260, 40))) << "North America";
  EXPECT_TRUE(std::isnan(at(90, 40))) << "Asia";
  EXPECT_FALSE(std::isnan(at(80, -30))) << "Indian Ocean";
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Confidence of 50 surfels after each of 10 views (section 6.1.3), to 1e-12: the published code, the thesis' equations
// and the ablation.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <vantage/io/csv.hpp>
#include <vantage/maps/surfel/confidence.hpp>

#ifndef VANTAGE_GOLDEN_DIR
#define VANTAGE_GOLDEN_DIR ""
#endif

namespace vantage {
namespace {

constexpr double far_m = 5;

std::filesystem::path golden(const std::string& file) {
  return std::filesystem::path(VANTAGE_GOLDEN_DIR) / "surfel" / "confidence" / file;
}

class GoldenConfidence : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(VANTAGE_GOLDEN_DIR).empty() || !std::filesystem::exists(golden("surfels.csv")))
      GTEST_SKIP() << "VANTAGE_GOLDEN_DIR has no surfel/confidence (now \"" << VANTAGE_GOLDEN_DIR << "\")";
    surfels = read_csv(golden("surfels.csv"));
    views = read_csv(golden("viewpoints.csv"));
    visible = read_csv(golden("visible.csv"));
  }
  // k of every surfel after each view.
  template <class C>
  std::vector<std::vector<double>> after_each_view() const {
    std::vector<std::array<double, C::numbers>> state(surfels.rows());
    std::vector<std::vector<double>> k;
    const auto vector = [](const CsvTable& t, const char* x, const char* y, const char* z, std::size_t row) {
      return Eigen::Vector3d(t.column(x)[row], t.column(y)[row], t.column(z)[row]);
    };
    for (std::size_t v = 0; v < views.rows(); ++v) {
      k.emplace_back();
      for (std::size_t i = 0; i < surfels.rows(); ++i) {
        const Eigen::Vector3d normal = vector(surfels, "nx", "ny", "nz", i),
                              way = vector(views, "x", "y", "z", v) - vector(surfels, "x", "y", "z", i);
        if (visible.column(concat("v", v))[i] == 1)
          C::template observe<double>(state[i], normal, Eigen::Vector3d(way.normalized()), way.norm(), far_m);
        k.back().push_back(C::template value<double>(state[i], normal));
      }
    }
    return k;
  }
  CsvTable surfels, views, visible;
};

TEST_F(GoldenConfidence, IncrementalAfterEachView) {
  const auto k = after_each_view<IncrementalConfidence>();
  const CsvTable t = read_csv(golden("confidence_code_per_step.csv"));
  for (std::size_t v = 0; v < k.size(); ++v)
    for (std::size_t i = 0; i < k[v].size(); ++i) EXPECT_NEAR(k[v][i], t.column(concat("k_after_v", v))[i], 1e-12);
}

TEST_F(GoldenConfidence, DispersionIsTheThesis) {
  const auto k = after_each_view<DispersionConfidence>();
  const CsvTable t = read_csv(golden("confidence_final.csv"));
  std::size_t negative = 0;
  for (std::size_t i = 0; i < k.back().size(); ++i) {
    EXPECT_NEAR(k.back()[i], t.column("k_thesis_eq6.6")[i], 1e-12) << i;
    negative += k.back()[i] < 0;
  }
  EXPECT_EQ(negative, 11U);
}

TEST_F(GoldenConfidence, ViewCountIsTheAblation) {
  const auto k = after_each_view<ViewCountConfidence>();
  const CsvTable t = read_csv(golden("confidence_final.csv"));
  for (std::size_t i = 0; i < k.back().size(); ++i) EXPECT_NEAR(k.back()[i], t.column("k_ablation")[i], 1e-12) << i;
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Confidence of 50 surfels after each of 10 views (section 6.1.3), to 1e-12: the published code, the thesis' equations
// and the ablation.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <vantage/io/csv.hpp>
#include <vantage/maps/surfel/confidence.hpp>

#include "golden.hpp"

namespace vantage {
namespace {

constexpr double far_m = 5;

struct GoldenConfidence : test::Golden {
  GoldenConfidence() : Golden("surfel/confidence") {}
  static CsvTable table(const std::string& name) { return read_csv(test::golden("surfel/confidence/" + name)); }
  // k of every surfel after each view.
  template <class C>
  static std::vector<std::vector<double>> after_each_view() {
    const CsvTable surfels = table("surfels.csv"), views = table("viewpoints.csv"), visible = table("visible.csv");
    std::vector<std::array<double, C::numbers>> state(surfels.rows());
    std::vector<std::vector<double>> k;
    for (std::size_t v = 0; v < views.rows(); ++v) {
      k.emplace_back();
      for (std::size_t i = 0; i < surfels.rows(); ++i) {
        const Eigen::Vector3d normal = test::xyz(surfels, "n", i),
                              way = test::xyz(views, "", v) - test::xyz(surfels, "", i);
        if (visible.column(concat("v", v))[i] == 1)
          C::template observe<double>(state[i], normal, Eigen::Vector3d(way.normalized()), way.norm(), far_m);
        k.back().push_back(C::template value<double>(state[i], normal));
      }
    }
    return k;
  }
};

TEST_F(GoldenConfidence, IncrementalAfterEachView) {
  const auto k = after_each_view<IncrementalConfidence>();
  const CsvTable t = table("confidence_code_per_step.csv");
  for (std::size_t v = 0; v < k.size(); ++v)
    for (std::size_t i = 0; i < k[v].size(); ++i) EXPECT_NEAR(k[v][i], t.column(concat("k_after_v", v))[i], 1e-12);
}

TEST_F(GoldenConfidence, DispersionIsTheThesis) {
  const auto k = after_each_view<DispersionConfidence>();
  const CsvTable t = table("confidence_final.csv");
  std::size_t negative = 0;
  for (std::size_t i = 0; i < k.back().size(); ++i) {
    EXPECT_NEAR(k.back()[i], t.column("k_thesis_eq6.6")[i], 1e-12) << i;
    negative += k.back()[i] < 0;
  }
  EXPECT_EQ(negative, 11U);
}

TEST_F(GoldenConfidence, ViewCountIsTheAblation) {
  const auto k = after_each_view<ViewCountConfidence>();
  const CsvTable t = table("confidence_final.csv");
  for (std::size_t i = 0; i < k.back().size(); ++i) EXPECT_NEAR(k.back()[i], t.column("k_ablation")[i], 1e-12) << i;
}

}  // namespace
}  // namespace vantage

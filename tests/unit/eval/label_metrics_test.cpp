// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/eval/label_metrics.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include "eval_reference.hpp"

namespace vantage {
namespace {

using Labels = LabelMetrics::Labels;

TEST(LabelMetrics, CountsByHand) {
  Labels truth(2, 4), estimate(2, 4);
  truth << 1, 1, 1, 2, 2, 0, 0, 1;
  estimate << 1, 1, 2, 2, 0, 1, 2, 1;
  LabelMetrics m(4);
  m.add(estimate, truth);
  EXPECT_DOUBLE_EQ(m.iou(1), 3.0 / 4) << "the unknown pixel that was called 1 does not count";
  EXPECT_DOUBLE_EQ(m.iou(2), 1.0 / 3);
  EXPECT_TRUE(std::isnan(m.iou(3)));
  EXPECT_DOUBLE_EQ(m.mean_iou(), (3.0 / 4 + 1.0 / 3) / 2);
  EXPECT_DOUBLE_EQ(m.accuracy(), 4.0 / 6);
}

TEST(LabelMetrics, AgreesWithNumpyOverSeveralImages) {
  for (const auto& c : test::reference("labels")) {
    const std::size_t n = c.at("n"), classes = c.at("classes");
    const std::uint32_t seed = c.at("seed");
    const auto t = test::hashed(n, seed), keep = test::hashed(n, seed + 1), other = test::hashed(n, seed + 2);
    Labels truth(50, static_cast<Eigen::Index>(n) / 50), estimate = truth;
    const auto label = [&](double x) { return static_cast<std::uint16_t>(static_cast<double>(classes) * x); };
    for (std::size_t i = 0; i < n; ++i) {
      truth.data()[static_cast<Eigen::Index>(i)] = label(t[i]);
      estimate.data()[static_cast<Eigen::Index>(i)] = label(keep[i] < 0.7 ? t[i] : other[i]);
    }
    LabelMetrics m(classes);
    m.add(estimate.topRows(20), truth.topRows(20));
    m.add(estimate.bottomRows(30), truth.bottomRows(30));
    for (std::size_t k = 1; k < classes; ++k) EXPECT_DOUBLE_EQ(m.iou(k), c.at("iou").at(k - 1).get<double>());
    EXPECT_DOUBLE_EQ(m.accuracy(), c.at("accuracy").get<double>());
  }
}

TEST(LabelMetrics, Refuses) {
  LabelMetrics m(3);
  const Labels one = Labels::Ones(2, 2);
  m.add(one, one);
  EXPECT_THROW(m.add(one, Labels::Ones(2, 3)), Error);
  EXPECT_THROW(m.add(Labels::Constant(2, 2, 3), one), Error);
  EXPECT_THROW(m.add(one, Labels::Constant(2, 2, 3)), Error);
  EXPECT_EQ(m.count(1, 1), 4u) << "what was refused was not counted";
  EXPECT_THROW(LabelMetrics(1), Error);
  EXPECT_TRUE(std::isnan(LabelMetrics(3).mean_iou()));
  EXPECT_TRUE(std::isnan(LabelMetrics(3).accuracy()));
}

}  // namespace
}  // namespace vantage

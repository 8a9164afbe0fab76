// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/sampled_field.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

namespace vantage {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double truth_at(const Eigen::Vector2d& p) { return 3 + 0.01 * p.x() - 0.02 * p.y(); }

FieldSamples lattice(int columns, int rows, double step) {
  FieldSamples data{{}, {"elevation", "m"}};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d p(500 + step * column, -200 + step * row);
      data.samples.push_back({p, truth_at(p)});
    }
  return data;
}
FieldSamples scattered(std::size_t n, std::uint64_t seed) {
  Rng rng(seed);
  FieldSamples data;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d p(500 + 870 * rng.uniform(), -200 + 610 * rng.uniform());
    data.samples.push_back({p, truth_at(p)});
  }
  return data;
}
// From the flight area back to where the samples were taken.
Eigen::Vector2d back(const SampledField& f, const Eigen::Vector2d& p, const Eigen::Vector2d& middle) {
  return middle + (p - f.truth.area().center()) / f.scale;
}

TEST(SampledField, GridIsScaledIntoTheAreaAndInterpolated) {
  const SampledField f = sampled_field(lattice(88, 62, 10), Rng(1));  // 870 x 610
  EXPECT_TRUE(f.gridded);
  EXPECT_TRUE(f.held_out.empty());
  EXPECT_DOUBLE_EQ(f.scale, 20.0 / 870);
  EXPECT_EQ(f.truth.quantity().name, "elevation");
  EXPECT_EQ(f.truth.rows(), 400);
  EXPECT_NEAR(static_cast<double>(f.truth.valid_pixels()) / 160000, 610.0 / 870, 0.003)
      << "the rest of the square is masked";
  EXPECT_TRUE(f.truth.values().topRows(59).isNaN().all()) << "in the middle";
  EXPECT_TRUE(f.truth.values().bottomRows(59).isNaN().all());
  for (Eigen::Index row = 0; row < 400; ++row)
    for (Eigen::Index column = 0; column < 400; ++column)
      if (const double v = f.truth.values()(row, column); !std::isnan(v)) {
        ASSERT_NEAR(v, truth_at(back(f, f.truth.centre(row, column), {935, 105})), 1e-9) << "a plane, values unscaled";
      }
}

TEST(SampledField, TallGridsAndOtherAreasFit) {
  const SampledField f = sampled_field(lattice(21, 41, 1), Rng(1),
                                       {.area_m = {Eigen::Vector2d(-5, 0), Eigen::Vector2d(25, 10)}, .pixels = 90});
  EXPECT_EQ(f.truth.columns(), 90);
  EXPECT_EQ(f.truth.rows(), 30);
  EXPECT_DOUBLE_EQ(f.scale, 10.0 / 40);
  EXPECT_NEAR(static_cast<double>(f.truth.valid_pixels()) / 2700, 5.0 / 30, 0.04);
  EXPECT_FALSE(std::isnan(f.truth.at({10, 5})));
  EXPECT_TRUE(std::isnan(f.truth.at({0, 5})));
}

TEST(SampledField, BlanksAndMissingRowsOfAGridAreMasked) {
  FieldSamples blank = lattice(21, 21, 1), missing = blank;
  for (auto& s : blank.samples)
    if (s.position == Eigen::Vector2d(510, -190)) s.value = nan;
  std::erase_if(missing.samples, [](const FieldSample& s) { return s.position == Eigen::Vector2d(510, -190); });
  const SampledField a = sampled_field(blank, Rng(1)), b = sampled_field(missing, Rng(1));
  EXPECT_TRUE(a.gridded && b.gridded);
  EXPECT_TRUE(std::isnan(a.truth.at({10, 10})));
  EXPECT_TRUE(std::isnan(a.truth.at({9.1, 10.9}))) << "one of four neighbours is missing";
  EXPECT_FALSE(std::isnan(a.truth.at({8.9, 10}))) << "all four are there";
  EXPECT_EQ(a.truth.valid_pixels(), 160000 - 40 * 40);
  EXPECT_EQ(b.truth.valid_pixels(), a.truth.valid_pixels());
}

TEST(SampledField, RoundedLatticesAreLattices) {
  FieldSamples data;
  for (int row = 0; row < 90; ++row)
    for (int column = 0; column < 95; ++column) {  // 30 arc-seconds with six digits
      const double x = std::round((5.741667 + column / 120.0) * 1e5) / 1e5,
                   y = std::round((49.4375 + row / 120.0) * 1e4) / 1e4;
      data.samples.push_back({{x, y}, x + y});
    }
  EXPECT_TRUE(sampled_field(data, Rng(1)).gridded);
  std::erase_if(data.samples, [](const FieldSample& s) { return s.position.x() > 6.0 && s.position.x() < 6.1; });
  EXPECT_TRUE(sampled_field(data, Rng(1)).gridded) << "with columns missing";
}

TEST(SampledField, OrderAndRepetitionInTheFileDoNotMatter) {
  for (FieldSamples data : {lattice(10, 8, 3), scattered(100, 5)}) {
    const SampledField a = sampled_field(data, Rng(3));
    data.samples.push_back(data.samples.front());
    std::reverse(data.samples.begin(), data.samples.end());
    const SampledField b = sampled_field(data, Rng(3));
    EXPECT_TRUE(
        ((a.truth.values() == b.truth.values()) || (a.truth.values().isNaN() && b.truth.values().isNaN())).all());
    ASSERT_EQ(a.held_out.size(), b.held_out.size());
    for (std::size_t i = 0; i < a.held_out.size(); ++i) EXPECT_EQ(a.held_out[i].position, b.held_out[i].position);
  }
}

TEST(SampledField, ScatteredSamplesGiveAHullAndHeldOutPoints) {
  const FieldSamples data = scattered(400, 2);
  const SampledField f = sampled_field(data, Rng(1));
  EXPECT_FALSE(f.gridded);
  EXPECT_LE(f.held_out.size(), 80u);
  EXPECT_GE(f.held_out.size(), 70u) << "but for a few outside of the hull";
  Box2 extent;
  for (const auto& s : data.samples) extent.extend(s.position);
  for (const FieldSample& s : f.held_out) {
    EXPECT_FALSE(std::isnan(f.truth.at(s.position)));
    EXPECT_NEAR(s.value, truth_at(back(f, s.position, extent.center())), 1e-9) << "placed like the truth";
  }
  for (Eigen::Index row = 0; row < 400; ++row)
    for (Eigen::Index column = 0; column < 400; ++column)
      if (const double v = f.truth.values()(row, column); !std::isnan(v)) {
        ASSERT_NEAR(v, truth_at(back(f, f.truth.centre(row, column), extent.center())), 1e-6);
      }
}

TEST(SampledField, TheTruthDoesNotKnowTheHeldOutValues) {
  FieldSamples data = scattered(200, 2);
  const SampledField f = sampled_field(data, Rng(1));
  ASSERT_FALSE(f.held_out.empty());
  for (const FieldSample& held : f.held_out)
    for (auto& s : data.samples)
      if (s.value == held.value) s.value += 1000;
  const SampledField g = sampled_field(data, Rng(1));
  EXPECT_LT(g.truth.maximum(), 500);
  EXPECT_TRUE(((f.truth.values() == g.truth.values()) || (f.truth.values().isNaN() && g.truth.values().isNaN())).all());
}

TEST(SampledField, TheSplitFollowsTheSeedAndTheShare) {
  const FieldSamples data = scattered(100, 2);
  const auto first = [&](std::uint64_t seed) { return sampled_field(data, Rng(seed)).held_out.front().position; };
  EXPECT_EQ(first(1), first(1));
  EXPECT_NE(first(1), first(2));
  EXPECT_TRUE(sampled_field(data, Rng(1), {.held_out = 0}).held_out.empty());
}

TEST(SampledField, SamplesWithRoundedCoordinatesAreNotAGrid) {
  FieldSamples data = scattered(150, 4);
  for (auto& s : data.samples) s.position = s.position.array().round();
  EXPECT_FALSE(sampled_field(data, Rng(1)).gridded);
}

TEST(SampledField, RefusesWhatGivesNoField) {
  const auto refused = [](const FieldSamples& data, const std::string& why) {
    try {
      static_cast<void>(sampled_field(data, Rng(1)));
      ADD_FAILURE() << why;
    } catch (const Error& e) { EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what(); }
  };
  refused({}, "0 samples");
  refused(scattered(4, 1), "4 samples");
  FieldSamples data = scattered(50, 1);
  for (auto& s : data.samples) s.value = nan;
  refused(data, "0 samples with a value");
  data = scattered(50, 1);
  data.samples[7].position.x() = nan;
  refused(data, "not finite");
  data = scattered(50, 1);
  data.samples[7].value = -std::numeric_limits<double>::infinity();
  refused(data, "not finite");
  data = scattered(50, 1);
  for (auto& s : data.samples) s.position.y() = 3;
  refused(data, "a rectangle");
  for (auto& s : data.samples) s.position.y() = s.position.x();
  refused(data, "on a line");
  data = scattered(50, 1);
  for (auto& s : data.samples) s.position *= 1e305;
  refused(data, "a rectangle");
  for (auto& s : data.samples) s.position *= 1e-305 * 1e-312;
  EXPECT_THROW(static_cast<void>(sampled_field(data, Rng(1))), Error);
  EXPECT_THROW(static_cast<void>(sampled_field(scattered(50, 1), Rng(1), {.pixels = 0, .held_out = 2})), Error);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include <vantage/loop/clocks.hpp>

namespace vantage {
namespace {

TEST(ModelledClock, AddsWhatItIsTold) {
  ModelledClock clock({.mapping_s = 0.5, .planning_s = 2});
  clock.begin();
  clock.planned();
  EXPECT_EQ(clock.elapsed_s(), 2);
  clock.travelled(3.25);
  clock.begin();
  clock.mapped();
  EXPECT_EQ(clock.elapsed_s(), 5.75);
  EXPECT_THROW(ModelledClock({.mapping_s = -1}), Error);
  EXPECT_THROW(ModelledClock({.planning_s = std::nan("")}), Error);
}

TEST(MeasuredClock, CountsComputingAndTravelButNothingElse) {
  using std::chrono::milliseconds;
  MeasuredClock clock;
  clock.begin();
  std::this_thread::sleep_for(milliseconds(20));
  clock.planned();
  const double planned_s = clock.elapsed_s();
  EXPECT_GE(planned_s, 0.02);
  std::this_thread::sleep_for(milliseconds(20));  // the simulation
  EXPECT_EQ(clock.elapsed_s(), planned_s);
  clock.travelled(100);
  EXPECT_EQ(clock.elapsed_s(), planned_s + 100);
}

TEST(WallClock, RunsByItself) {
  WallClock clock;
  const double before = clock.elapsed_s();
  clock.travelled(1e6);  // a real robot's travel takes its own time
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_GE(clock.elapsed_s() - before, 0.005);
  EXPECT_LT(clock.elapsed_s(), 1e5);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/planning/a_star.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "golden.hpp"

namespace vantage {
namespace {

using GoldenPathLength = test::ToyRoom;

TEST_F(GoldenPathLength, ThePublishedCodesLengths) {
  const test::MaskedRoom map;
  ASSERT_EQ(grid.size(), Eigen::Vector3i(13, 11, 8));
  const std::string text = test::text_of(file("path_length.csv"));  // a column with a title, infinite where no path is
  const std::vector<double> expected_m = test::numbers(text.substr(text.find('\n')));
  ASSERT_EQ(expected_m.size(), 13u * 11 * 8);

  std::vector<View> goals;
  for (std::size_t i = 0; i < expected_m.size(); ++i) {
    const Eigen::Vector3d centre = grid.centre(voxel_in(i));
    goals.push_back(nadir(centre.x(), centre.y(), centre.z()));
  }
  const std::vector<double> lengths_m = AStar({.own_ball_m = 0.3}).lengths_m(map, goals[283], goals);
  std::size_t reachable = 0;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    reachable += std::isfinite(expected_m[i]);
    if (std::isfinite(expected_m[i]))
      EXPECT_NEAR(lengths_m[i], expected_m[i], 1e-9) << i;
    else
      EXPECT_EQ(lengths_m[i], expected_m[i]) << i;
  }
  EXPECT_EQ(reachable, 120u);
}

}  // namespace
}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>

#include "random_pose.hpp"

namespace vantage {
namespace {

TEST(Box, DistanceToASegmentIsTheLeastOfItsPoints) {
  Rng rng(1);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d corner = test::random_point(rng, 1), other = test::random_point(rng, 1);
    const Box3 box(corner.cwiseMin(other), corner.cwiseMax(other));
    Eigen::Vector3d from = test::random_point(rng, 2), to = test::random_point(rng, 2);
    if (i % 5 == 0) to[i % 3] = from[i % 3];  // along a side
    if (i % 17 == 0) to = from;
    double least = std::numeric_limits<double>::infinity();
    constexpr int n = 4000;
    for (int k = 0; k <= n; ++k)
      least = std::min(least, box.squaredExteriorDistance(Eigen::Vector3d(from + (to - from) * k / n)));
    const double d = squared_distance(box, from, to);
    EXPECT_LE(d, least + 1e-12);
    EXPECT_NEAR(std::sqrt(d), std::sqrt(least), (to - from).norm() / n);  // a sample is as close to the nearest point
    EXPECT_NEAR(d, squared_distance(box, to, from), 1e-12);
  }
}

}  // namespace
}  // namespace vantage

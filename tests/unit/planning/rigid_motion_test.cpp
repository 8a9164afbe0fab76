// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>
#include <vantage/planning/rigid_motion.hpp>

#include "random_pose.hpp"

namespace vantage {
namespace {

TEST(RigidMotion, GoesFromOnePoseToTheOtherAtConstantSpeedTheShorterWay) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Isometry3d a = test::random_pose(rng, 3), b = test::random_pose(rng, 3);
    const RigidMotion motion(a, b);
    EXPECT_TRUE(motion.at(0).isApprox(a, 1e-12));
    EXPECT_TRUE(motion.at(1).isApprox(b, 1e-9));
    const Eigen::AngleAxisd whole(a.linear().transpose() * b.linear()),
        part(a.linear().transpose() * motion.at(0.3).linear());
    EXPECT_NEAR(part.angle(), 0.3 * whole.angle(), 1e-7);
    EXPECT_TRUE(motion.at(0.3).translation().isApprox(0.7 * a.translation() + 0.3 * b.translation(), 1e-12));
  }
}

TEST(RigidMotion, NoPointOfABodyMovesFartherThanItsShareOfTheWay) {
  Rng rng(2);
  for (int i = 0; i < 2000; ++i) {
    const RigidMotion motion(test::random_pose(rng, 1), test::random_pose(rng, 1));
    const Eigen::Vector3d p = test::random_point(rng, 1);
    double s = rng.uniform(), t = rng.uniform();
    EXPECT_LE((motion.at(t) * p - motion.at(s) * p).norm(), std::abs(t - s) * motion.way_m(p.norm()) + 1e-9);
  }
}

}  // namespace
}  // namespace vantage

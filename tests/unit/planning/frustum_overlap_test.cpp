// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/planning/frustum_overlap.hpp>

#include "message_of.hpp"
#include "random_pose.hpp"

namespace vantage {
namespace {

const Camera square = Camera::from_fov(64, 64, deg(90));  // as wide as deep, to either side

ViewFrustum along_x(const Eigen::Vector3d& eye, double near_m = 1, double far_m = 3, double sign = 1) {
  return ViewFrustum::of(look_at(eye, eye + sign * Eigen::Vector3d::UnitX()), square, near_m, far_m);
}

// Slow and obvious: the widest gap along the normals of all faces and the products of all pairs of corners' lines.
double gap(const ViewFrustum& a, const ViewFrustum& b) {
  const auto lines = [](const ViewFrustum& f) {
    std::vector<Eigen::Vector3d> all;
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (const Eigen::Vector3d d = f.corners[i] - f.corners[k]; d.norm() > 1e-9) all.push_back(d.normalized());
    return all;
  };
  const auto mine = lines(a), others = lines(b);
  double widest = -std::numeric_limits<double>::infinity();
  const auto project = [&](const Eigen::Vector3d& cross) {
    if (cross.norm() < 1e-9) return;
    const Eigen::Vector3d n = cross.normalized();
    double a_low = 1e9, a_high = -1e9, b_low = 1e9, b_high = -1e9;
    for (std::size_t i = 0; i < 8; ++i) {
      a_low = std::min(a_low, n.dot(a.corners[i]));
      a_high = std::max(a_high, n.dot(a.corners[i]));
      b_low = std::min(b_low, n.dot(b.corners[i]));
      b_high = std::max(b_high, n.dot(b.corners[i]));
    }
    widest = std::max({widest, b_low - a_high, a_low - b_high});
  };
  for (const auto* set : {&mine, &others})
    for (const Eigen::Vector3d& u : *set)
      for (const Eigen::Vector3d& v : *set) project(u.cross(v));
  for (const Eigen::Vector3d& u : mine)
    for (const Eigen::Vector3d& v : others) project(u.cross(v));
  return widest;
}

TEST(FrustumOverlap, ClosedForms) {
  const ViewFrustum a = along_x({0, 0, 0});
  EXPECT_TRUE(overlaps(a, a));                              // the same view
  EXPECT_FALSE(overlaps(a, along_x({0, 0, 0}, 1, 3, -1)));  // back to back
  EXPECT_FALSE(overlaps(a, along_x({0, 0, 0}, 0, 3, -1)));  // from x = 1 on, and up to x = 0
  EXPECT_TRUE(overlaps(a, along_x({4, 0, 0}, 1, 3, -1)));   // face to face: 1 to 3, and 1 to 3
  EXPECT_TRUE(overlaps(a, along_x({0, 0, 0}, 1.5, 2)));     // one inside of another
  EXPECT_TRUE(overlaps(along_x({0.8, 0.1, 0}, 0.5, 1), along_x({0, 0, 0}, 0, 10)));
  EXPECT_TRUE(overlaps(a, along_x({2, 0, 0}, 1, 2)));  // end to end: they touch at x = 3
  EXPECT_FALSE(overlaps(a, along_x({2 + 1e-6, 0, 0}, 1, 2)));
  EXPECT_TRUE(overlaps(a, along_x({0, 6, 0})));  // side by side: edges touch at (3, 3)
  EXPECT_FALSE(overlaps(a, along_x({0, 6 + 1e-6, 0})));
  EXPECT_TRUE(overlaps(a, along_x({0, 6 - 1e-6, 0})));
}

TEST(FrustumOverlap, AgreesWithSeparatingAxes) {
  Rng rng(1);
  int apart = 0, together = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto random = [&] {
      View view;
      view.T_W_C = test::random_pose(rng, 3);
      const double near_m = rng.uniform() < 0.3 ? 0 : rng.uniform(0, 0.5), far_m = rng.uniform(1, 4);
      return ViewFrustum::of(view, Camera::from_fov(64, 48, rng.uniform(0.3, 2.5)), near_m, far_m);
    };
    const ViewFrustum a = random(), b = random();
    const double reference = gap(a, b);
    if (std::abs(reference) < 1e-9) continue;
    ASSERT_EQ(overlaps(a, b), reference < 0) << i;
    ASSERT_EQ(overlaps(b, a), reference < 0) << i;
    ++(reference < 0 ? together : apart);
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(together, 500);
}

// Corners that line up with each other are what GJK trips over.
TEST(FrustumOverlap, AgreesWithSeparatingAxesForViewsAlongTheWorldsAxes) {
  Rng rng(2);
  const Camera camera{.width = 2, .height = 2, .fx = 1, .fy = 1, .cx = 1, .cy = 1};
  for (int i = 0; i < 4000; ++i) {
    const auto random = [&] {
      View view;
      for (int k = 0; k < 3; ++k)
        view.T_W_C.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi * static_cast<double>(rng.index(4)),
                                            Eigen::Vector3d::Unit(static_cast<Eigen::Index>(rng.index(3)))));
      view.T_W_C.linear() = view.T_W_C.linear().array().round();
      view.T_W_C.translation() = test::random_point(rng, 4).array().round();
      return ViewFrustum::of(view, camera, static_cast<double>(rng.index(2)), 2.0 + static_cast<double>(rng.index(2)));
    };
    const ViewFrustum a = random(), b = random();
    const bool touch_or_overlap = gap(a, b) < 1e-9;
    ASSERT_EQ(overlaps(a, b), touch_or_overlap) << i;
    ASSERT_EQ(overlaps(b, a), touch_or_overlap) << i;
  }
}

TEST(FrustumOverlap, WhatIsNotFiniteOverlaps) {
  ViewFrustum a = along_x({0, 0, 0}), far = along_x({100, 0, 0});
  ASSERT_FALSE(overlaps(a, far));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ViewFrustum b = far;
    b.corners[3].y() = bad;
    EXPECT_TRUE(overlaps(a, b));
    EXPECT_TRUE(overlaps(b, a));
  }
  ViewFrustum point;
  point.corners.fill({1, 2, 3});
  EXPECT_TRUE(overlaps(point, point));
}

TEST(FrustumOverlap, RefusesWhatIsNoView) {
  const auto said = [](const View& view, double near_m, double far_m) {
    return test::message_of([&] { return ViewFrustum::of(view, square, near_m, far_m); });
  };
  EXPECT_NE(said({}, -1, 2).find("near_m"), std::string::npos);
  EXPECT_NE(said({}, 2, 2).find("far_m"), std::string::npos);
  EXPECT_NE(said({}, 0, std::numeric_limits<double>::quiet_NaN()).find("far_m"), std::string::npos);
  View view;
  view.T_W_C.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(said(view, 0, 1).find("finite"), std::string::npos);
}

}  // namespace
}  // namespace vantage

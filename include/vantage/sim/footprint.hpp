// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <vantage/geometry/box.hpp>

namespace vantage {

/// The rectangle that something covers on the ground [m], turned by yaw about the vertical.
struct Footprint {
  Eigen::Vector2d centre, half;
  double yaw_rad = 0;

  [[nodiscard]] Eigen::Matrix2d axes() const { return Eigen::Rotation2Dd(yaw_rad).toRotationMatrix(); }
  [[nodiscard]] std::array<Eigen::Vector2d, 4> corners() const {
    const Eigen::Vector2d a = axes().col(0) * half.x(), b = axes().col(1) * half.y();
    return {centre - a - b, centre + a - b, centre + a + b, centre - a + b};
  }
  [[nodiscard]] Box2 bounds() const {
    Box2 box;
    for (const Eigen::Vector2d& c : corners()) box.extend(c);
    return box;
  }
  /// The solid's frame: origin in the middle of the footprint at height z.
  [[nodiscard]] Eigen::Isometry3d pose(double z_m = 0) const {
    Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
    t.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    t.translation() << centre, z_m;
    return t;
  }
};

/// How far two rectangles are apart along the axis of theirs on which they are farthest apart [m]: above 0 if and only
/// if they are disjoint (separating axes; Gottschalk et al., SIGGRAPH 1996); a lower bound of their distance.
inline double gap_m(const Footprint& a, const Footprint& b) {
  double gap = -std::numeric_limits<double>::infinity();
  for (const Footprint* f : {&a, &b})
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d axis = f->axes().col(k);
      const auto reach = [&](const Footprint& g) { return (g.axes().transpose() * axis).cwiseAbs().dot(g.half); };
      gap = std::max(gap, std::abs((b.centre - a.centre).dot(axis)) - reach(a) - reach(b));
    }
  return gap;
}

}  // namespace vantage

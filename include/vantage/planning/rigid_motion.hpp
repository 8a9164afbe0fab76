// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>

#include <vantage/geometry/view.hpp>

namespace vantage {

/// How a robot goes from one pose to another: its origin on a straight line at constant speed, turning at constant rate
/// about one axis, the shorter way. Poses have to be rigid transforms.
class RigidMotion {
 public:
  RigidMotion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to)
      : from_(from), step_m_(to.translation() - from.translation()), turn_(from.linear().transpose() * to.linear()) {}

  /// The pose at `t` in [0, 1].
  [[nodiscard]] Eigen::Isometry3d at(double t) const {
    Eigen::Isometry3d pose = from_;
    pose.translation() += t * step_m_;
    pose.linear() = from_.linear() * Eigen::AngleAxisd(t * turn_.angle(), turn_.axis()).toRotationMatrix();
    return pose;
  }
  /// The longest way [m] of any point of a body, all of which lies within `reach_m` of the robot's origin; a share of
  /// the motion moves no point farther than this share of it.
  [[nodiscard]] double way_m(double reach_m) const { return step_m_.norm() + turn_.angle() * reach_m; }

 private:
  Eigen::Isometry3d from_;
  Eigen::Vector3d step_m_;
  Eigen::AngleAxisd turn_;
};

}  // namespace vantage

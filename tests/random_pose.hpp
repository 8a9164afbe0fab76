// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>

#include <vantage/core/rng.hpp>

namespace vantage::test {

/// Uniform in the cube from -reach to reach.
inline Eigen::Vector3d random_point(Rng& rng, double reach) {
  const double x = rng.uniform(-reach, reach), y = rng.uniform(-reach, reach), z = rng.uniform(-reach, reach);
  return {x, y, z};
}
inline Eigen::Matrix3d random_rotation(Rng& rng) {
  const double w = rng.normal(), x = rng.normal(), y = rng.normal(), z = rng.normal();
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}
inline Eigen::Isometry3d random_pose(Rng& rng, double reach) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = random_rotation(rng);
  pose.translation() = random_point(rng, reach);
  return pose;
}

}  // namespace vantage::test

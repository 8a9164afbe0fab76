// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

#include <vantage/geometry/view.hpp>

namespace vantage {

/// Where a robot under this camera is heading: the horizontal part of where it looks, or, looking straight down or up,
/// where it would look after it raised or lowered its camera by a right angle. A unit vector, world frame.
inline Eigen::Vector3d heading(const View& view) {
  const Eigen::Vector3d forward = view.forward(), down = view.T_W_C.linear().col(1);
  Eigen::Vector3d along(forward.x(), forward.y(), 0);
  if (along.norm() < 1e-6)
    along = forward.z() < 0 ? Eigen::Vector3d(-down.x(), -down.y(), 0) : Eigen::Vector3d(down.x(), down.y(), 0);
  return along.normalized();
}

}  // namespace vantage

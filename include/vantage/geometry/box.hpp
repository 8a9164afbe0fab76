// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>
#include <cmath>

namespace vantage {

/// Axis-aligned boxes in the world frame [m].
using Box2 = Eigen::AlignedBox2d;
using Box3 = Eigen::AlignedBox3d;

/// Whether a box is finite and has a positive length along every axis.
template <int D>
bool is_proper(const Eigen::AlignedBox<double, D>& box) {
  for (int axis = 0; axis < D; ++axis) {
    const double low = box.min()[axis], high = box.max()[axis];
    if (!std::isfinite(low) || !std::isfinite(high) || !(high > low)) return false;
  }
  return true;
}

/// Area [m^2] of a box; 0 if empty.
inline double area(const Box2& box) { return box.isEmpty() ? 0.0 : box.sizes().prod(); }

}  // namespace vantage

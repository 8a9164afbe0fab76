// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>

namespace vantage {

/// Axis-aligned boxes in the world frame [m].
using Box2 = Eigen::AlignedBox2d;
using Box3 = Eigen::AlignedBox3d;

/// Area [m^2] of a box; 0 if empty.
inline double area(const Box2& box) { return box.isEmpty() ? 0.0 : box.sizes().prod(); }

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>

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

/// Least square of a distance [m^2] between a box and the points of a segment; exact to rounding.
inline double squared_distance(const Box3& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d step = to - from;
  const auto excess = [&](double t) -> Eigen::Vector3d {  // from the box to the point at t
    const Eigen::Vector3d p = from + t * step;
    return p - p.cwiseMax(box.min()).cwiseMin(box.max());
  };
  const auto slope = [&](double t) { return excess(t).dot(step); };
  // The square is convex in t, and quadratic between the planes of the box's sides; its slope is linear there.
  std::array<double, 8> bends = {0};  // ascending
  std::size_t n = 1;
  for (int i = 0; i < 3; ++i)
    for (const double side : {box.min()[i], box.max()[i]})
      if (const double t = (side - from[i]) / step[i]; t > 0 && t < 1) {
        std::size_t k = n++;
        for (; bends[k - 1] > t; --k) bends[k] = bends[k - 1];
        bends[k] = t;
      }
  bends[n++] = 1;
  double before = slope(0), t = 0;
  for (std::size_t k = 1; k < n && before < 0; ++k) {
    const double after = slope(bends[k]);
    t = after > 0 ? bends[k - 1] + (bends[k] - bends[k - 1]) * before / (before - after) : bends[k];
    before = after;
  }
  return excess(t).squaredNorm();
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include <vantage/maps/surfel/surfels.hpp>

namespace vantage {

/// A unit quaternion (w, x, y, z) of a rotation that takes the z axis to a unit vector; no direction is singular.
template <class T>
std::array<T, 4> quaternion_towards(const Eigen::Matrix<T, 3, 1>& normal) {
  // The shortest rotation. To the lower half it would be ill-conditioned: the shortest to the mirrored normal, and then
  // half a turn about x.
  const T up = 1 + std::abs(normal.z());
  const T length = std::sqrt(up * up + normal.x() * normal.x() + normal.y() * normal.y());
  if (normal.z() >= 0) return {up / length, -normal.y() / length, normal.x() / length, 0};
  return {-normal.y() / length, up / length, 0, normal.x() / length};
}

/// The third axis of the rotation of a quaternion of any length but 0 (0 gives a unit vector as well).
template <class T>
Eigen::Matrix<T, 3, 1> normal_of(T w, T x, T y, T z) {
  const T square = w * w + x * x + y * y + z * z;
  const T s = square > 0 ? 2 / square : 0;
  return {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)};
}

/// World frame.
inline Eigen::Vector3f normal_of(const Surfels& s, std::size_t i) {
  const auto& p = s.parameter;
  return normal_of(p[surfel::qw][i], p[surfel::qx][i], p[surfel::qy][i], p[surfel::qz][i]);
}
inline Eigen::Vector3f position_of(const Surfels& s, std::size_t i) {
  return {s.parameter[surfel::x][i], s.parameter[surfel::y][i], s.parameter[surfel::z][i]};
}
inline float opacity_of(const Surfels& s, std::size_t i) { return 1 / (1 + std::exp(-s.parameter[surfel::logit][i])); }

}  // namespace vantage

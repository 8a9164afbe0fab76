// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/frame.hpp>

namespace bench {

/// A room of 6 x 5 x 2.5 m with a ball and a chest, by closed forms; what kernels that take frames are measured on.
struct Room {
  vantage::Box3 walls{Eigen::Vector3d(-3, -2.5, 0), Eigen::Vector3d(3, 2.5, 2.5)};
  vantage::Box3 chest{Eigen::Vector3d(1.5, -1.5, 0), Eigen::Vector3d(2.5, -0.5, 0.8)};
  Eigen::Vector3d ball{1, 0.5, 0.8};
  double ball_radius_m = 0.5;

  /// Least t > 0 at which a ray from inside of the room meets something.
  [[nodiscard]] double hit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    const auto slabs = [&](const vantage::Box3& box) {
      const Eigen::Array3d inverse = direction.array().inverse();
      const Eigen::Array3d a = (box.min() - from).array() * inverse, b = (box.max() - from).array() * inverse;
      return std::pair(a.min(b).maxCoeff(), a.max(b).minCoeff());
    };
    double t = slabs(walls).second;
    if (const auto [enter, leave] = slabs(chest); enter > 0 && enter <= leave) t = std::min(t, enter);
    const Eigen::Vector3d o = from - ball;
    const double a = direction.squaredNorm(), b = o.dot(direction);
    const double root = b * b - a * (o.squaredNorm() - ball_radius_m * ball_radius_m);
    if (root > 0 && -b - std::sqrt(root) > 0) t = std::min(t, (-b - std::sqrt(root)) / a);
    return t;
  }
};

/// What a camera with 60 degrees and noise of 1 % of the depth sees there, in colour.
inline vantage::Frame room_frame(int size_px, const vantage::View& view, std::uint64_t seed = 1) {
  const Room room;
  vantage::Rng rng(seed);
  vantage::Frame f;
  f.camera = vantage::Camera::from_fov(size_px, size_px, vantage::deg(60));
  f.view = view;
  f.depth.resize(size_px, size_px);
  f.colour.resize(size_px, size_px);
  for (int v = 0; v < size_px; ++v)
    for (int u = 0; u < size_px; ++u) {
      const Eigen::Vector3d ray = view.T_W_C.linear() * f.camera.ray(u + 0.5, v + 0.5);
      const double z = room.hit(view.position(), ray), noisy = z * (1 + 0.01 * rng.normal());
      f.depth(v, u) = noisy <= 5 ? static_cast<float>(noisy) : std::numeric_limits<float>::quiet_NaN();
      const Eigen::Array3d at =
          ((view.position() + z * ray - room.walls.min()).array() / room.walls.sizes().array()).max(0).min(1);
      f.colour.r(v, u) = static_cast<float>(at.x());
      f.colour.g(v, u) = static_cast<float>(at.y());
      f.colour.b(v, u) = static_cast<float>(at.z());
    }
  return f;
}

}  // namespace bench

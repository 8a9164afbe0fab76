// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/frame.hpp>

#include "analytic_scene.hpp"

// What voxel maps are tried on: a small room with a ball in it, seen from random places.
namespace vantage::test {

inline const Box3 small_room(Eigen::Vector3d(-1.3, -0.9, 0), Eigen::Vector3d(1.4, 1.2, 1.7));

/// Without noise.
inline Frame observe_room(const View& view, const Camera& camera) {
  return observe(all_of(Cuboid{small_room}, Sphere{{0.4, 0.2, 0.6}, 0.35}), view, camera, small_room);
}

/// From a random point in the room in a random direction, with noise, holes in the depth and labels 0 to 4.
inline Frame random_frame(Rng rng, int size_px = 48) {
  const Eigen::Vector3d eye =
      small_room.min() + small_room.sizes().cwiseProduct(
                             Eigen::Vector3d(rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9)));
  const double heading = rng.uniform(0, 2 * std::numbers::pi), pitch = rng.uniform(-0.7, 0.5);
  const View view = look_at(eye, eye + Eigen::Vector3d(std::cos(heading), std::sin(heading), std::sin(pitch)));
  Frame f = observe_room(view, Camera::from_fov(size_px, size_px - 7, deg(70)));
  f.labels.resize(f.depth.rows(), f.depth.cols());
  for (Eigen::Index i = 0; i < f.depth.size(); ++i) {
    float& d = f.depth.data()[i];
    d *= static_cast<float>(1 + 0.01 * rng.normal());
    if (rng.uniform() < 0.1) d = std::numeric_limits<float>::quiet_NaN();
    f.labels.data()[i] = static_cast<std::uint16_t>(5 * rng.uniform());
  }
  return f;
}

}  // namespace vantage::test

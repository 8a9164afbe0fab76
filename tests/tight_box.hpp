// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

#include <vantage/core/units.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

namespace vantage::test {

/// A map of 1.2 x 0.4 x 0.4 m (or less) for a robot that needs 0.3 m around its centre: all of it is free up to
/// x = 0.8 m, the rest was never seen, and nowhere does the robot fit.
inline VoxelMap<> tight_box(double length_m = 1.2, double height_m = 0.4) {
  VoxelMap<>::Config config;
  config.bounds = Box3(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(length_m, height_m, height_m));
  config.voxel_m = 0.1;
  config.range.max_m = 20.75;
  VoxelMap<> map(config);
  Frame f;  // from so far away that its rays are parallel
  f.camera = Camera::from_fov(64, 64, deg(2));
  f.view = look_at({-20, 0.5 * height_m, 0.5 * height_m}, {0, 0.5 * height_m, 0.5 * height_m});
  f.depth.setConstant(64, 64, 100.0F);
  map.integrate(f);
  return map;
}

}  // namespace vantage::test

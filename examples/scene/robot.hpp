// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/core/units.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/sampler/frontier.hpp>
#include <vantage/sampler/local.hpp>
#include <vantage/selector/minus_cost.hpp>
#include <vantage/utility/unexplored.hpp>
#include <vantage/utility/uninformed.hpp>

#include "input.hpp"

namespace scene {

using namespace vantage;

/// A robot with a depth camera that flies where its voxels are free, and the policies that do not depend on what else
/// it learns.
struct Robot {
  Box3 bounds;         ///< of what there is to learn [m]
  double voxel_m;      ///< of the map that it flies by
  double clearance_m;  ///< around the robot's centre
  double range_m;      ///< of depth
  double speed_m_s;
  double field_of_view_rad;
  Camera sensor;  ///< as utilities render it

  Robot(const Options& o, const Input& input)
      : bounds(input.bounds),
        voxel_m(o.map_voxel()),
        clearance_m(o.body_radius_m),
        range_m(o.range_m),
        speed_m_s(o.speed_m_s),
        field_of_view_rad(deg(o.field_of_view_deg)),
        sensor(Camera::from_fov(128, 128, field_of_view_rad)) {}

  /// What its voxels are like, in the configuration of a voxel map.
  template <class VoxelConfig>
  void set(VoxelConfig& c) const {
    c.bounds = bounds;
    c.voxel_m = voxel_m;
    c.clearance_m = clearance_m;
    c.range = {.max_m = range_m, .no_return_m = range_m};
  }
  [[nodiscard]] Frontier frontiers() const {
    return Frontier({.cone = {.farthest_m = 0.5 * range_m, .min_cosine = 0.25}, .smallest_m2 = 0.02});
  }
  [[nodiscard]] Unexplored unexplored() const { return Unexplored({.camera = sensor, .far_m = range_m}); }
  /// Flies to any view nearby.
  template <class M, class Router>
  [[nodiscard]] auto wander(M map, const Router& route) const {
    return NbvLoop{std::move(map), Uninformed{}, Local({.radius_m = 2}),
                   MinusCost(route, {.weight_per_m = 0, .speed_m_s = speed_m_s})};
  }
};

}  // namespace scene

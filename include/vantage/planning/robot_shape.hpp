// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <variant>
#include <vector>

#include <Eigen/Core>

#include <vantage/geometry/triangle_mesh.hpp>

// What a robot's body is, in the frame of its views: the camera's pose is the robot's.
namespace vantage {

namespace shape {

/// Around the frame's origin; a radius of 0 is a point.
struct Sphere {
  double radius_m = 0;
};
/// Along the frame's axes, around its origin; flat in those where it has no extent.
struct Box {
  Eigen::Vector3d half_extents_m = Eigen::Vector3d::Zero();
};
/// The convex hull of points [m] that do not all lie in a plane.
struct Convex {
  std::vector<Eigen::Vector3d> points;
};
/// A surface. What it encloses is not part of it: a thing that lies inside without touching it is not met.
struct Mesh {
  TriangleMesh mesh;
};

}  // namespace shape

using RobotShape = std::variant<shape::Sphere, shape::Box, shape::Convex, shape::Mesh>;

}  // namespace vantage

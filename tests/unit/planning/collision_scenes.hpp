// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/geometry/convex_hull.hpp>
#include <vantage/geometry/triangle_mesh.hpp>
#include <vantage/planning/robot_shape.hpp>

namespace vantage::test {

inline Eigen::Isometry3d at(double x, double y, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, z)); }
inline void add_triangle(TriangleMesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c) {
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector3d& p : {a, b, c}) mesh.vertices.push_back(p.cast<float>());
  mesh.triangles.push_back({n, n + 1, n + 2});
}
/// The plane z = 0 from -10 to 10 m.
inline TriangleMesh ground() {
  TriangleMesh mesh;
  mesh.vertices = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}
inline std::vector<Eigen::Vector3d> corners_of(const Eigen::Vector3d& half) {
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back(half.cwiseProduct(Eigen::Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return corners;
}
inline TriangleMesh surface_of(const ConvexHull& hull) {
  TriangleMesh mesh;
  for (const Eigen::Vector3d& v : hull.vertices) mesh.vertices.push_back(v.cast<float>());
  mesh.triangles = hull.triangles;
  return mesh;
}
inline std::vector<RobotShape> shapes_of_half_a_metre() {
  const auto corners = corners_of(Eigen::Vector3d::Constant(0.5));
  return {shape::Sphere{0.5}, shape::Box{Eigen::Vector3d::Constant(0.5)}, shape::Convex{corners},
          shape::Mesh{surface_of(convex_hull(corners))}};
}

}  // namespace vantage::test

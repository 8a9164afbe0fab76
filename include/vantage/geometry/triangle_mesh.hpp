// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>

namespace vantage {

/// Triangles that share vertices; counter-clockwise as seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;  ///< world frame [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Eigen::Vector3f> colours;  ///< one a vertex, RGB in [0, 1]; or none

  [[nodiscard]] bool empty() const { return triangles.empty(); }
  [[nodiscard]] std::array<Eigen::Vector3d, 3> corners(std::size_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return {vertices[a].cast<double>(), vertices[b].cast<double>(), vertices[c].cast<double>()};
  }
  /// Twice the area [m^2] along the normal; zero for a degenerate triangle.
  [[nodiscard]] Eigen::Vector3d area_normal(std::size_t triangle) const {
    const auto [a, b, c] = corners(triangle);
    return (b - a).cross(c - a);
  }
  /// Of all vertices; empty if there is none.
  [[nodiscard]] Box3 bounds() const {
    Box3 box;
    for (const Eigen::Vector3f& v : vertices) box.extend(v.cast<double>());
    return box;
  }
  /// Throws Error naming the first vertex that is not finite, the first triangle whose vertex does not exist, the first
  /// vertex whose colour is not in [0, 1], or colours that are not one a vertex. O(vertices + triangles).
  void validate(std::string_view where) const {
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (!vertices[i].allFinite())
        throw Error(where, concat("vertex ", i, " is (", vertices[i].transpose(), ")"), "finite coordinates");
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (const std::uint32_t v : triangles[i])
        if (v >= vertices.size())
          throw Error(where, concat("triangle ", i, " uses vertex ", v), concat("below ", vertices.size()));
    if (!colours.empty() && colours.size() != vertices.size())
      throw Error(where, concat(colours.size(), " colours"),
                  concat("none, or one for each of ", vertices.size(), " vertices"));
    for (std::size_t i = 0; i < colours.size(); ++i)
      if (!(colours[i].array() >= 0).all() || !(colours[i].array() <= 1).all())  // also NaN
        throw Error(where, concat("vertex ", i, " has colour (", colours[i].transpose(), ")"), "in [0, 1]");
  }
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/geometry/triangle_mesh.hpp>

namespace vantage::test {

/// How a mesh hangs together, by its directed edges.
struct Topology {
  std::size_t edges = 0;      ///< without direction
  std::size_t open = 0;       ///< with a triangle on one side only
  std::size_t branching = 0;  ///< used twice in the same direction: more than two triangles, or a flipped one
  std::size_t unused = 0;     ///< vertices of no triangle
  std::ptrdiff_t euler = 0;   ///< vertices - edges + triangles

  [[nodiscard]] bool closed() const { return open == 0 && branching == 0 && unused == 0; }
};

inline Topology topology(const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> directed;
  std::vector<bool> used(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      directed.emplace_back(t[i], t[(i + 1) % 3]);
      used[t[i]] = true;
    }
  std::ranges::sort(directed);
  Topology found;
  for (std::size_t i = 1; i < directed.size(); ++i) found.branching += directed[i] == directed[i - 1];
  std::size_t paired = 0;
  for (const auto& [a, b] : directed) paired += std::ranges::binary_search(directed, std::pair(b, a));
  found.open = directed.size() - paired;
  found.edges = paired / 2 + found.open;
  found.unused = static_cast<std::size_t>(std::ranges::count(used, false));
  found.euler = static_cast<std::ptrdiff_t>(mesh.vertices.size()) - static_cast<std::ptrdiff_t>(found.edges) +
                static_cast<std::ptrdiff_t>(mesh.triangles.size());
  return found;
}

/// Enclosed by a closed mesh [m^3]; positive if its triangles are counter-clockwise as seen from outside.
inline double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

/// [m^2]
inline double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sum += mesh.area_normal(i).norm() / 2;
  return sum;
}

/// A closed sphere of rings x (2 rings) quads, its vertices on the true sphere.
inline TriangleMesh sphere_mesh(const Eigen::Vector3d& centre, double radius_m, int rings) {
  TriangleMesh mesh;
  const int sectors = 2 * rings;
  const auto at = [&](int ring, int sector) {
    const double polar = std::numbers::pi * ring / rings, turn = 2 * std::numbers::pi * sector / sectors;
    return Eigen::Vector3f((centre + radius_m * Eigen::Vector3d(std::sin(polar) * std::cos(turn),
                                                                std::sin(polar) * std::sin(turn), std::cos(polar)))
                               .cast<float>());
  };
  mesh.vertices.push_back(at(0, 0));
  for (int r = 1; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) mesh.vertices.push_back(at(r, s));
  mesh.vertices.push_back(at(rings, 0));
  const auto south = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto index = [&](int ring, int sector) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * sectors + sector % sectors);
  };
  for (int s = 0; s < sectors; ++s) {
    mesh.triangles.push_back({0, index(1, s), index(1, s + 1)});
    mesh.triangles.push_back({south, index(rings - 1, s + 1), index(rings - 1, s)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({index(r, s), index(r + 1, s), index(r + 1, s + 1)});
      mesh.triangles.push_back({index(r, s), index(r + 1, s + 1), index(r, s + 1)});
    }
  }
  return mesh;
}

/// A rectangle in the plane z = `z`, facing up.
inline TriangleMesh rectangle(double x0, double y0, double x1, double y1, double z) {
  TriangleMesh mesh;
  for (const auto& [x, y] : {std::pair{x0, y0}, std::pair{x1, y0}, std::pair{x1, y1}, std::pair{x0, y1}})
    mesh.vertices.push_back(Eigen::Vector3d(x, y, z).cast<float>());
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace vantage::test

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <vantage/geometry/triangle_mesh.hpp>

namespace vantage {

/// Which connected part of a mesh each triangle belongs to; triangles are connected where they share a vertex.
struct MeshComponents {
  std::vector<std::uint32_t> of_triangle;  ///< numbered from 0 in the order of their first triangles
  std::vector<std::size_t> triangles;      ///< how many each part has
};

/// Throws Error for a mesh that is not valid. O(vertices + triangles), nearly.
inline MeshComponents mesh_components(const TriangleMesh& mesh) {
  mesh.validate("mesh_components");
  // Disjoint sets of vertices, each a tree that points to its smallest vertex.
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles)
    for (const std::uint32_t other : {b, c}) {
      const std::uint32_t x = root(a), y = root(other);
      parent[std::max(x, y)] = std::min(x, y);
    }
  MeshComponents parts;
  parts.of_triangle.reserve(mesh.triangles.size());
  constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mesh.vertices.size(), unnumbered);
  for (const auto& triangle : mesh.triangles) {
    std::uint32_t& part = number[root(triangle[0])];
    if (part == unnumbered) {
      part = static_cast<std::uint32_t>(parts.triangles.size());
      parts.triangles.push_back(0);
    }
    ++parts.triangles[part];
    parts.of_triangle.push_back(part);
  }
  return parts;
}

/// The mesh without its connected parts of fewer than `least` triangles (50 in the evaluation of chapter 6), and
/// without the vertices that then belong to no triangle; what is left keeps its order. Throws Error for a mesh that is
/// not valid.
inline TriangleMesh without_small_components(const TriangleMesh& mesh, std::size_t least = 50) {
  const MeshComponents parts = mesh_components(mesh);
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> moved_to(mesh.vertices.size(), unused);
  TriangleMesh kept;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (parts.triangles[parts.of_triangle[i]] < least) continue;
    kept.triangles.push_back(mesh.triangles[i]);
    for (const std::uint32_t v : mesh.triangles[i]) moved_to[v] = 0;
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (moved_to[v] == unused) continue;
    moved_to[v] = static_cast<std::uint32_t>(kept.vertices.size());
    kept.vertices.push_back(mesh.vertices[v]);
    if (!mesh.colours.empty()) kept.colours.push_back(mesh.colours[v]);
  }
  for (auto& triangle : kept.triangles)
    for (std::uint32_t& v : triangle) v = moved_to[v];
  return kept;
}

}  // namespace vantage

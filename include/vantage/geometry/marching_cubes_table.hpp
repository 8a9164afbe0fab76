// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

// Which triangles cut a cube whose corners lie inside or outside: worked out by the compiler from the cube's topology.
//
// Corner c of the cell lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge e runs along axis e / 4 from the corner
// `edge_start[e]`. On each face the surface runs so that it cuts off every inside corner (or run of inside corners) by
// itself; two cells see the same corners of the face that they share, hence the same cut, and the surface is closed.
// The cuts of the six faces join to loops, and each loop is cut into a fan of triangles from a vertex whose diagonals
// all leave the faces (there always is one), so that no edge gets more than two triangles.
namespace vantage::marching {

/// The lower corner of each of the 12 edges: 0 to 3 along x, 4 to 7 along y, 8 to 11 along z.
inline constexpr std::array<std::uint8_t, 12> edge_start = [] {
  std::array<std::uint8_t, 12> start{};
  for (std::size_t axis = 0, e = 0; axis < 3; ++axis)
    for (std::size_t corner = 0; corner < 8; ++corner)
      if ((corner >> axis & 1) == 0) start[e++] = static_cast<std::uint8_t>(corner);
  return start;
}();

struct Triangulation {
  std::uint8_t triangles = 0;
  std::array<std::uint8_t, 15> edges{};  ///< three a triangle, counter-clockwise as seen from outside
};

namespace detail {

constexpr std::uint8_t edge_between(std::size_t a, std::size_t b) {
  const std::size_t axis = static_cast<std::size_t>(std::countr_zero(a ^ b));
  for (std::size_t e = 4 * axis; e < 4 * axis + 4; ++e)
    if (edge_start[e] == (a & b)) return static_cast<std::uint8_t>(e);
  return 0xFF;  // no edge joins them
}

/// The corners of a face, counter-clockwise as seen from outside of the cube.
constexpr std::array<std::size_t, 4> ring(std::size_t face) {
  const std::size_t axis = face / 2, upper = face % 2;
  const std::size_t u = std::size_t{1} << (axis + 1) % 3, v = std::size_t{1} << (axis + 2) % 3, base = upper << axis;
  if (upper) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

/// The two faces on which each edge lies, as bits.
inline constexpr std::array<std::uint8_t, 12> edge_faces = [] {
  std::array<std::uint8_t, 12> faces{};
  for (std::size_t e = 0; e < 12; ++e)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (axis != e / 4) faces[e] = static_cast<std::uint8_t>(faces[e] | 1 << (2 * axis + (edge_start[e] >> axis & 1)));
  return faces;
}();

constexpr Triangulation triangulate(std::size_t inside) {
  // Where the surface goes on, on the next face, from each edge that it cuts.
  std::array<std::uint8_t, 12> next{};
  next.fill(0xFF);
  for (std::size_t face = 0; face < 6; ++face) {
    const auto corner = ring(face);
    const auto is_inside = [&](std::size_t i) { return (inside >> corner[i % 4] & 1) != 0; };
    for (std::size_t i = 0; i < 4; ++i) {
      if (is_inside(i) || !is_inside(i + 1)) continue;  // the outline enters the inside between corners i and i + 1,
      std::size_t j = i + 1;
      while (is_inside(j + 1)) ++j;  // and leaves it between j and j + 1
      next[edge_between(corner[i], corner[(i + 1) % 4])] = edge_between(corner[j % 4], corner[(j + 1) % 4]);
    }
  }
  Triangulation result;
  std::array<bool, 12> done{};
  for (std::uint8_t first = 0; first < 12; ++first) {
    if (done[first] || next[first] == 0xFF) continue;
    std::array<std::uint8_t, 12> loop{};
    std::size_t n = 0;
    for (std::uint8_t e = first; !done[e]; e = next[e]) {
      done[e] = true;
      loop[n++] = e;
    }
    std::size_t apex = 0;
    const auto leaves_the_faces = [&] {
      for (std::size_t k = 2; k + 1 < n; ++k)
        if ((edge_faces[loop[apex]] & edge_faces[loop[(apex + k) % n]]) != 0) return false;
      return true;
    };
    while (!leaves_the_faces()) ++apex;  // past the end, this would not compile
    for (std::size_t k = 1; k + 1 < n; ++k) {
      std::uint8_t* corner = &result.edges[std::size_t{3} * result.triangles++];
      corner[0] = loop[apex];
      corner[1] = loop[(apex + k) % n];
      corner[2] = loop[(apex + k + 1) % n];
    }
  }
  return result;
}

}  // namespace detail

/// By which corners are inside: bit c for corner c.
inline constexpr std::array<Triangulation, 256> table = [] {
  std::array<Triangulation, 256> all{};
  for (std::size_t inside = 0; inside < 256; ++inside) all[inside] = detail::triangulate(inside);
  return all;
}();

}  // namespace vantage::marching

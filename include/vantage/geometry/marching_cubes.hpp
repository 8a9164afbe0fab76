// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/huge_pages.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/brick_volume.hpp>
#include <vantage/geometry/marching_cubes_table.hpp>
#include <vantage/geometry/triangle_mesh.hpp>

namespace vantage {

/// Where a volume's surface runs, and which side of it is solid.
struct IsoSurface {
  float level = 0;                                            ///< finite
  enum class Inside { below, above } inside = Inside::below;  ///< below: distances; above: densities, occupancies
};

namespace marching {

/// One bit a sample of a brick: bit x + 8 y of word z.
using Bits = std::array<std::uint64_t, 8>;

/// The bricks around one, itself at (0, 0, 0); -1 where there is none.
class Neighbours {
 public:
  template <BrickVolume V>
  Neighbours(const V& volume, std::size_t brick) {
    const Eigen::Vector3i corner = volume.corner(brick);
    std::ptrdiff_t* to = bricks_.data();
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) *to++ = volume.brick_at(corner + Eigen::Vector3i(x, y, z));
  }
  [[nodiscard]] std::ptrdiff_t operator()(int x, int y, int z) const {
    return bricks_[static_cast<std::size_t>(13 + x + 3 * y + 9 * z)];
  }

 private:
  std::array<std::ptrdiff_t, 27> bricks_;
};

/// Slice z of a brick's bits, moved: bit (x, y) is that of the sample (x + dx, y + dy, z + dz), which may lie in a
/// neighbour; 0 where there is none. dx, dy, dz in {-1, 0, 1}.
inline std::uint64_t moved(const std::vector<Bits>& bits, const Neighbours& near, int z, int dx, int dy, int dz) {
  constexpr std::uint64_t first_column = 0x0101010101010101, last_column = first_column << 7;
  const int bz = (z + dz) >> 3;
  const auto slice = static_cast<std::size_t>((z + dz) & 7);
  const auto of = [&](int bx, int by) {
    const std::ptrdiff_t b = near(bx, by, bz);
    return b < 0 ? std::uint64_t{0} : bits[static_cast<std::size_t>(b)][slice];
  };
  const auto along_x = [&](int by) {
    if (dx > 0) return (of(0, by) >> 1 & ~last_column) | (of(1, by) << 7 & last_column);
    if (dx < 0) return (of(0, by) << 1 & ~first_column) | (of(-1, by) >> 7 & first_column);
    return of(0, by);
  };
  if (dy > 0) return along_x(0) >> 8 | along_x(1) << 56;
  if (dy < 0) return along_x(0) << 8 | along_x(-1) >> 56;
  return along_x(0);
}

/// Eight truth values (bytes 0 or 1) as the bits of one byte, the first the lowest.
inline std::uint64_t packed(const std::uint8_t* truths) {
  std::uint64_t bytes = 0;
  for (int i = 0; i < 8; ++i) bytes |= static_cast<std::uint64_t>(truths[i]) << (8 * i);  // one load
  return bytes * 0x0102040810204080 >> 56;
}

/// What the surface cuts in one brick: the edges that begin at its samples carry its vertices, in the order of axis,
/// slice and bit, its cells carry its triangles.
struct Cut {
  std::size_t brick = 0;
  std::array<Bits, 3> edges{};                ///< along x, y, z
  std::array<std::uint16_t, 24> before{};     ///< vertices of the words before each
  std::uint32_t vertices = 0, triangles = 0;  ///< how many
  std::uint32_t first_vertex = 0;
  std::size_t first_triangle = 0;

  [[nodiscard]] std::uint32_t vertex(std::size_t axis, std::size_t z, unsigned bit) const {
    const std::uint64_t below = edges[axis][z] & ((std::uint64_t{1} << bit) - 1);
    return first_vertex + before[8 * axis + z] + static_cast<std::uint32_t>(std::popcount(below));
  }
};

/// f(bit) for the bits that are set, in ascending order.
template <class F>
void for_each_bit(std::uint64_t word, F&& f) {
  for (; word != 0; word &= word - 1) f(static_cast<unsigned>(std::countr_zero(word)));
}

/// The inside bits of a slice's cells' eight corners.
inline std::array<std::uint64_t, 8> corners(const std::vector<Bits>& inside, const Neighbours& near, int z) {
  std::array<std::uint64_t, 8> c{};
  for (int i = 0; i < 8; ++i) c[static_cast<std::size_t>(i)] = moved(inside, near, z, i & 1, i >> 1 & 1, i >> 2);
  return c;
}
inline const Triangulation& triangulation(const std::array<std::uint64_t, 8>& corners, unsigned cell) {
  std::size_t inside = 0;
  for (std::size_t c = 0; c < 8; ++c) inside |= (corners[c] >> cell & 1) << c;
  return table[inside];
}

/// The passes of marching_cubes, in this order.
template <BrickVolume V>
class Extraction {
 public:
  Extraction(const V& volume, const IsoSurface& surface) : volume_(volume), surface_(surface) {
    for (std::vector<Bits>* bits : {&known_, &inside_, &cells_}) {
      reserve_huge(*bits, volume.bricks());
      bits->resize(volume.bricks());
    }
  }

  TriangleMesh run() {
    over_bricks([&](std::size_t b) { classify(b); });
    over_bricks([&](std::size_t b) { find_cells(b); });
    list_cuts();
    parallel_for_blocks(cuts_.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) count(cuts_[i]);
    });
    place();
    parallel_for_blocks(cuts_.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        write_vertices(cuts_[i]);
        write_triangles(cuts_[i]);
      }
    });
    return std::move(mesh_);
  }

 private:
  template <class F>
  void over_bricks(F&& f) {
    parallel_for_blocks(known_.size(), 32, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) f(b);
    });
  }

  // Which samples are known, and which of them are inside.
  void classify(std::size_t brick) {
    alignas(64) std::array<float, brick_samples> value;
    alignas(64) std::array<std::uint8_t, brick_samples> known, inside;
    volume_.load(brick, value);
    const float level = surface_.level;
    for (std::size_t i = 0; i < brick_samples; ++i) known[i] = value[i] == value[i];
    if (surface_.inside == IsoSurface::Inside::below)
      for (std::size_t i = 0; i < brick_samples; ++i) inside[i] = value[i] < level;
    else
      for (std::size_t i = 0; i < brick_samples; ++i) inside[i] = value[i] > level;
    for (std::size_t z = 0; z < 8; ++z)
      for (std::size_t y = 0; y < 8; ++y) {
        known_[brick][z] |= packed(&known[64 * z + 8 * y]) << (8 * y);
        inside_[brick][z] |= packed(&inside[64 * z + 8 * y]) << (8 * y);
      }
  }

  // Which cells have eight known corners, not all of them on one side.
  void find_cells(std::size_t brick) {
    const Neighbours near(volume_, brick);
    for (int z = 0; z < 8; ++z) {
      std::uint64_t all_known = ~std::uint64_t{0}, any_inside = 0, all_inside = all_known;
      for (int c = 0; c < 8 && all_known != 0; ++c) {
        const int x = c & 1, y = c >> 1 & 1;
        const std::uint64_t inside = moved(inside_, near, z, x, y, c >> 2);
        all_known &= moved(known_, near, z, x, y, c >> 2);
        any_inside |= inside;
        all_inside &= inside;
      }
      cells_[brick][static_cast<std::size_t>(z)] = all_known & any_inside & ~all_inside;
    }
  }

  // A brick takes part if it has such a cell, or a neighbour below it has: that one may use its edges.
  void list_cuts() {
    std::vector<std::uint8_t> takes_part(cells_.size());
    over_bricks([&](std::size_t b) {
      const Neighbours near(volume_, b);
      std::uint64_t any = 0;
      for (int i = 0; i < 8; ++i)
        if (const std::ptrdiff_t n = near(-(i & 1), -(i >> 1 & 1), -(i >> 2)); n >= 0)
          for (const std::uint64_t word : cells_[static_cast<std::size_t>(n)]) any |= word;
      takes_part[b] = any != 0;
    });
    cut_of_.resize(cells_.size());
    reserve_huge(cuts_, static_cast<std::size_t>(std::ranges::count(takes_part, 1)));
    for (std::size_t b = 0; b < cells_.size(); ++b)
      if (takes_part[b]) {
        cut_of_[b] = static_cast<std::uint32_t>(cuts_.size());
        cuts_.push_back({.brick = b});
      }
  }

  // The cut edges that a cell around them uses, and the triangles of the brick's cells.
  void count(Cut& cut) {
    const Neighbours near(volume_, cut.brick);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3i d = Eigen::Vector3i::Unit(axis), u = Eigen::Vector3i::Unit((axis + 1) % 3),
                            v = Eigen::Vector3i::Unit((axis + 2) % 3), uv = u + v;
      const auto cells = [&](int z, const Eigen::Vector3i& by) {
        return moved(cells_, near, z, -by.x(), -by.y(), -by.z());
      };
      for (int z = 0; z < 8; ++z) {
        const auto word = static_cast<std::size_t>(8 * axis + z), slice = static_cast<std::size_t>(z);
        const std::uint64_t crossed = inside_[cut.brick][slice] ^ moved(inside_, near, z, d.x(), d.y(), d.z());
        const std::uint64_t used = cells_[cut.brick][slice] | cells(z, u) | cells(z, v) | cells(z, uv);
        cut.edges[static_cast<std::size_t>(axis)][slice] = crossed & used;
        cut.before[word] = static_cast<std::uint16_t>(cut.vertices);
        cut.vertices += static_cast<std::uint32_t>(std::popcount(crossed & used));
      }
    }
    for (int z = 0; z < 8; ++z) {
      const std::uint64_t cells = cells_[cut.brick][static_cast<std::size_t>(z)];
      if (cells == 0) continue;
      const auto corner = corners(inside_, near, z);
      for_each_bit(cells, [&](unsigned cell) { cut.triangles += triangulation(corner, cell).triangles; });
    }
  }

  void place() {
    std::size_t vertices = 0, triangles = 0;
    for (Cut& cut : cuts_) {
      cut.first_vertex = static_cast<std::uint32_t>(vertices);
      cut.first_triangle = triangles;
      vertices += cut.vertices;
      triangles += cut.triangles;
    }
    if (vertices > std::numeric_limits<std::uint32_t>::max())
      throw Error("marching_cubes", concat(vertices, " vertices"), "fewer than 2^32");
    const auto make = [](auto& items, std::size_t n) {
      reserve_huge(items, n);
      items.resize(n);
    };
    make(mesh_.vertices, vertices);
    make(mesh_.triangles, triangles);
    if constexpr (ColouredBrickVolume<V>)
      if (volume_.has_colour()) make(mesh_.colours, vertices);
  }

  void write_vertices(const Cut& cut) {
    const Neighbours near(volume_, cut.brick);
    const Eigen::Vector3i first = volume_.corner(cut.brick) * brick_edge;
    const Eigen::Vector3d origin = volume_.origin(), spacing = volume_.spacing_m();
    std::uint32_t to = cut.first_vertex;
    for (int axis = 0; axis < 3; ++axis)
      for (int z = 0; z < 8; ++z)
        for_each_bit(cut.edges[static_cast<std::size_t>(axis)][static_cast<std::size_t>(z)], [&](unsigned bit) {
          const Eigen::Vector3i at(static_cast<int>(bit & 7), static_cast<int>(bit >> 3), z);
          const Eigen::Vector3i end = at + Eigen::Vector3i::Unit(axis);
          const auto end_brick = static_cast<std::size_t>(near(end.x() >> 3, end.y() >> 3, end.z() >> 3));
          const std::size_t a = sample(at), b = sample(end);
          const float low = volume_.value(cut.brick, a), high = volume_.value(end_brick, b);
          const float t = (surface_.level - low) / (high - low);
          Eigen::Vector3d p = (first + at).cast<double>();
          p[axis] += static_cast<double>(t);
          mesh_.vertices[to] = (origin + spacing.cwiseProduct(p)).template cast<float>();
          if constexpr (ColouredBrickVolume<V>)
            if (!mesh_.colours.empty())
              mesh_.colours[to] = (1 - t) * Eigen::Vector3f(volume_.colour(cut.brick, a)) +
                                  t * Eigen::Vector3f(volume_.colour(end_brick, b));
          ++to;
        });
  }

  void write_triangles(const Cut& cut) {
    if (cut.triangles == 0) return;
    const Neighbours near(volume_, cut.brick);
    std::array<const Cut*, 8> owners{};  // of the edges: this brick and those above it, as far as they take part
    for (int i = 0; i < 8; ++i)
      if (const std::ptrdiff_t n = near(i & 1, i >> 1 & 1, i >> 2); n >= 0)
        owners[static_cast<std::size_t>(i)] = &cuts_[cut_of_[static_cast<std::size_t>(n)]];
    auto* to = mesh_.triangles.data() + cut.first_triangle;
    for (int z = 0; z < 8; ++z) {
      const std::uint64_t cells = cells_[cut.brick][static_cast<std::size_t>(z)];
      if (cells == 0) continue;
      const auto corner = corners(inside_, near, z);
      for_each_bit(cells, [&](unsigned cell) {
        const Triangulation& cut_cell = triangulation(corner, cell);
        const auto vertex = [&](std::uint8_t edge) {
          const unsigned start = edge_start[edge];
          const unsigned x = (cell & 7) + (start & 1), y = (cell >> 3) + (start >> 1 & 1),
                         slice = static_cast<unsigned>(z) + (start >> 2);
          const Cut& owner = *owners[x >> 3 | y >> 3 << 1 | slice >> 3 << 2];
          return owner.vertex(edge / 4, slice & 7, (x & 7) + 8 * (y & 7));
        };
        for (std::size_t i = 0; i < cut_cell.triangles; ++i, ++to)
          for (std::size_t k = 0; k < 3; ++k) (*to)[k] = vertex(cut_cell.edges[3 * i + k]);
      });
    }
  }

  static std::size_t sample(const Eigen::Vector3i& at) {
    return static_cast<std::size_t>((at.x() & 7) + 8 * ((at.y() & 7) + 8 * (at.z() & 7)));
  }

  const V& volume_;
  IsoSurface surface_;
  std::vector<Bits> known_, inside_, cells_;
  std::vector<std::uint32_t> cut_of_;
  std::vector<Cut> cuts_;
  TriangleMesh mesh_;
};

}  // namespace marching

/// The surface where a volume takes a value: marching cubes (Lorensen and Cline, SIGGRAPH 1987) with the table of
/// marching_cubes_table.hpp. Vertices lie on the grid's edges (linear interpolation) and are shared, so that the mesh
/// is closed except where a cell has an unknown corner; triangles are counter-clockwise as seen from the side that is
/// not inside. A sample exactly at the level counts as outside; the triangles around it may have no area. Two passes
/// over bits and one over what the surface cuts, concurrent, with an order that does not depend on the threads.
/// O(samples), about 0.4 bytes a sample besides the mesh. Throws Error for a level that is not finite, or 2^32 vertices
/// or more.
template <BrickVolume V>
TriangleMesh marching_cubes(const V& volume, const IsoSurface& surface = {}) {
  Check check("marching_cubes");
  check.finite("level", surface.level);
  check.done();
  return marching::Extraction<V>(volume, surface).run();
}

}  // namespace vantage

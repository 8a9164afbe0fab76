// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/map.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage {

/// Free and occupied space as the cubes of an octree of 16 levels, which is what an OctoMap file holds: 65536 voxels
/// along each axis of the world, half of them below 0; space in no leaf is unknown. A value type; const members run
/// concurrently.
class OccupancyOctree {
 public:
  static constexpr int levels = 16;
  /// Voxels below 0 along each axis.
  static constexpr int half = 1 << (levels - 1);

  /// A cube of 2^height voxels a side, of height 0 to 15.
  struct Leaf {
    std::uint64_t code;  ///< of its lowest voxel, a multiple of span()
    std::uint8_t height;
    Space space;  ///< free or occupied
    /// Voxels in it.
    [[nodiscard]] std::uint64_t span() const { return std::uint64_t{1} << 3 * height; }
    bool operator==(const Leaf&) const = default;
  };

  /// Leaves in rising order of their codes, voxels of `voxel_m` [m]. Throws Error for an edge that is not finite and
  /// > 0, and for leaves that are not as Leaf says, out of order, or overlap. O(leaves).
  OccupancyOctree(double voxel_m, std::vector<Leaf> leaves) : voxel_m_(voxel_m), leaves_(std::move(leaves)) {
    Check check("OccupancyOctree");
    check.positive("voxel_m", voxel_m);
    check.done();
    std::uint64_t free_from = 0;
    for (const Leaf& leaf : leaves_) {
      if (leaf.height >= levels || leaf.space == Space::unknown || leaf.code % leaf.span() != 0 ||
          leaf.code < free_from || leaf.code >> 3 * levels != 0)
        throw Error("OccupancyOctree", concat("a leaf of height ", int{leaf.height}, " at ", leaf.code),
                    "cubes of free or occupied voxels in rising order, none within another");
      free_from = leaf.code + leaf.span();
    }
  }

  /// What a map knows, eight equal cubes merged into one wherever they make one. A map's voxels that are explored but
  /// neither free nor occupied are unknown here. Throws Error unless the map's voxels are cubes with a corner at the
  /// world's origin (VoxelGrid::on_lattice), within 32768 of it. O(n log n) and 16 bytes for each of n known voxels.
  template <VoxelOccupancy M>
  static OccupancyOctree of(const M& map) {
    const VoxelGrid& grid = map.grid();
    const Eigen::Vector3i offset = offset_of(grid);
    std::vector<Leaf> leaves;
    for (const Eigen::Vector3i& block : map.known_blocks()) {
      const auto put = [&](const VoxelBits& bits, Space space) {
        bits.for_each([&](std::size_t local) {
          leaves.push_back({code_of(voxel_of(block, local) + offset), 0, space});
        });
      };
      put(map.free_in(block), Space::free);
      put(map.occupied_in(block), Space::occupied);
    }
    std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.code < b.code; });
    merge(leaves);
    return {grid.voxel_m().x(), std::move(leaves)};
  }

  [[nodiscard]] double voxel_m() const { return voxel_m_; }
  /// Depth first, the octants of a cube in the order x, y, z.
  [[nodiscard]] std::span<const Leaf> leaves() const { return leaves_; }
  [[nodiscard]] Box3 box_of(const Leaf& leaf) const {
    const Eigen::Vector3d low = voxel_m_ * world_voxel(leaf.code).cast<double>();
    return {low, low.array() + std::ldexp(voxel_m_, leaf.height)};
  }
  /// Unknown for what is in no leaf, beyond the tree, or not finite. O(log leaves).
  [[nodiscard]] Space at(const Eigen::Vector3d& p) const {
    const Eigen::Array3d voxel = (p.array() / voxel_m_).floor();
    if (!(voxel >= -half && voxel < half).all()) return Space::unknown;
    const std::uint64_t code = code_of(voxel.cast<int>().matrix());
    const auto next = std::upper_bound(leaves_.begin(), leaves_.end(), code,
                                       [](std::uint64_t c, const Leaf& leaf) { return c < leaf.code; });
    if (next == leaves_.begin()) return Space::unknown;
    const Leaf& leaf = *(next - 1);
    return code - leaf.code < leaf.span() ? leaf.space : Space::unknown;
  }
  /// The smallest box around all that is known; empty if nothing is. O(leaves).
  [[nodiscard]] Box3 bounds() const {
    Box3 box;
    for (const Leaf& leaf : leaves_) box.extend(box_of(leaf));
    return box;
  }
  /// The voxels of bounds(). Throws Error if nothing is known.
  [[nodiscard]] VoxelGrid grid() const { return VoxelGrid::on_lattice(bounds(), voxel_m_); }

  /// A voxel's place in the order of the tree: the bits of its indices (-32768 to 32767) interleaved, x lowest.
  static std::uint64_t code_of(const Eigen::Vector3i& voxel) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) code |= spread(static_cast<std::uint64_t>(voxel[axis] + half)) << axis;
    return code;
  }
  /// The voxel with a code: that from voxel * voxel_m() to one voxel further.
  static Eigen::Vector3i world_voxel(std::uint64_t code) {
    Eigen::Vector3i voxel;
    for (int axis = 0; axis < 3; ++axis) voxel[axis] = static_cast<int>(gather(code >> axis)) - half;
    return voxel;
  }
  bool operator==(const OccupancyOctree&) const = default;

 private:
  /// The world's voxel that is the grid's (0, 0, 0).
  static Eigen::Vector3i offset_of(const VoxelGrid& grid) {
    const Eigen::Array3d edge = grid.voxel_m().array(), low = (grid.origin().array() / edge).round();
    if ((edge != edge.x()).any() || !((grid.origin().array() / edge - low).abs() < 1e-6).all())
      throw Error("OccupancyOctree::of",
                  concat("voxels of (", edge.transpose(), ") m from (", grid.origin().transpose(), ")"),
                  "cubes with a corner at the world's origin, as VoxelGrid::on_lattice makes them");
    if (!(low >= -half && low + grid.size().array().cast<double>() <= half).all())
      throw Error("OccupancyOctree::of", concat("voxels up to ", grid.box().max().transpose(), " m"),
                  concat("at most ", half, " from the world's origin"));
    return low.cast<int>().matrix();
  }
  /// Leaves of height 0 in order: whenever the last eight are the octants of one cube and equal, they are that cube.
  static void merge(std::vector<Leaf>& leaves) {
    std::size_t n = 0;
    for (const Leaf leaf : leaves) {
      leaves[n++] = leaf;
      while (n >= 8) {
        const Leaf &first = leaves[n - 8], &last = leaves[n - 1];
        const std::uint64_t span = last.span();
        if (last.height == levels - 1 || first.code % (8 * span) != 0 || last.code != first.code + 7 * span) break;
        const auto like_last = [&](const Leaf& l) { return l.height == last.height && l.space == last.space; };
        if (!std::all_of(&first, &last, like_last)) break;
        n -= 7;
        ++leaves[n - 1].height;
      }
    }
    leaves.resize(n);
  }
  /// Bit i of 16 to bit 3 i, and back.
  static constexpr std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 16) & 0x1F'0000'FF00'00FF;
    x = (x | x << 8) & 0x100F'00F0'0F00'F00F;
    x = (x | x << 4) & 0x10C3'0C30'C30C'30C3;
    return (x | x << 2) & 0x1249'2492'4924'9249;
  }
  static constexpr std::uint64_t gather(std::uint64_t x) {
    std::uint64_t bits = 0;
    for (int i = 0; i < levels; ++i) bits |= (x >> 3 * i & 1) << i;
    return bits;
  }

  double voxel_m_;
  std::vector<Leaf> leaves_;
};

}  // namespace vantage

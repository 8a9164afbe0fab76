// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/voxel_bits.hpp>

namespace vantage {

/// A robot fits at a voxel's centre if the ball of its clearance lies in free voxels: unknown and occupied ones must
/// not reach into it, and it must not reach out of the grid. Touching a face (to a millionth of the clearance) is no
/// reaching. Safe: whatever the voxels do not know cannot be met.
struct BallInFreeVoxels {
  static constexpr bool beyond = true;  ///< voxels never seen, and what is beyond the grid, are in the way
  static VoxelBits in_the_way(const VoxelBits& free, const VoxelBits&) { return ~free; }
  /// Whether a voxel so many voxels away reaches into the ball.
  static bool reaches(const Eigen::Vector3d& offset, const Eigen::Vector3d& voxel_m, double clearance_m) {
    const Eigen::Array3d gap = (offset.array().abs() - 0.5).max(0) * voxel_m.array();
    return gap.matrix().norm() < clearance_m * (1 - 1e-6) || offset.isZero();
  }
};

/// A robot fits at the centre of a free voxel if no occupied voxel's centre is within its clearance; unknown space and
/// the grid's end are not in the way. The rule of the published code of ch. 6.
struct NoOccupiedCentreInBall {
  static constexpr bool beyond = false;
  static VoxelBits in_the_way(const VoxelBits&, const VoxelBits& occupied) { return occupied; }
  static bool reaches(const Eigen::Vector3d& offset, const Eigen::Vector3d& voxel_m, double clearance_m) {
    return offset.cwiseProduct(voxel_m).norm() <= clearance_m;
  }
};

/// Grows sets of voxels by the voxels that reach into a ball, a block at a time. Bits of an x-row with its surroundings
/// lie in one word; rows are grown along x first, once for each width that the ball has, then ORed over y and z, eight
/// rows at once. O(reach^3 / 8) words. Const members may run concurrently.
class Dilation {
 public:
  static constexpr int most_reach = 24;  ///< voxels: with it a row is 56 bits

  /// Throws Error if the ball reaches further than most_reach voxels.
  template <class Rule>
  Dilation(const Rule&, const Eigen::Vector3d& voxel_m, double clearance_m) {
    const double reach = std::ceil(clearance_m / voxel_m.minCoeff() + 1);
    if (!(reach <= most_reach + 1))
      throw Error("VoxelMap::Config",
                  concat("a clearance of ", clearance_m, " m in voxels of ", voxel_m.minCoeff(), " m"),
                  concat("at most ", most_reach, " voxels"));
    const int most = static_cast<int>(reach);
    int widest = 0;
    for (int z = -most; z <= most; ++z)
      for (int y = -most; y <= most; ++y) {
        int width = -1;
        while (width < most && Rule::reaches(Eigen::Vector3d(width + 1, y, z), voxel_m, clearance_m)) ++width;
        if (width < 0) continue;
        rows_.push_back({y, z, width});
        reach_ = std::max({reach_, std::abs(y), std::abs(z), width});
        widest = std::max(widest, width);
      }
    if (reach_ > most_reach)
      throw Error("VoxelMap::Config", concat("a clearance that reaches ", reach_, " voxels"),
                  concat("at most ", most_reach, " voxels"));
    std::ranges::sort(rows_, {}, &Row::width);
    widths_ = widest + 1;
  }

  /// How many blocks around a block matter.
  [[nodiscard]] int blocks() const { return (reach_ + block_edge - 1) / block_edge; }
  /// The bits of a block that something set reaches. bits(dx, dy, dz): those of the block so many further, up to
  /// blocks() each way.
  template <class Bits>
  [[nodiscard]] VoxelBits operator()(Bits&& bits) const {
    const int b = blocks(), n = block_edge + 2 * reach_;  // rows along y and z that matter
    const int skip = block_edge * b - reach_;             // of those there are
    std::array<std::array<std::uint64_t, 64>, 64> row;    // [z][y]
    for (int z = 0; z < n; ++z) std::fill_n(row[static_cast<std::size_t>(z)].begin(), n, std::uint64_t{0});
    bool some = false;
    for (int dz = -b; dz <= b; ++dz)
      for (int dy = -b; dy <= b; ++dy)
        for (int dx = -b; dx <= b; ++dx) {
          const VoxelBits block = bits(dx, dy, dz);
          if (!block.any()) continue;
          some = true;
          for (int z = 0; z < block_edge; ++z)
            for (int y = 0; y < block_edge; ++y) {
              const int at_z = block_edge * (dz + b) + z - skip, at_y = block_edge * (dy + b) + y - skip;
              if (at_z < 0 || at_z >= n || at_y < 0 || at_y >= n) continue;
              row[static_cast<std::size_t>(at_z)][static_cast<std::size_t>(at_y)] |=
                  (block.slice[static_cast<std::size_t>(z)] >> 8 * y & 0xFF) << block_edge * (dx + b);
            }
        }
    VoxelBits grown;
    if (!some) return grown;
    std::array<std::array<std::uint8_t, 64>, 64> middle;  // the eight bits of the block itself, grown along x
    std::array<std::array<std::uint64_t, 64>, 64> wide = row;
    std::size_t next = 0;
    for (int width = 0; width < widths_; ++width) {
      for (std::size_t z = 0; z < static_cast<std::size_t>(n); ++z)
        for (std::size_t y = 0; y < static_cast<std::size_t>(n); ++y) {
          wide[z][y] |= row[z][y] << width | row[z][y] >> width;
          middle[z][y] = static_cast<std::uint8_t>(wide[z][y] >> block_edge * b);
        }
      for (; next < rows_.size() && rows_[next].width == width; ++next)
        for (std::size_t z = 0; z < block_edge; ++z) {
          const int row_z = rows_[next].z + reach_, row_y = rows_[next].y + reach_;
          std::uint64_t eight;
          std::memcpy(&eight, &middle[z + static_cast<std::size_t>(row_z)][static_cast<std::size_t>(row_y)], 8);
          grown.slice[z] |= eight;
        }
    }
    return grown;
  }

 private:
  struct Row {
    int y, z, width;  ///< the ball holds |x| <= width there
  };
  std::vector<Row> rows_;
  int reach_ = 0, widths_ = 1;
};

}  // namespace vantage

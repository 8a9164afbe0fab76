// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage {

/// What a voxel map knows of 512 voxels; bits beyond the grid are 0.
struct VoxelBlock {
  VoxelBits explored, free, occupied;  ///< explored: hit or passed by a measurement
  VoxelBits frontier;                  ///< free, beside an unexplored voxel
  VoxelBits navigable;                 ///< free, and the robot fits
  alignas(64) std::array<float, 512> log_odds{};
};

/// Blocks of a grid, made when they are first needed, in slabs that never move: a reference to a block is good until
/// the store is loaded, assigned or destroyed. Finding one costs a load of the index (4 bytes for each block that the
/// grid has) and one of the slab's address. Const members may run concurrently.
template <class Block>
class VoxelBlocks {
 public:
  /// Throws Error for a grid whose index alone exceeds `max_bytes`.
  VoxelBlocks(const VoxelGrid& grid, std::size_t max_bytes) : max_bytes_(max_bytes) {
    size_ = (grid.size().array() + (block_edge - 1)) / block_edge;
    const double blocks = size_.cast<double>().prod();
    if (!(blocks < 0x1p31) || blocks * sizeof(std::int32_t) > static_cast<double>(max_bytes))
      throw Error("VoxelMap", concat("the box holds ", blocks, " blocks of 8^3 voxels"),
                  concat("fewer than 2^31, and 4 bytes for each in max_bytes = ", max_bytes));
    index_.assign(static_cast<std::size_t>(blocks), -1);
  }

  /// Blocks along x, y, z.
  [[nodiscard]] const Eigen::Vector3i& size() const { return size_; }
  [[nodiscard]] bool contains(const Eigen::Vector3i& block) const {
    return (block.array() >= 0).all() && (block.array() < size_.array()).all();
  }
  /// The slot of any block, also outside of the grid; -1: not made yet.
  [[nodiscard]] std::int32_t slot(const Eigen::Vector3i& block) const {
    return contains(block) ? index_[position(block)] : -1;
  }
  [[nodiscard]] const Block* find(const Eigen::Vector3i& block) const {
    const std::int32_t s = slot(block);
    return s < 0 ? nullptr : &(*this)[static_cast<std::size_t>(s)];
  }
  [[nodiscard]] const Block& operator[](std::size_t slot) const {
    return slabs_[slot / slab_blocks][slot % slab_blocks];
  }
  [[nodiscard]] Block& operator[](std::size_t slot) { return slabs_[slot / slab_blocks][slot % slab_blocks]; }
  /// Where the blocks lie, by slot: in the order in which they were made.
  [[nodiscard]] std::span<const Eigen::Vector3i> known() const { return known_; }
  [[nodiscard]] std::size_t count() const { return known_.size(); }
  /// Of the index and of all slabs.
  [[nodiscard]] std::size_t bytes() const {
    return index_.size() * sizeof(std::int32_t) + known_.capacity() * sizeof(Eigen::Vector3i) +
           slabs_.size() * slab_bytes;
  }

  /// Throws Error if `more` blocks take more than max_bytes.
  void check_room(std::size_t more) const {
    const std::size_t extra = new_slabs(more) * slab_bytes;
    if (extra > 0 && bytes() + extra > max_bytes_)
      throw Error("VoxelMap", concat(more, " blocks may need ", extra, " bytes besides the ", bytes(), " in use"),
                  concat("max_bytes = ", max_bytes_, " at most"));
  }
  /// Makes room for `more` blocks; throws as check_room does, nothing changed.
  void reserve(std::size_t more) {
    check_room(more);
    const std::size_t slabs = slabs_.size() + new_slabs(more);
    while (slabs_.size() < slabs) slabs_.emplace_back(slab_blocks);
  }
  /// Makes a block of the grid that is not there yet; after reserve.
  void make(const Eigen::Vector3i& block) {
    known_.push_back(block);
    index_[position(block)] = static_cast<std::int32_t>(count() - 1);
  }

 private:
  // 64, or as many as 16 MB hold of blocks that are large.
  static constexpr std::size_t slab_blocks =
      std::bit_floor(std::clamp<std::size_t>((std::size_t{16} << 20) / sizeof(Block), 1, 64));
  static constexpr std::size_t slab_bytes = slab_blocks * sizeof(Block);

  [[nodiscard]] std::size_t new_slabs(std::size_t more) const {
    return std::max((count() + more + slab_blocks - 1) / slab_blocks, slabs_.size()) - slabs_.size();
  }
  [[nodiscard]] std::size_t position(const Eigen::Vector3i& b) const {
    return (static_cast<std::size_t>(b.z()) * static_cast<std::size_t>(size_.y()) + static_cast<std::size_t>(b.y())) *
               static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(b.x());
  }
  Eigen::Vector3i size_;
  std::size_t max_bytes_;
  std::vector<std::int32_t> index_;
  std::vector<std::vector<Block>> slabs_;
  std::vector<Eigen::Vector3i> known_;
};

}  // namespace vantage

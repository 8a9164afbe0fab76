// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/map.hpp>

namespace vantage::test {

/// A NavigableMap that is what the test draws, slow and obvious: a voxel is navigable if all voxels whose centre is
/// within the clearance of its own are free. Voxels never drawn are unexplored. It learns nothing.
class DrawnVoxels : public archetype::Map {
 public:
  DrawnVoxels(const VoxelGrid& grid, double clearance_m)
      : grid_(grid), clearance_m_(clearance_m), state_(grid.count()), explored_(grid.count()) {}

  void draw(const Eigen::Vector3i& voxel, Space space) {
    state_[slot(voxel)] = space;
    explored_[slot(voxel)] = 1;
    const Eigen::Vector3i block = block_of(voxel);
    if (seen_.insert({block.x(), block.y(), block.z()}).second) blocks_.push_back(block);
  }
  /// draw(voxel, f(voxel)) everywhere.
  template <class F>
  DrawnVoxels& draw_all(F&& f) {
    for (int z = 0; z < grid_.size().z(); ++z)
      for (int y = 0; y < grid_.size().y(); ++y)
        for (int x = 0; x < grid_.size().x(); ++x) draw({x, y, z}, f(Eigen::Vector3i(x, y, z)));
    return *this;
  }

  [[nodiscard]] Box3 bounds() const { return grid_.box(); }
  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  [[nodiscard]] Space state(const Eigen::Vector3i& voxel) const { return state_[slot(voxel)]; }
  [[nodiscard]] bool explored(const Eigen::Vector3i& voxel) const { return explored_[slot(voxel)] != 0; }
  [[nodiscard]] Space at(const Eigen::Vector3d& p) const {
    const Eigen::Vector3i voxel = grid_.voxel_at(p);
    return grid_.contains(voxel) ? state(voxel) : Space::unknown;
  }
  [[nodiscard]] std::span<const Eigen::Vector3i> known_blocks() const { return blocks_; }
  [[nodiscard]] VoxelBits free_in(const Eigen::Vector3i& block) const {
    return where(block, [&](const Eigen::Vector3i& v) { return state(v) == Space::free; });
  }
  [[nodiscard]] VoxelBits occupied_in(const Eigen::Vector3i& block) const {
    return where(block, [&](const Eigen::Vector3i& v) { return state(v) == Space::occupied; });
  }
  [[nodiscard]] VoxelBits unexplored_in(const Eigen::Vector3i& block) const {
    return where(block, [&](const Eigen::Vector3i& v) { return !explored(v); });
  }
  [[nodiscard]] double clearance_m() const { return clearance_m_; }
  [[nodiscard]] bool navigable(const Eigen::Vector3i& voxel) const {
    if (!grid_.contains(voxel)) return false;
    const Eigen::Vector3i reach = (clearance_m_ / grid_.voxel_m().array()).ceil().cast<int>();
    for (int z = -reach.z(); z <= reach.z(); ++z)
      for (int y = -reach.y(); y <= reach.y(); ++y)
        for (int x = -reach.x(); x <= reach.x(); ++x) {
          const Eigen::Vector3i step(x, y, z);
          if (step.cast<double>().cwiseProduct(grid_.voxel_m()).norm() > clearance_m_) continue;
          if (!grid_.contains(voxel + step) || state(voxel + step) != Space::free) return false;
        }
    return true;
  }
  [[nodiscard]] VoxelBits navigable_in(const Eigen::Vector3i& block) const {
    return where(block, [&](const Eigen::Vector3i& v) { return navigable(v); });
  }

 protected:
  template <class F>
  [[nodiscard]] VoxelBits where(const Eigen::Vector3i& block, F&& f) const {
    VoxelBits bits;
    VoxelBits::inside(grid_, block).for_each([&](std::size_t local) {
      if (f(voxel_of(block, local))) bits.set(local);
    });
    return bits;
  }

 private:
  [[nodiscard]] std::size_t slot(const Eigen::Vector3i& v) const {
    return (static_cast<std::size_t>(v.z()) * static_cast<std::size_t>(grid_.size().y()) +
            static_cast<std::size_t>(v.y())) *
               static_cast<std::size_t>(grid_.size().x()) +
           static_cast<std::size_t>(v.x());
  }
  VoxelGrid grid_;
  double clearance_m_;
  std::vector<Space> state_;
  std::vector<std::uint8_t> explored_;
  std::vector<Eigen::Vector3i> blocks_;
  std::set<std::tuple<int, int, int>> seen_;
};

/// The same with its frontier: free voxels with an unexplored face neighbour, whose normal is the mean direction to
/// their free neighbours (of 26); those in whose middle it vanishes are left out.
class DrawnFrontiers : public DrawnVoxels {
 public:
  using DrawnVoxels::DrawnVoxels;

  [[nodiscard]] std::vector<Region> regions(frontier) const {
    std::vector<Region> found;
    for (int z = 0; z < grid().size().z(); ++z)
      for (int y = 0; y < grid().size().y(); ++y)
        for (int x = 0; x < grid().size().x(); ++x) {
          const Eigen::Vector3i voxel(x, y, z);
          if (state(voxel) != Space::free) continue;
          bool open = false;
          Eigen::Vector3d sum = Eigen::Vector3d::Zero();
          for (int k = 0; k < 27; ++k) {
            const Eigen::Vector3i step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1), next = voxel + step;
            if (step.isZero() || !grid().contains(next)) continue;
            open = open || (step.cwiseAbs().sum() == 1 && !explored(next));
            if (state(next) == Space::free) sum += step.cast<double>().cwiseProduct(grid().voxel_m()).normalized();
          }
          if (open && sum.norm() > 1e-9) found.push_back({grid().centre(voxel), sum.normalized()});
        }
    return found;
  }
};

}  // namespace vantage::test

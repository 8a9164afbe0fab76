// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <limits>
#include <optional>

#include <Eigen/Core>

#include <vantage/concepts/map.hpp>
#include <vantage/geometry/grid_ray.hpp>
#include <vantage/geometry/voxel_bits.hpp>

namespace vantage {

/// Casts rays into a voxel map, by bits: a block without the voxels that are looked for is left in one go, which ends
/// where steps would (GridRay). Works with every VoxelOccupancy; one whose block(b) points to what it knows of a block,
/// as VoxelMap's does, is read in place. Refers to the map; const members run concurrently.
template <VoxelOccupancy M>
class RayCaster {
 public:
  /// A voxel of the map's grid, entered at from + t direction.
  struct Hit {
    Eigen::Vector3i voxel;
    double t;
  };

  explicit RayCaster(const M& map) : map_(&map) {}
  explicit RayCaster(const M&&) = delete;

  /// The first occupied voxel on from + t direction for t in [0, most]; all else is looked through. `from` and
  /// `direction` are finite, direction is not 0. O(blocks + voxels of those with occupied ones), along the ray.
  [[nodiscard]] std::optional<Hit> first_occupied(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                                                  double most = std::numeric_limits<double>::infinity()) const {
    return first_occupied(GridRay(map_->grid(), from, direction, most));
  }
  /// The same for what is left of a ray through the map's grid.
  [[nodiscard]] std::optional<Hit> first_occupied(const GridRay& ray) const {
    return first<true>(ray, [this](const Eigen::Vector3i& block) -> decltype(auto) {
      if constexpr (in_place)
        return reference(block, [](const auto& b) -> const VoxelBits& { return b.occupied; });
      else
        return map_->occupied_in(block);
    });
  }
  /// The first voxel that is not free, unknown or occupied: where a robot that keeps to free space must stop.
  [[nodiscard]] std::optional<Hit> first_not_free(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                                                  double most = std::numeric_limits<double>::infinity()) const {
    const GridRay ray(map_->grid(), from, direction, most);
    return first<false>(ray, [this](const Eigen::Vector3i& block) -> decltype(auto) {
      if constexpr (in_place)
        return reference(block, [](const auto& b) -> const VoxelBits& { return b.free; });
      else
        return map_->free_in(block);
    });
  }

 private:
  static constexpr bool in_place = requires(const M& m, const Eigen::Vector3i& b) {
    m.block(b)->occupied;
    m.block(b)->free;
  };
  template <class Member>
  const VoxelBits& reference(const Eigen::Vector3i& block, Member&& member) const {
    static constexpr VoxelBits none{};
    const auto* known = map_->block(block);
    return known ? member(*known) : none;
  }
  /// The first voxel whose bit is `value`.
  template <bool value, class Bits>
  static std::optional<Hit> first(GridRay ray, Bits&& bits_of) {
    constexpr VoxelBits nothing = value ? VoxelBits{} : VoxelBits::all();
    while (ray) {
      const Eigen::Vector3i block = ray.block();
      const VoxelBits& bits = bits_of(block);
      if (bits == nothing) {
        ray.leave_block();
        continue;
      }
      do {
        if (bits[ray.local()] == value) return Hit{ray.voxel(), ray.enter()};
        ray.step();
      } while (ray && ray.block() == block);
    }
    return std::nullopt;
  }
  const M* map_;
};

}  // namespace vantage

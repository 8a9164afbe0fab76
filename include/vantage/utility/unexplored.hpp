// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/visible_voxels.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage {

/// The unexplored voxels of a map, by blocks: those that a VoxelOccupancy says; of any other OccupancyMap those voxels
/// of a grid dividing its bounds whose centre is unknown, asked for once. Refers to the map.
template <OccupancyMap M>
class UnexploredVoxels {
 public:
  /// `voxel_m`: edge [m] of the grid's voxels, for maps that have none of their own. Throws Error as
  /// VoxelGrid::dividing does. O(1) for a VoxelOccupancy, else O(voxels), with one bit each.
  UnexploredVoxels(const M& map, double voxel_m) : map_(&map), grid_(grid_of(map, voxel_m)) {
    if constexpr (!VoxelOccupancy<M>) {
      blocks_ = (grid_.size().array() + (block_edge - 1)) / block_edge;
      unknown_.resize(static_cast<std::size_t>(blocks_.x()) * static_cast<std::size_t>(blocks_.y()) *
                      static_cast<std::size_t>(blocks_.z()));
      parallel_for(static_cast<std::size_t>(blocks_.z()), [&](std::size_t z) {
        for (int y = 0; y < blocks_.y(); ++y)
          for (int x = 0; x < blocks_.x(); ++x) {
            const Eigen::Vector3i block(x, y, static_cast<int>(z));
            VoxelBits& bits = unknown_[slot(block)];
            VoxelBits::inside(grid_, block).for_each([&](std::size_t local) {
              if (map.at(grid_.centre(voxel_of(block, local))) == Space::unknown) bits.set(local);
            });
          }
      });
    }
  }
  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  /// Of a block of the grid.
  [[nodiscard]] VoxelBits in(const Eigen::Vector3i& block) const {
    if constexpr (VoxelOccupancy<M>)
      return map_->unexplored_in(block);
    else
      return unknown_[slot(block)];
  }

 private:
  static VoxelGrid grid_of(const M& map, double voxel_m) {
    if constexpr (VoxelOccupancy<M>)
      return map.grid();
    else
      return VoxelGrid::dividing(map.bounds(), voxel_m);
  }
  [[nodiscard]] std::size_t slot(const Eigen::Vector3i& b) const {
    return (static_cast<std::size_t>(b.z()) * static_cast<std::size_t>(blocks_.y()) + static_cast<std::size_t>(b.y())) *
               static_cast<std::size_t>(blocks_.x()) +
           static_cast<std::size_t>(b.x());
  }
  const M* map_;
  VoxelGrid grid_;
  Eigen::Vector3i blocks_ = Eigen::Vector3i::Zero();
  std::vector<VoxelBits> unknown_;
};

/// How much unexplored space a view would show, as the share of all voxels (ch. 6):
///
///     psi_V(v) = visible unexplored voxels / all voxels
///
/// A voxel is visible if its centre is in the image, in range, and nearer than the depth that the map renders there; a
/// pixel without depth sees as far as the range. Works with every map that renders depth and knows occupancy: the
/// voxels are those of the map if it has any, else of a grid over its bounds. Views already in the sequence have seen
/// what they see. In [0, 1]. Cost: one rendering a view (one a step of those given), and the
/// unexplored voxels in its frustum.
class Unexplored {
 public:
  using MapNeeds = Needs<need::Depth, need::Occupancy>;

  struct Config {
    Camera camera = Camera::from_fov(128, 128, deg(60));  ///< what is rendered
    double far_m = 5;                                     ///< range of the sensor, camera z; finite and > 0
    double voxel_m = 0.2;  ///< edge of a voxel, for maps that have none of their own; finite and > 0
  };

  Unexplored() : Unexplored(Config()) {}
  /// Throws Error naming every bad member.
  explicit Unexplored(const Config& config) : config_(config) {
    config.camera.validate();
    Check check("Unexplored::Config");
    check.positive("far_m", config.far_m);
    check.positive("voxel_m", config.voxel_m);
    check.done();
  }

  template <DepthMap M>
  requires OccupancyMap<M>
  auto prepare(const M& map, const Situation&, Rng) const {
    return [scene = std::make_shared<const Scene<M>>(config_, map)](Views given, Views views, std::span<double> out) {
      const auto count = scene->counts(given, views);
      for (std::size_t i = 0; i < views.size(); ++i)
        out[i] = static_cast<double>(count[i]) / static_cast<double>(scene->voxels.grid().count());
    };
  }
  /// Visible unexplored voxels from each of `views`, had those `given` been measured before.
  template <DepthMap M>
  requires OccupancyMap<M>
  [[nodiscard]] std::vector<std::uint64_t> count(const M& map, Views views, Views given = {}) const {
    return Scene<M>(config_, map).counts(given, views);
  }
  [[nodiscard]] const Config& config() const { return config_; }

 private:
  template <class M>
  struct Scene {
    Scene(const Config& c, const M& m) : config(c), map(&m), voxels(m, c.voxel_m) {}

    Config config;
    const M* map;
    UnexploredVoxels<M> voxels;

    [[nodiscard]] std::vector<std::uint64_t> counts(Views given, Views views) const {
      std::vector<std::shared_ptr<const VisibleVoxels>> before;
      for (const View& v : given) before.push_back(given_before(v));
      std::vector<std::uint64_t> count(views.size());
      parallel_for(views.size(), [&](std::size_t i) {
        const VisibleVoxels visible = seen_from(views[i]);
        visible.for_each_block([&](const Eigen::Vector3i& block) {
          VoxelBits bits = visible(block, voxels.in(block));
          for (const auto& b : before) bits &= ~(*b)(block, bits);
          count[i] += static_cast<std::uint64_t>(bits.count());
        });
      });
      return count;
    }

   private:
    [[nodiscard]] VisibleVoxels seen_from(const View& view) const {
      Rendering<channel::Depth> image;
      map->render(view, config.camera, image);
      return {voxels.grid(), view, config.camera, std::move(image.depth), config.far_m};
    }
    /// A view that sequences begin with is given again with each of them, but rendered once.
    [[nodiscard]] std::shared_ptr<const VisibleVoxels> given_before(const View& view) const {
      const auto find = [&] {
        const std::lock_guard lock(mutex_);
        const auto at = std::find_if(seen_.begin(), seen_.end(),
                                     [&](const auto& s) { return s.first.T_W_C.matrix() == view.T_W_C.matrix(); });
        return at == seen_.end() ? nullptr : at->second;
      };
      if (auto found = find()) return found;
      auto seen = std::make_shared<const VisibleVoxels>(seen_from(view));
      const std::lock_guard lock(mutex_);
      return seen_.emplace_back(view, std::move(seen)).second;
    }
    mutable std::mutex mutex_;
    mutable std::deque<std::pair<View, std::shared_ptr<const VisibleVoxels>>> seen_;
  };
  Config config_;
};

}  // namespace vantage

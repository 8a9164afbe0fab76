// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/maps/voxel/ray_caster.hpp>
#include <vantage/maps/voxel/voxel_blocks.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

namespace vantage {

/// A VoxelMap that also keeps from which sides its voxels were seen. A robot that has no frontier left knows all space
/// that it can, but not all surface: a table was seen from above only, what lies between two books from none of the
/// few directions that it can be seen from. A side is a voxel that is not free, from one of 24 directions (the octants,
/// each by its largest component: some 40 degrees across), and a view sees those that its pixels' rays meet first:
/// what is unknown hides what is behind it. After each frame its sides count as seen, of the map as it then is, with
/// every n-th ray so that none of its rows has more than 128.
///
/// Models SideMap besides what the VoxelMap does. Takes 4 bytes more a voxel of the blocks of which a side was seen;
/// max_bytes does not count them. A frame takes 16384 rays more. Threads as the VoxelMap.
template <class Voxels = VoxelMap<>>
class WithSides : public Voxels {
 public:
  using Config = typename Voxels::Config;
  explicit WithSides(const Config& config) : Voxels(config), seen_(Voxels::grid(), unlimited) {}

  void integrate(const Frame& frame) {
    Voxels::integrate(frame);
    see(frame);
  }
  void integrate(const Frame& frame, Rng&) { integrate(frame); }

  /// Throws Error unless view and camera are valid. Uses all threads. O(pixels * voxels on a ray).
  [[nodiscard]] std::vector<std::uint64_t> unseen_sides(const View& view, const Camera& camera, double far_m) const {
    std::vector<std::uint64_t> names;
    const Eigen::Matrix<std::uint64_t, 3, 1> size = Voxels::grid().size().template cast<std::uint64_t>();
    for (const Side& s : sides(view, camera, far_m)) {
      if (s.direction < 0 || (seen_from(s.voxel) >> s.direction & 1) != 0) continue;
      const Eigen::Matrix<std::uint64_t, 3, 1> v = s.voxel.template cast<std::uint64_t>();
      const std::uint64_t name =
          ((v.z() * size.y() + v.y()) * size.x() + v.x()) * directions + static_cast<std::uint64_t>(s.direction);
      if (names.empty() || names.back() != name) names.push_back(name);  // neighbours often see the same
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
  }
  /// From where a voxel was seen, a bit for each of the 24 directions; of any voxel, 0 outside of the grid.
  [[nodiscard]] std::uint32_t seen_from(const Eigen::Vector3i& voxel) const {
    const Block* block = seen_.find(block_of(voxel));
    return block ? block->from[local_of(voxel)] : 0;
  }
  [[nodiscard]] std::size_t bytes() const { return Voxels::bytes() + seen_.bytes(); }

  void save(Sink& sink) const {
    Voxels::save(sink);
    sink.put(static_cast<std::uint64_t>(seen_.count()));
    for (std::size_t s = 0; s < seen_.count(); ++s) {
      for (const int i : seen_.known()[s]) sink.put(static_cast<std::int32_t>(i));
      sink.put(std::span<const std::uint32_t>(seen_[s].from));
    }
  }
  /// As VoxelMap's.
  void load(Source& source) {
    WithSides loaded(Voxels::config());
    loaded.Voxels::load(source);
    std::vector<std::uint32_t> from;
    for (auto n = source.get<std::uint64_t>(); n > 0; --n) {
      Eigen::Vector3i at;
      for (int& i : at) i = source.get<std::int32_t>();
      if (!loaded.seen_.contains(at) || loaded.seen_.slot(at) >= 0)
        throw Error(source.where(), concat("sides of the block at (", at.transpose(), ")"),
                    "blocks of the grid, each once");
      source.get(from);
      if (from.size() != 512 || std::ranges::any_of(from, [](std::uint32_t f) { return f >> directions != 0; }))
        throw Error(source.where(), concat("sides of ", from.size(), " voxels, or of directions beyond ", directions),
                    "512, and directions below that");
      std::ranges::copy(from, loaded.make(at).from.begin());
    }
    *this = std::move(loaded);
  }

 private:
  static constexpr int directions = 24;
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
  struct Block {
    std::array<std::uint32_t, 512> from{};
  };
  struct Side {
    Eigen::Vector3i voxel = {};
    int direction = -1;  ///< none
  };

  static int direction_of(const Eigen::Vector3d& d) {
    Eigen::Index axis = 0;
    d.cwiseAbs().maxCoeff(&axis);
    const int octant = (d.x() > 0 ? 1 : 0) + (d.y() > 0 ? 2 : 0) + (d.z() > 0 ? 4 : 0);
    return 3 * octant + static_cast<int>(axis);
  }
  /// What each pixel sees.
  [[nodiscard]] std::vector<Side> sides(const View& view, const Camera& camera, double far_m) const {
    camera.validate();
    check_view(view, "WithSides");
    const RayCaster<WithSides> caster(*this);
    const Eigen::Vector3d eye = view.position();
    const auto width = static_cast<std::size_t>(camera.width);
    std::vector<Side> all(width * static_cast<std::size_t>(camera.height));
    parallel_for_blocks(all.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t row = i / width, column = i % width;
        const Eigen::Vector3d ray =
            view.T_W_C.linear() * camera.ray(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        if (const auto hit = caster.first_not_free(eye, ray, far_m)) all[i] = {hit->voxel, direction_of(-ray)};
      }
    });
    return all;
  }
  void see(const Frame& frame) {
    Camera c = frame.camera;
    const int n = (std::max(c.width, c.height) + 127) / 128;
    c = {.width = (c.width + n - 1) / n,
         .height = (c.height + n - 1) / n,
         .fx = c.fx / n,
         .fy = c.fy / n,
         .cx = c.cx / n,
         .cy = c.cy / n};
    for (const Side& s : sides(frame.view, c, Voxels::config().range.max_m)) {
      if (s.direction < 0) continue;
      const std::int32_t slot = seen_.slot(block_of(s.voxel));
      Block& block = slot < 0 ? make(block_of(s.voxel)) : seen_[static_cast<std::size_t>(slot)];
      block.from[local_of(s.voxel)] |= std::uint32_t{1} << s.direction;
    }
  }
  Block& make(const Eigen::Vector3i& at) {
    seen_.reserve(1);
    seen_.make(at);
    return seen_[seen_.count() - 1];
  }

  VoxelBlocks<Block> seen_;
};

}  // namespace vantage

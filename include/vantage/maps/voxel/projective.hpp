// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/maps/voxel/frame_voxels.hpp>
#include <vantage/maps/voxel/log_odds.hpp>

namespace vantage {

/// How the published code of ch. 6 updates its voxels, without rays: a voxel is hit if the point of a pixel falls in
/// it; any other is passed if its centre projects into the image and is nearer (camera z) than the depth there. Once a
/// frame each, its log-odds change by +-gain * max(0, 1 - falloff d), d the distance [m] from the camera to its centre.
/// Cheap, but it looks through what is thinner than a voxel's projection. O(pixels + voxels in view).
struct Projective {
  static constexpr std::string_view name = "Projective";

  double gain = 2.8;            ///< > 0
  double falloff_per_m = 0.1;   ///< >= 0
  double clamp = 4.5;           ///< log-odds stay within +-clamp; > 0
  double free_most = 0.2;       ///< free: probability up to this; in (0, 0.5)
  double occupied_least = 0.8;  ///< occupied: from this on; in (0.5, 1)

  void validate() const {
    Check check("Projective");
    check.positive("gain", gain);
    check.not_negative("falloff_per_m", falloff_per_m);
    check.positive("clamp", clamp);
    check(free_most > 0 && free_most < 0.5, "free_most", free_most, "in (0, 0.5)");
    check(occupied_least > 0.5 && occupied_least < 1, "occupied_least", occupied_least, "in (0.5, 1)");
    check.done();
  }
  static VoxelGrid grid(const Box3& box, double voxel_m) { return VoxelGrid::dividing(box, voxel_m); }

  /// Hits and passes of a frame.
  void mark(const VoxelGrid& grid, const Frame& frame, const DepthRange& range, FrameVoxels& voxels) const;
  /// Folds them into the log-odds of a block.
  void fold(const VoxelGrid& grid, const View& view, const Eigen::Vector3i& block, const VoxelBits& hit,
            const VoxelBits& pass, BlockLogOdds log_odds) const {
    const Eigen::Vector3f edge = grid.voxel_m().cast<float>(),
                          first = (grid.centre(block_edge * block) - view.position()).cast<float>();
    const auto falloff = static_cast<float>(falloff_per_m), most = static_cast<float>(clamp),
               change = static_cast<float>(gain);
    add_log_odds(hit, pass, change, change, -most, most, log_odds, [&](std::size_t i) {
      const auto n = static_cast<std::uint32_t>(i);
      const float x = first[0] + static_cast<float>(static_cast<std::int32_t>(n & 7)) * edge[0],
                  y = first[1] + static_cast<float>(static_cast<std::int32_t>(n >> 3 & 7)) * edge[1],
                  z = first[2] + static_cast<float>(static_cast<std::int32_t>(n >> 6)) * edge[2];
      const float weight = 1 - falloff * std::sqrt(x * x + y * y + z * z);
      return weight > 0 ? weight : 0;
    });
  }
  /// What a hit and a pass make of the log-odds of one voxel, its centre so far from the camera.
  struct OneVoxel {
    float gain, falloff_per_m, clamp;
    [[nodiscard]] float after_hit(float log_odds, float distance_m) const {
      return std::min(log_odds + change(distance_m), clamp);
    }
    [[nodiscard]] float after_pass(float log_odds, float distance_m) const {
      return std::max(log_odds - change(distance_m), -clamp);
    }
    [[nodiscard]] float change(float distance_m) const { return gain * std::max(0.0F, 1 - falloff_per_m * distance_m); }
  };
  [[nodiscard]] OneVoxel one_voxel() const {
    return {static_cast<float>(gain), static_cast<float>(falloff_per_m), static_cast<float>(clamp)};
  }
  [[nodiscard]] VoxelBits free(std::span<const float, 512> log_odds) const {
    const auto most = static_cast<float>(log_odds_of(free_most));
    return where_log_odds(log_odds, [=](float l) { return l <= most; });
  }
  [[nodiscard]] VoxelBits occupied(std::span<const float, 512> log_odds) const {
    const auto least = static_cast<float>(log_odds_of(occupied_least));
    return where_log_odds(log_odds, [=](float l) { return l >= least; });
  }
};

inline void Projective::mark(const VoxelGrid& grid, const Frame& frame, const DepthRange& range,
                             FrameVoxels& voxels) const {
  voxels.for_pixels<false>(grid, frame, range, [&](Eigen::Index, std::span<const std::int32_t> numbers) {
    FrameVoxels::for_new(numbers, [&](std::int32_t n) {
      if (n >= 0) FrameVoxels::mark(voxels.hits, n);
    });
  });

  const Camera& camera = frame.camera;
  const Eigen::Isometry3d T_C_W = frame.view.T_W_C.inverse();
  const Eigen::Matrix3f step = (T_C_W.linear() * grid.voxel_m().asDiagonal()).cast<float>();
  const auto max = static_cast<float>(range.max_m), none = static_cast<float>(range.no_return_m);
  const float* depth = frame.depth.data();
  // Where the 64 voxels of a slice lie, from the first of them.
  alignas(64) std::array<float, 64> off_x, off_y, off_z;
  for (std::size_t i = 0; i < 64; ++i) {
    const Eigen::Vector3f off = step * Eigen::Vector3f(static_cast<float>(i & 7), static_cast<float>(i >> 3), 0);
    off_x[i] = off.x(), off_y[i] = off.y(), off_z[i] = off.z();
  }
  parallel_for_blocks(voxels.count(), 8, [&](std::size_t begin, std::size_t end) {
    // Two loops over a slice, each simple enough to become vectors.
    const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy),
               cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy),
               width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
    const std::int32_t columns = camera.width;
    alignas(64) std::array<float, 64> z;
    alignas(64) std::array<std::int32_t, 64> pixel;
    for (std::size_t b = begin; b < end; ++b) {
      const Eigen::Vector3i block = voxels.block(b);
      const Eigen::Vector3f first = (T_C_W * grid.centre(block_edge * block)).cast<float>();
      VoxelBits pass;
      for (std::size_t k = 0; k < 8; ++k) {
        const Eigen::Vector3f at = first + static_cast<float>(k) * step.col(2);
        const float at_x = at.x(), at_y = at.y(), at_z = at.z();
        std::int32_t seen = 0;
        for (std::size_t i = 0; i < 64; ++i) {
          const float px = at_x + off_x[i], py = at_y + off_y[i], pz = at_z + off_z[i], inverse = 1 / pz;
          const float u = fx * px * inverse + cx, v = fy * py * inverse + cy;
          const bool in_view = (pz > 0) & (u >= 0) & (u < width) & (v >= 0) & (v < height);
          z[i] = pz;
          const auto column = static_cast<std::int32_t>(in_view ? u : 0),
                     row = static_cast<std::int32_t>(in_view ? v : 0);
          pixel[i] = in_view ? row * columns + column : -1;
          seen |= in_view;
        }
        if (!seen) continue;
        std::uint64_t word = 0;
        for (std::size_t i = 0; i < 64; ++i) {
          const std::int32_t p = pixel[i];
          const float d = depth[p < 0 ? 0 : p];
          const float valued = d == d ? d : none, far = d > max ? max : valued;
          word |= static_cast<std::uint64_t>((p >= 0) & (z[i] < far)) << i;
        }
        pass.slice[k] = word;
      }
      voxels.passes[b] = pass & VoxelBits::inside(grid, block) & ~voxels.hits[b];
    }
  });
}

}  // namespace vantage

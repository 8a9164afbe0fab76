// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/maps/voxel/frame_voxels.hpp>
#include <vantage/maps/voxel/log_odds.hpp>

namespace vantage {

/// OctoMap's update (Hornung et al., "OctoMap", Autonomous Robots 34, 2013), discretised: a voxel in which points of
/// the frame fall is hit, and one ray to its centre passes the voxels before it; a voxel that is hit is not passed. A
/// ray that ends without a hit (beyond the range, or out of the grid) passes its last voxel too. Occupied: a
/// probability of 0.5 or more, as OctoMap has it; free: less than that, once explored. O(pixels + distinct end voxels *
/// voxels to them).
struct RayCast {
  static constexpr std::string_view name = "RayCast";

  double hit = 0.85, miss = -0.4;    ///< changes of the log-odds; > 0, < 0
  double least = 0.12, most = 0.97;  ///< probabilities are clamped to this; 0 < least < 0.5 < most < 1

  void validate() const {
    Check check("RayCast");
    check.positive("hit", hit);
    check(std::isfinite(miss) && miss < 0, "miss", miss, "finite and < 0");
    check(least > 0 && least < 0.5, "least", least, "in (0, 0.5)");
    check(most > 0.5 && most < 1, "most", most, "in (0.5, 1)");
    check.done();
  }
  static VoxelGrid grid(const Box3& box, double voxel_m) { return VoxelGrid::on_lattice(box, voxel_m); }

  /// Hits and passes of a frame.
  void mark(const VoxelGrid& grid, const Frame& frame, const DepthRange& range, FrameVoxels& voxels) const;
  /// Folds them into the log-odds of a block.
  void fold(const VoxelGrid&, const View&, const Eigen::Vector3i&, const VoxelBits& hits, const VoxelBits& pass,
            BlockLogOdds log_odds) const {
    add_log_odds(hits, pass, static_cast<float>(hit), static_cast<float>(-miss), static_cast<float>(log_odds_of(least)),
                 static_cast<float>(log_odds_of(most)), log_odds, [](std::size_t) { return 1.0F; });
  }
  /// What a hit and a pass make of the log-odds of one voxel, however far.
  struct OneVoxel {
    float hit, miss, least, most;
    [[nodiscard]] float after_hit(float log_odds, float) const { return std::min(log_odds + hit, most); }
    [[nodiscard]] float after_pass(float log_odds, float) const { return std::max(log_odds + miss, least); }
  };
  [[nodiscard]] OneVoxel one_voxel() const {
    return {static_cast<float>(hit), static_cast<float>(miss), static_cast<float>(log_odds_of(least)),
            static_cast<float>(log_odds_of(most))};
  }
  [[nodiscard]] VoxelBits free(std::span<const float, 512> log_odds) const {
    return where_log_odds(log_odds, [](float l) { return l < 0; });
  }
  [[nodiscard]] VoxelBits occupied(std::span<const float, 512> log_odds) const {
    return where_log_odds(log_odds, [](float l) { return l >= 0; });
  }
};

/// Visits the voxels of a segment from its first to the one before its last (Amanatides and Woo, "A fast voxel
/// traversal algorithm", Eurographics 1987); what lies outside of [0, size) is skipped. In units of voxels. A GridRay
/// has no end but its length, and can leave blocks; a walk knows its last voxel, and has no branches.
class VoxelWalk {
 public:
  /// `to` in [0, size).
  VoxelWalk(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3i& size) {
    const Eigen::Array3d along = to - from;
    double enter = 0;  // share of the segment before the grid begins
    for (int a = 0; a < 3; ++a) {
      const double n = size[a];
      if (from[a] < 0) enter = std::max(enter, -from[a] / along[a]);
      if (from[a] >= n) enter = std::max(enter, (n - from[a]) / along[a]);
    }
    steps_ = 0;
    for (int a = 0; a < 3; ++a) {
      const auto i = static_cast<std::size_t>(a);
      cell_[i] = std::clamp(static_cast<int>(std::floor(from[a] + enter * along[a])), 0, size[a] - 1);
      end_[i] = static_cast<int>(to[a]);
      step_[i] = end_[i] > cell_[i] ? 1 : -1;
      delta_[i] = 1 / std::abs(along[a]);
      next_[i] = end_[i] == cell_[i] ? never : ((step_[i] > 0 ? cell_[i] + 1 : cell_[i]) - from[a]) / along[a];
      steps_ += std::abs(end_[i] - cell_[i]);
    }
  }
  /// visit(x, y, z)
  template <class F>
  void operator()(F&& visit) const {
    // Which axis is next cannot be foretold, so there is no branch on it. Each is done when it is at its end: a walk
    // has as many steps as that takes, whatever rounding does.
    auto [x, y, z] = cell_;
    auto [next_x, next_y, next_z] = next_;
    const auto [end_x, end_y, end_z] = end_;
    const auto [step_x, step_y, step_z] = step_;
    const auto [delta_x, delta_y, delta_z] = delta_;
    for (int n = steps_; n > 0; --n) {
      visit(x, y, z);
      const bool is_x = (next_x < next_y) & (next_x < next_z), is_y = !is_x & (next_y < next_z), is_z = !is_x & !is_y;
      x += is_x ? step_x : 0;
      y += is_y ? step_y : 0;
      z += is_z ? step_z : 0;
      next_x += is_x ? delta_x : 0;
      next_y += is_y ? delta_y : 0;
      next_z += is_z ? delta_z : 0;
      next_x = x == end_x ? never : next_x;
      next_y = y == end_y ? never : next_y;
      next_z = z == end_z ? never : next_z;
    }
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  std::array<int, 3> cell_, end_, step_;
  std::array<double, 3> next_, delta_;
  int steps_;
};

inline void RayCast::mark(const VoxelGrid& grid, const Frame& frame, const DepthRange& range,
                          FrameVoxels& voxels) const {
  voxels.for_pixels<true>(grid, frame, range, [&](Eigen::Index, std::span<const std::int32_t> numbers) {
    FrameVoxels::for_new(numbers, [&](std::int32_t n) {
      if (n >= 0)
        FrameVoxels::mark(voxels.hits, n);
      else
        FrameVoxels::mark(voxels.ends, -2 - n);
    });
  });

  const Eigen::Vector3d eye =
      (frame.view.position() - grid.origin()).cwiseQuotient(grid.voxel_m()) - voxels.first_voxel().cast<double>();
  const Eigen::Vector3i size = voxels.voxels().cwiseMin(grid.size() - voxels.first_voxel());
  const std::int32_t *along_x = voxels.offset(0), *along_y = voxels.offset(1), *along_z = voxels.offset(2);
  parallel_for_blocks(voxels.count(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const Eigen::Vector3i first = block_edge * voxels.block(b) - voxels.first_voxel();
      (voxels.hits[b] | voxels.ends[b]).for_each([&](std::size_t local) {
        const Eigen::Vector3d to =
            (first + voxel_of(Eigen::Vector3i::Zero(), local)).cast<double>() + Eigen::Vector3d::Constant(0.5);
        VoxelWalk(eye, to, size)(
            [&](int x, int y, int z) { FrameVoxels::mark(voxels.passes, along_x[x] + along_y[y] + along_z[z]); });
      });
    }
  });
  for (std::size_t b = 0; b < voxels.count(); ++b)
    voxels.passes[b] = (voxels.passes[b] | voxels.ends[b]) & ~voxels.hits[b];
}

}  // namespace vantage

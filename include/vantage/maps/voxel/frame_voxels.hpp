// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage {

/// How far depth is believed, camera z [m].
struct DepthRange {
  double max_m =
      std::numeric_limits<double>::infinity();  ///< > 0; a larger depth clears space up to here, hits nothing
  double no_return_m = 0;  ///< >= 0: how far a pixel without a value clears space; 0: it says nothing

  void validate() const {
    Check check("DepthRange");
    check(max_m > 0, "max_m", max_m, "> 0");
    check.not_negative("no_return_m", no_return_m);
    check.done();
  }
};

/// Which voxels one frame hits and passes: bits of the blocks around what its camera sees. Bits are set with atomic
/// OR, so they depend on no order of threads. Memory is kept from frame to frame.
class FrameVoxels {
 public:
  static constexpr std::int32_t nowhere = -1;
  static constexpr std::size_t most_blocks = (std::size_t{1} << 22) - 1;  // so that a number fits 31 bits

  /// Blocks of the grid around all that a frame can tell of: first + [0, size).
  struct Region {
    Eigen::Vector3i first = Eigen::Vector3i::Zero(), size = Eigen::Vector3i::Zero();
  };
  /// Throws Error if a depth is bad, or if the blocks are too many.
  static Region around(const VoxelGrid& grid, const Frame& frame, const DepthRange& range);

  /// Forgets the last frame; the next one lies within the region.
  void reset(const Region& region) {
    region_ = region;
    const Eigen::Vector3i& size = region.size;
    const auto n =
        static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()) * static_cast<std::size_t>(size.z());
    for (std::vector<VoxelBits>* bits : {&hits, &ends, &passes}) bits->assign(n, VoxelBits{});
    for (int a = 0; a < 3; ++a) {
      auto& offset = offset_[static_cast<std::size_t>(a)];
      const int below = a == 0 ? 1 : a == 1 ? size.x() : size.x() * size.y();
      const int length = block_edge * size[a];
      offset.resize(static_cast<std::size_t>(length));
      for (int i = 0; i < length; ++i)
        offset[static_cast<std::size_t>(i)] = (i >> 3) * below * 512 + ((i & 7) << 3 * a);
    }
  }

  [[nodiscard]] std::size_t count() const { return hits.size(); }
  [[nodiscard]] Eigen::Vector3i block(std::size_t i) const {
    const auto n = static_cast<int>(i);
    const Eigen::Vector3i& size = region_.size;
    return region_.first + Eigen::Vector3i(n % size.x(), n / size.x() % size.y(), n / size.x() / size.y());
  }
  /// The first voxel of the blocks, and how many there are along each axis.
  [[nodiscard]] Eigen::Vector3i first_voxel() const { return block_edge * region_.first; }
  [[nodiscard]] Eigen::Vector3i voxels() const { return block_edge * region_.size; }
  /// Number of a voxel: its block's * 512 + where it is in there. It is a sum of one part an axis, by the distance from
  /// first_voxel().
  [[nodiscard]] const std::int32_t* offset(int axis) const { return offset_[static_cast<std::size_t>(axis)].data(); }

  /// Sets a bit; says whether it was new.
  static bool mark(std::vector<VoxelBits>& bits, std::int32_t number) {
    const auto n = static_cast<std::size_t>(number);
    const std::atomic_ref<std::uint64_t> word(bits[n >> 9].slice[n >> 6 & 7]);
    const std::uint64_t bit = std::uint64_t{1} << (n & 63);
    if (word.load(std::memory_order_relaxed) & bit) return false;  // most are set already, and a read costs little
    return !(word.fetch_or(bit, std::memory_order_relaxed) & bit);
  }

  /// f(number) for some of `numbers` that are no `nowhere`, each at least once. Noise makes neighbours jump between two
  /// voxels: those two are not repeated.
  template <class F>
  static void for_new(std::span<const std::int32_t> numbers, F&& f) {
    std::int32_t last = nowhere, before = nowhere;
    for (const std::int32_t n : numbers) {
      if ((n == last) | (n == before) | (n == nowhere)) continue;
      before = std::exchange(last, n);
      f(n);
    }
  }

  /// f(first pixel, numbers of the voxels) for pieces of rows, concurrently: the voxel that a pixel's point lies in, or
  /// `nowhere`; -2 - number if the ray ends there without a hit: it goes on beyond the range or (`clip`) the grid, and
  /// this is the last voxel.
  template <bool clip, class F>
  void for_pixels(const VoxelGrid& grid, const Frame& frame, const DepthRange& range, F&& f) const;

  std::vector<VoxelBits> hits, ends, passes;  ///< ends: where rays end that hit nothing

 private:
  static constexpr Eigen::Index piece = 64;
  struct Line;
  Region region_;
  std::array<std::vector<std::int32_t>, 3> offset_;
};

inline FrameVoxels::Region FrameVoxels::around(const VoxelGrid& grid, const Frame& frame, const DepthRange& range) {
  // Positive floats are ordered as their bits are, and integers become vectors.
  constexpr std::int32_t infinite = 0x7F800000;
  const float* depth = frame.depth.data();
  std::int32_t farthest = 0, bad = 0, missing = 0;
  for (Eigen::Index i = 0; i < frame.depth.size(); ++i) {
    const auto bits = std::bit_cast<std::int32_t>(depth[i]);
    const bool value = (bits > 0) & (bits < infinite), none = (bits & 0x7FFFFFFF) > infinite;
    bad |= !(value | none);
    missing |= none;
    const std::int32_t valued = value ? bits : 0;
    farthest = valued > farthest ? valued : farthest;
  }
  if (bad) frame.validate("VoxelMap::integrate");  // says where
  double far = std::min<double>(std::bit_cast<float>(farthest), range.max_m);
  if (missing) far = std::max(far, range.no_return_m);

  const auto scaled = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return (p - grid.origin()).cwiseQuotient(grid.voxel_m());
  };
  Box3 seen(scaled(frame.view.position()));
  for (const double u : {0.0, 1.0 * frame.camera.width})
    for (const double v : {0.0, 1.0 * frame.camera.height})
      seen.extend(scaled(frame.view.T_W_C * Eigen::Vector3d(far * frame.camera.ray(u, v))));
  // A voxel more on each side than needed: pixels are computed in single precision.
  const Eigen::Array3d low = (seen.min().array() - 1).max(0),
                       high = (seen.max().array() + 1).min(grid.size().cast<double>().array() - 1);
  Region region;
  if (!(far > 0) || !(low <= high).all()) return region;
  region.first = block_of(low.cast<int>());
  region.size = block_of(high.cast<int>()) - region.first + Eigen::Vector3i::Ones();
  if (const double blocks = region.size.cast<double>().prod(); blocks > static_cast<double>(most_blocks))
    throw Error("VoxelMap::integrate", concat("the frame spans ", blocks, " blocks of 8^3 voxels"),
                concat(most_blocks, " at most: a smaller DepthRange::max_m or larger voxels"));
  return region;
}

/// Pixels of a row, in plain floats so that the loop over them becomes vectors.
struct FrameVoxels::Line {
  float eye_x, eye_y, eye_z, right_x, right_y, right_z;  ///< the camera, and from a pixel's ray to the next
  float high_x, high_y, high_z, max, none;
  std::int32_t stride_y, stride_z;

  [[nodiscard]] float far(float depth) const {
    const float valued = depth == depth ? depth : none;
    return depth > max ? max : valued;
  }
  [[nodiscard]] std::int32_t number(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return (x >> 3) * 512 + (y >> 3) * stride_y + (z >> 3) * stride_z + ((x & 7) | (y & 7) << 3 | (z & 7) << 6);
  }
  void numbers(const Eigen::Vector3f& left, const float* depth, std::size_t n, std::int32_t* out) const {
    const Line l = *this;
    const float left_x = left.x(), left_y = left.y(), left_z = left.z();
    const auto count = static_cast<std::int32_t>(n);
    for (std::int32_t i = 0; i < count; ++i) {
      const float k = static_cast<float>(i), d = depth[i], z = l.far(d);
      const float x = l.eye_x + z * (left_x + k * l.right_x), y = l.eye_y + z * (left_y + k * l.right_y),
                  w = l.eye_z + z * (left_z + k * l.right_z);
      const bool in = (x >= 0) & (x < l.high_x) & (y >= 0) & (y < l.high_y) & (w >= 0) & (w < l.high_z) & (z > 0);
      const std::int32_t at = l.number(static_cast<std::int32_t>(in ? x : 0), static_cast<std::int32_t>(in ? y : 0),
                                       static_cast<std::int32_t>(in ? w : 0));
      const std::int32_t ended = d <= l.max ? at : -2 - at;
      out[i] = in ? ended : nowhere;
    }
  }
  /// Where the ray of a pixel leaves the grid before its depth.
  [[nodiscard]] std::int32_t leaving(const Eigen::Vector3f& ray, float depth) const {
    constexpr float inside = 0.01F;  // the part of a voxel by which it ends before that
    const Eigen::Array3f eye(eye_x, eye_y, eye_z), high(high_x, high_y, high_z);
    float z = far(depth);
    for (int a = 0; a < 3; ++a)
      if (ray[a] != 0) z = std::min(z, ((ray[a] > 0 ? high[a] - inside : inside) - eye[a]) / ray[a]);
    const Eigen::Array3f at = eye + z * ray.array();
    if (!(z > 0) || !(at >= 0).all() || !(at < high).all()) return nowhere;
    const Eigen::Array3i voxel = at.cast<std::int32_t>();
    return -2 - number(voxel[0], voxel[1], voxel[2]);
  }
};

template <bool clip, class F>
void FrameVoxels::for_pixels(const VoxelGrid& grid, const Frame& frame, const DepthRange& range, F&& f) const {
  if (count() == 0) return;
  const Camera& camera = frame.camera;
  // In voxels from the first one of the blocks.
  const Eigen::Vector3d& edge = grid.voxel_m();
  const Eigen::Matrix3d axes = edge.cwiseInverse().asDiagonal() * frame.view.T_W_C.linear();
  const Eigen::Vector3d from = grid.origin() + edge.cwiseProduct(first_voxel().cast<double>());
  const Eigen::Vector3f eye = (frame.view.position() - from).cwiseQuotient(edge).cast<float>();
  const Eigen::Vector3f right = (axes.col(0) / camera.fx).cast<float>();
  const Eigen::Vector3f high = (grid.size() - first_voxel()).cwiseMin(voxels()).cast<float>();
  const std::int32_t stride_y = region_.size.x() * 512;
  const Line line{eye.x(),
                  eye.y(),
                  eye.z(),
                  right.x(),
                  right.y(),
                  right.z(),
                  high.x(),
                  high.y(),
                  high.z(),
                  static_cast<float>(range.max_m),
                  static_cast<float>(range.no_return_m),
                  stride_y,
                  region_.size.y() * stride_y};
  parallel_for_blocks(static_cast<std::size_t>(camera.height), 16, [&](std::size_t begin, std::size_t end) {
    std::array<std::int32_t, piece> number;
    for (std::size_t row = begin; row < end; ++row) {
      const Eigen::Vector3f left =
          (axes * camera.ray(0.5, static_cast<double>(row) + 0.5)).cast<float>();  // of the row's first pixel
      for (Eigen::Index u0 = 0; u0 < camera.width; u0 += piece) {
        const Eigen::Index first = static_cast<Eigen::Index>(row) * camera.width + u0;
        const auto n = static_cast<std::size_t>(std::min(piece, camera.width - u0));
        const float* depth = frame.depth.data() + first;
        const Eigen::Vector3f start = left + static_cast<float>(u0) * right;
        line.numbers(start, depth, n, number.data());
        if constexpr (clip)
          for (std::size_t i = 0; i < n; ++i)
            if (number[i] == nowhere && line.far(depth[i]) > 0)
              number[i] = line.leaving(start + static_cast<float>(i) * right, depth[i]);
        f(first, std::span<const std::int32_t>(number.data(), n));
      }
    }
  });
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage {

/// The voxels of a grid that a ray meets, one after the other (Amanatides and Woo, "A fast voxel traversal algorithm
/// for ray tracing", Eurographics 1987):
///
///     for (GridRay ray(grid, from, direction); ray; ray.step()) use(ray.voxel(), ray.enter());
///
/// Where the ray crosses a border is computed from the border and not summed up, so that long rays stay exact and
/// leave_block() ends in the very voxel that steps lead to. Where it crosses several borders at once it crosses them in
/// the order x, y, z. A value type.
class GridRay {
 public:
  /// From the finite point `from` along `direction` (finite, not 0), over from + t direction for t in [0, most]. A ray
  /// that misses the grid is over at once.
  GridRay(const VoxelGrid& grid, const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
          double most = std::numeric_limits<double>::infinity())
      : most_(most) {
    constexpr double infinity = std::numeric_limits<double>::infinity(), parallel = 1e-200;  // its inverse is a number
    const Eigen::Array3d edge = grid.voxel_m().array(), origin = (from - grid.origin()).array() / edge,
                         slope = direction.array() / edge;
    double first = 0, last = most;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      origin_[a] = origin[axis];
      slope_[a] = slope[axis];
      size_[a] = grid.size()[axis];
      step_[a] = slope[axis] > parallel ? 1 : slope[axis] < -parallel ? -1 : 0;
      inverse_[a] = step_[a] == 0 ? 0 : 1 / slope[axis];
      if (step_[a] == 0) {
        if (!(origin_[a] >= 0 && origin_[a] < size_[a])) last = -1;
        continue;
      }
      const double low = at(a, 0), high = at(a, size_[a]);
      first = std::max(first, std::min(low, high));
      last = std::min(last, std::max(low, high));
    }
    going_ = first <= last;
    if (!going_) return;
    enter_ = first;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      const double start = origin_[a] + (step_[a] == 0 ? 0 : slope[axis] * first);
      voxel_[a] = static_cast<int>(std::clamp(std::floor(start), 0.0, size_[a] - 1.0));
      // The borders behind are those that have been crossed, to the last bit.
      const auto crossed = [&](int v) { return at(a, border(a, v)) <= first; };
      if (step_[a] != 0) {
        while (inside(a, voxel_[a] + step_[a]) && crossed(voxel_[a])) voxel_[a] += step_[a];
        while (inside(a, voxel_[a] - step_[a]) && !crossed(voxel_[a] - step_[a])) voxel_[a] -= step_[a];
      }
      next_[a] = step_[a] == 0 ? infinity : at(a, border(a, voxel_[a]));
    }
  }

  /// Whether there is a voxel (yet).
  explicit operator bool() const { return going_; }
  [[nodiscard]] Eigen::Vector3i voxel() const { return {voxel_[0], voxel_[1], voxel_[2]}; }
  [[nodiscard]] Eigen::Vector3i block() const { return {voxel_[0] >> 3, voxel_[1] >> 3, voxel_[2] >> 3}; }
  /// Where in its block the voxel is: local_of(voxel()).
  [[nodiscard]] std::size_t local() const {
    return static_cast<std::size_t>((voxel_[0] & 7) | (voxel_[1] & 7) << 3 | (voxel_[2] & 7) << 6);
  }
  /// t at which the ray enters and leaves the voxel; it enters that of its start at 0.
  [[nodiscard]] double enter() const { return enter_; }
  [[nodiscard]] double leave() const { return std::min({next_[0], next_[1], next_[2]}); }

  /// On to the next voxel.
  void step() { cross(first_of(next_)); }
  /// On to the first voxel of another block, as steps would lead there.
  void leave_block() {
    std::array<double, 3> leave;
    for (std::size_t a = 0; a < 3; ++a) leave[a] = step_[a] == 0 ? next_[a] : at(a, border(a, last_of_block(a)));
    const std::size_t out = first_of(leave);
    for (std::size_t a = 0; a < 3; ++a) {
      if (a == out || step_[a] == 0) continue;
      // Past all borders that the ray crosses before, and those at the same t whose turn comes earlier: a guess, and
      // what is wrong with it.
      const auto crossed = [&](int v) {
        const double t = at(a, border(a, v));
        return t < leave[out] || (t == leave[out] && a < out);
      };
      const int last = last_of_block(a), start = voxel_[a];
      const double guess = std::floor(origin_[a] + slope_[a] * leave[out]);
      int v = static_cast<int>(std::clamp<double>(guess, std::min(start, last), std::max(start, last)));
      while (v != last && crossed(v)) v += step_[a];
      while (v != start && !crossed(v - step_[a])) v -= step_[a];
      voxel_[a] = v;
      going_ = going_ && inside(a, v);
      next_[a] = at(a, border(a, v));
    }
    voxel_[out] = last_of_block(out);
    next_[out] = leave[out];
    if (going_) cross(out);
  }

 private:
  [[nodiscard]] double at(std::size_t axis, int border) const { return (border - origin_[axis]) * inverse_[axis]; }
  /// The border of a voxel that the ray crosses when it leaves along this axis.
  [[nodiscard]] int border(std::size_t axis, int voxel) const { return voxel + (step_[axis] > 0); }
  [[nodiscard]] int last_of_block(std::size_t axis) const {
    return step_[axis] > 0 ? voxel_[axis] | 7 : voxel_[axis] & ~7;
  }
  [[nodiscard]] bool inside(std::size_t axis, int voxel) const {
    return static_cast<unsigned>(voxel) < static_cast<unsigned>(size_[axis]);
  }
  static std::size_t first_of(const std::array<double, 3>& t) {
    const std::size_t xy = t[1] < t[0] ? 1 : 0;
    return t[2] < t[xy] ? 2 : xy;
  }
  void cross(std::size_t axis) {
    enter_ = next_[axis];
    voxel_[axis] += step_[axis];
    going_ = inside(axis, voxel_[axis]) && enter_ <= most_;
    next_[axis] = at(axis, border(axis, voxel_[axis]));
  }

  std::array<double, 3> origin_{}, slope_{}, inverse_{}, next_{};
  std::array<int, 3> voxel_{}, step_{}, size_{};
  double enter_ = 0, most_;
  bool going_ = false;
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>

namespace vantage {

/// Samples along the edge of a brick; the samples of a brick are ordered x + 8 (y + 8 z).
inline constexpr int brick_edge = 8;
inline constexpr std::size_t brick_samples = 512;

/// Values on a regular grid, kept in bricks of 8 x 8 x 8 samples; a brick may be missing. Sample (i, j, k) lies at
/// origin() + spacing_m() * (i, j, k) (componentwise) and in the brick with corner (i, j, k) / 8; NaN = nothing known.
/// Const members run concurrently.
template <class V>
concept BrickVolume = requires(const V v, std::size_t brick, const Eigen::Vector3i& corner,
                               std::span<float, brick_samples> values) {
  { v.bricks() } -> std::convertible_to<std::size_t>;               // how many there are
  { v.corner(brick) } -> std::convertible_to<Eigen::Vector3i>;      // [bricks]
  { v.brick_at(corner) } -> std::convertible_to<std::ptrdiff_t>;    // -1: none; any corner may be asked for
  v.load(brick, values);                                            // all values of a brick
  { v.value(brick, std::size_t{}) } -> std::convertible_to<float>;  // one of them
  { v.origin() } -> std::convertible_to<Eigen::Vector3d>;           // world frame [m]
  { v.spacing_m() } -> std::convertible_to<Eigen::Vector3d>;
};

/// A brick volume whose samples have a colour, RGB in [0, 1].
template <class V>
concept ColouredBrickVolume = BrickVolume<V> && requires(const V v, std::size_t brick) {
  { v.has_colour() } -> std::convertible_to<bool>;
  { v.colour(brick, std::size_t{}) } -> std::convertible_to<Eigen::Vector3f>;
};

/// Values on a dense grid: x fastest, then y, then z; NaN = nothing known. A model of BrickVolume.
class ScalarGrid {
 public:
  /// `size`: samples along x, y, z, each >= 2; `origin`: where sample (0, 0, 0) lies [m]. Throws Error unless there is
  /// one value a sample.
  ScalarGrid(const Eigen::Vector3i& size, const Eigen::Vector3d& origin, const Eigen::Vector3d& spacing_m,
             std::vector<float> values)
      : size_(size), origin_(origin), spacing_m_(spacing_m), values_(std::move(values)) {
    Check check("ScalarGrid");
    check(size.minCoeff() >= 2 && size.maxCoeff() <= 1 << 20, "size", concat(size.transpose()),
          "2 to 2^20 samples each");
    check(origin.allFinite(), "origin", concat(origin.transpose()), "finite");
    check(spacing_m.allFinite() && spacing_m.minCoeff() > 0, "spacing_m", concat(spacing_m.transpose()),
          "finite and > 0");
    check.done();
    if (size.cast<double>().prod() != static_cast<double>(values_.size()))
      throw Error("ScalarGrid", concat(values_.size(), " values"), concat("one for each of ", size.transpose()));
    for (int axis = 0; axis < 3; ++axis) bricks_[axis] = (size[axis] + brick_edge - 1) / brick_edge;
  }

  [[nodiscard]] const Eigen::Vector3i& size() const { return size_; }
  [[nodiscard]] const std::vector<float>& values() const { return values_; }
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  [[nodiscard]] const Eigen::Vector3d& spacing_m() const { return spacing_m_; }

  [[nodiscard]] std::size_t bricks() const {
    return static_cast<std::size_t>(bricks_.x()) * static_cast<std::size_t>(bricks_.y()) *
           static_cast<std::size_t>(bricks_.z());
  }
  [[nodiscard]] Eigen::Vector3i corner(std::size_t brick) const {
    const auto nx = static_cast<std::size_t>(bricks_.x()), ny = static_cast<std::size_t>(bricks_.y());
    return {static_cast<int>(brick % nx), static_cast<int>(brick / nx % ny), static_cast<int>(brick / nx / ny)};
  }
  [[nodiscard]] std::ptrdiff_t brick_at(const Eigen::Vector3i& corner) const {
    for (int axis = 0; axis < 3; ++axis)
      if (corner[axis] < 0 || corner[axis] >= bricks_[axis]) return -1;
    return (static_cast<std::ptrdiff_t>(corner.z()) * bricks_.y() + corner.y()) * bricks_.x() + corner.x();
  }
  void load(std::size_t brick, std::span<float, brick_samples> out) const {
    const Eigen::Vector3i first = corner(brick) * brick_edge;
    const Eigen::Vector3i n = (size_ - first).cwiseMin(brick_edge);  // less than a brick at the upper sides
    if (n != Eigen::Vector3i::Constant(brick_edge)) std::ranges::fill(out, std::numeric_limits<float>::quiet_NaN());
    float* to = out.data();
    for (int z = 0; z < n.z(); ++z)
      for (int y = 0; y < n.y(); ++y) {
        const float* from = values_.data() + index(first + Eigen::Vector3i(0, y, z));
        if (n.x() == brick_edge)
          std::copy_n(from, brick_edge, to + brick_edge * (y + brick_edge * z));
        else
          std::copy_n(from, n.x(), to + brick_edge * (y + brick_edge * z));
      }
  }
  [[nodiscard]] float value(std::size_t brick, std::size_t sample) const {
    const auto s = static_cast<int>(sample);
    const Eigen::Vector3i at = corner(brick) * brick_edge + Eigen::Vector3i(s & 7, s >> 3 & 7, s >> 6);
    const bool within = at.x() < size_.x() && at.y() < size_.y() && at.z() < size_.z();
    return within ? values_[index(at)] : std::numeric_limits<float>::quiet_NaN();
  }

 private:
  [[nodiscard]] std::size_t index(const Eigen::Vector3i& at) const {
    const auto nx = static_cast<std::size_t>(size_.x()), ny = static_cast<std::size_t>(size_.y());
    return (static_cast<std::size_t>(at.z()) * ny + static_cast<std::size_t>(at.y())) * nx +
           static_cast<std::size_t>(at.x());
  }
  Eigen::Vector3i size_, bricks_;
  Eigen::Vector3d origin_, spacing_m_;
  std::vector<float> values_;
};

}  // namespace vantage

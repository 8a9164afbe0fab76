// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage {

/// Which voxels of a grid a camera sees past its depth image: those whose centre projects into the image, and is nearer
/// (camera z) than the depth at its pixel and than the sensor's range. A value type; const members run concurrently.
class VisibleVoxels {
 public:
  /// `depth`: camera z [m] of the camera's size; pixels that are NaN see as far as `far_m`. Throws Error unless camera,
  /// view and size are valid, and far_m is finite and > 0.
  VisibleVoxels(const VoxelGrid& grid, const View& view, const Camera& camera, Image<float> depth, double far_m)
      : grid_(grid), camera_(camera), T_C_W_(view.T_W_C.inverse()), depth_(std::move(depth)), far_m_(far_m) {
    constexpr std::string_view where = "VisibleVoxels";
    camera.validate();
    check_view(view, where);
    Check check(where);
    check.positive("far_m", far_m);
    check(depth_.rows() == camera.height && depth_.cols() == camera.width, "depth",
          concat(depth_.cols(), " x ", depth_.rows(), " px"), concat(camera.width, " x ", camera.height));
    check.done();
    // The image's borders as planes through the camera; a point inside is on the inner side of each.
    const double w = camera.width, h = camera.height;
    sides_ = {Eigen::Vector3d(camera.fx, 0, camera.cx), Eigen::Vector3d(-camera.fx, 0, w - camera.cx),
              Eigen::Vector3d(0, camera.fy, camera.cy), Eigen::Vector3d(0, -camera.fy, h - camera.cy)};
    for (Eigen::Vector3d& side : sides_) side.normalize();
    block_radius_m_ = 0.5 * block_edge * grid.voxel_m().norm() * (1 + 1e-9);
    Box3 seen(view.position());
    for (const double u : {0.0, w})
      for (const double v : {0.0, h}) seen.extend(view.T_W_C * Eigen::Vector3d(far_m * camera.ray(u, v)));
    const Eigen::Array3d scale = (block_edge * grid.voxel_m()).array();
    const Eigen::Array3d blocks = (grid.size().cast<double>().array() / block_edge).ceil();
    first_ = ((seen.min() - grid.origin()).array() / scale).floor().max(0).min(blocks).cast<int>();
    end_ = (((seen.max() - grid.origin()).array() / scale).floor() + 1).max(0).min(blocks).cast<int>();
  }

  /// f(block) for each block of the grid that may hold any, in the order x, y, z.
  template <class F>
  void for_each_block(F&& f) const {
    for (int z = first_.z(); z < end_.z(); ++z)
      for (int y = first_.y(); y < end_.y(); ++y)
        for (int x = first_.x(); x < end_.x(); ++x)
          if (const Eigen::Vector3i block(x, y, z); may_see(block)) f(block);
  }
  /// Those of a block's voxels `of` that are seen. O(voxels asked for).
  [[nodiscard]] VoxelBits operator()(const Eigen::Vector3i& block, const VoxelBits& of) const {
    const Eigen::Vector3d first = T_C_W_ * grid_.centre(block_edge * block);
    const Eigen::Matrix3d step = T_C_W_.linear() * grid_.voxel_m().asDiagonal();
    VoxelBits seen;
    of.for_each([&](std::size_t local) {
      const Eigen::Vector3d at = first + step * voxel_of(Eigen::Vector3i::Zero(), local).cast<double>();
      if (!(at.z() > 0 && at.z() < far_m_)) return;
      const double u = camera_.fx * at.x() / at.z() + camera_.cx, v = camera_.fy * at.y() / at.z() + camera_.cy;
      if (!(u >= 0 && u < camera_.width && v >= 0 && v < camera_.height)) return;
      const float depth = depth_(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(u));
      if (std::isnan(depth) || at.z() < static_cast<double>(depth)) seen.set(local);
    });
    return seen;
  }

 private:
  /// By the ball around it.
  [[nodiscard]] bool may_see(const Eigen::Vector3i& block) const {
    const Eigen::Vector3d middle =
        grid_.origin() + grid_.voxel_m().cwiseProduct((block_edge * (block.cast<double>().array() + 0.5)).matrix());
    const Eigen::Vector3d at = T_C_W_ * middle;
    return at.z() > -block_radius_m_ && at.z() < far_m_ + block_radius_m_ &&
           std::ranges::all_of(sides_, [&](const Eigen::Vector3d& s) { return s.dot(at) > -block_radius_m_; });
  }
  VoxelGrid grid_;
  Camera camera_;
  Eigen::Isometry3d T_C_W_;
  Image<float> depth_;
  double far_m_, block_radius_m_ = 0;
  std::array<Eigen::Vector3d, 4> sides_;
  Eigen::Vector3i first_, end_;
};

}  // namespace vantage

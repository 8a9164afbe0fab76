// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstdint>
#include <string_view>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>

namespace vantage {

/// A box of the world cut into voxels. Voxel (i, j, k) reaches from origin() + (i, j, k) * voxel_m() one voxel further
/// along each axis; a point on a border belongs to the upper one. A value type; const members run concurrently.
class VoxelGrid {
 public:
  /// Voxels along an axis at most.
  static constexpr int most_voxels = 1 << 16;

  /// Cubes with a corner at the world's origin, as many as hold `box`: OctoMap's lattice. Throws Error for a box that
  /// is empty or not finite, an edge that is not finite and > 0, and more than 65536 voxels along an axis.
  static VoxelGrid on_lattice(const Box3& box, double edge_m) {
    check(box, edge_m, "VoxelGrid::on_lattice");
    // A side on the lattice to rounding is on it.
    const Eigen::Array3d low = (box.min().array() / edge_m + 1e-9).floor(),
                         high = (box.max().array() / edge_m - 1e-9).ceil();
    return {edge_m * low.matrix(), (high - low).max(1), Eigen::Vector3d::Constant(edge_m), "VoxelGrid::on_lattice"};
  }
  /// The box itself, cut evenly into ceil(extent / edge_m) voxels along each axis, none longer than `edge_m`: the grid
  /// of the published code of ch. 6. Throws as on_lattice does, and for a box without volume.
  static VoxelGrid dividing(const Box3& box, double edge_m) {
    check(box, edge_m, "VoxelGrid::dividing");
    if (!(box.sizes().array() > 0).all())
      throw Error("VoxelGrid::dividing", concat("a box of ", box.sizes().transpose(), " m"), "a volume");
    const Eigen::Array3d size = (box.sizes().array() / edge_m - 1e-9).ceil().max(1);
    return {box.min(), size, (box.sizes().array() / size).matrix(), "VoxelGrid::dividing"};
  }

  /// Voxels along x, y, z.
  [[nodiscard]] const Eigen::Vector3i& size() const { return size_; }
  [[nodiscard]] std::uint64_t count() const {
    return static_cast<std::uint64_t>(size_.x()) * static_cast<std::uint64_t>(size_.y()) *
           static_cast<std::uint64_t>(size_.z());
  }
  /// Edges of a voxel [m].
  [[nodiscard]] const Eigen::Vector3d& voxel_m() const { return voxel_m_; }
  /// The lower corner of voxel (0, 0, 0), world frame [m].
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  [[nodiscard]] Box3 box() const { return {origin_, origin_ + voxel_m_.cwiseProduct(size_.cast<double>())}; }

  [[nodiscard]] bool contains(const Eigen::Vector3i& voxel) const {
    return (voxel.array() >= 0).all() && (voxel.array() < size_.array()).all();
  }
  /// The voxel that holds a finite point within 2^30 voxels of the grid; it may lie outside of it.
  [[nodiscard]] Eigen::Vector3i voxel_at(const Eigen::Vector3d& point) const {
    return (point - origin_).cwiseQuotient(voxel_m_).array().floor().cast<int>();
  }
  [[nodiscard]] Eigen::Vector3d centre(const Eigen::Vector3i& voxel) const {
    return origin_ + voxel_m_.cwiseProduct((voxel.cast<double>().array() + 0.5).matrix());
  }
  [[nodiscard]] Box3 box_of(const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3d low = origin_ + voxel_m_.cwiseProduct(voxel.cast<double>());
    return {low, low + voxel_m_};
  }
  [[nodiscard]] bool operator==(const VoxelGrid& other) const {
    return origin_ == other.origin_ && voxel_m_ == other.voxel_m_ && size_ == other.size_;
  }

 private:
  static void check(const Box3& box, double edge_m, std::string_view where) {
    Check check(where);
    check(!box.isEmpty() && box.min().allFinite() && box.max().allFinite(), "box",
          concat("(", box.min().transpose(), ") to (", box.max().transpose(), ")"), "finite, not empty");
    check.positive("edge_m", edge_m);
    check.done();
  }
  VoxelGrid(const Eigen::Vector3d& origin, const Eigen::Array3d& size, const Eigen::Vector3d& voxel_m,
            std::string_view where)
      : origin_(origin), voxel_m_(voxel_m) {
    if (!(size <= most_voxels).all())
      throw Error(where, concat(size.transpose(), " voxels of ", voxel_m.x(), " m"),
                  concat(most_voxels, " at most along an axis: a smaller box or larger voxels"));
    size_ = size.cast<int>();
  }
  Eigen::Vector3d origin_, voxel_m_;
  Eigen::Vector3i size_;
};

}  // namespace vantage

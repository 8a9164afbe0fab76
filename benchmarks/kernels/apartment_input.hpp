// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/map.hpp>

namespace bench {

/// An apartment of 12 x 10 x 2.5 m as a map knows it half way through a mission: 12 rooms of 3 x 3.3 m with doors of
/// 0.9 m along both axes and a cupboard each, of which those beyond x = 6 m are known only as far as their doors show
/// them. Bits in dense blocks; navigable where 0.3 m around are free. What kernels that plan over voxels are measured
/// on.
class Apartment : public vantage::archetype::Map {
 public:
  explicit Apartment(double edge_m)
      : grid_(vantage::VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(12, 10, 2.5)}, edge_m)),
        blocks_((grid_.size().array() + 7) / 8) {
    for (int z = 0; z < blocks_.z(); ++z)
      for (int y = 0; y < blocks_.y(); ++y)
        for (int x = 0; x < blocks_.x(); ++x) known_.emplace_back(x, y, z);
    free_.resize(known_.size()), occupied_ = unexplored_ = navigable_ = free_;
    each([&](const Eigen::Vector3i& v) {
      const Eigen::Vector3d p = grid_.centre(v);
      auto& in = solid(p) ? occupied_ : seen(p) ? free_ : unexplored_;
      in[slot(vantage::block_of(v))].set(vantage::local_of(v));
    });
    const Eigen::Array3i reach = (clearance_m() / grid_.voxel_m().array()).cast<int>();
    std::vector<Eigen::Vector3i> ball;
    for (int z = -reach.z(); z <= reach.z(); ++z)
      for (int y = -reach.y(); y <= reach.y(); ++y)
        for (int x = -reach.x(); x <= reach.x(); ++x)
          if (const Eigen::Vector3i d(x, y, z); d.cast<double>().cwiseProduct(grid_.voxel_m()).norm() <= clearance_m())
            ball.push_back(d);
    each([&](const Eigen::Vector3i& v) {
      for (const Eigen::Vector3i& d : ball)
        if (state(v + d) != vantage::Space::free) return;
      navigable_[slot(vantage::block_of(v))].set(vantage::local_of(v));
    });
    each([&](const Eigen::Vector3i& v) {
      if (state(v) != vantage::Space::free) return;
      bool open = false;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int k = 0; k < 27; ++k) {
        const Eigen::Vector3i d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        if (!d.isZero() && state(v + d) == vantage::Space::free) sum += d.cast<double>().normalized();
        open = open || (d.cwiseAbs().sum() == 1 && has(unexplored_, v + d));
      }
      if (open && sum.norm() > 1e-9) frontier_.push_back({grid_.centre(v), sum.normalized()});
    });
  }

  [[nodiscard]] vantage::Box3 bounds() const { return grid_.box(); }
  [[nodiscard]] const vantage::VoxelGrid& grid() const { return grid_; }
  /// Of any voxel.
  [[nodiscard]] vantage::Space state(const Eigen::Vector3i& v) const {
    return has(free_, v)       ? vantage::Space::free
           : has(occupied_, v) ? vantage::Space::occupied
                               : vantage::Space::unknown;
  }
  [[nodiscard]] vantage::Space at(const Eigen::Vector3d& p) const { return state(grid_.voxel_at(p)); }
  [[nodiscard]] std::span<const Eigen::Vector3i> known_blocks() const { return known_; }
  [[nodiscard]] const vantage::VoxelBits& free_in(const Eigen::Vector3i& b) const { return free_[slot(b)]; }
  [[nodiscard]] const vantage::VoxelBits& occupied_in(const Eigen::Vector3i& b) const { return occupied_[slot(b)]; }
  [[nodiscard]] const vantage::VoxelBits& unexplored_in(const Eigen::Vector3i& b) const { return unexplored_[slot(b)]; }
  [[nodiscard]] double clearance_m() const { return 0.3; }
  [[nodiscard]] bool navigable(const Eigen::Vector3i& v) const { return has(navigable_, v); }
  [[nodiscard]] const vantage::VoxelBits& navigable_in(const Eigen::Vector3i& b) const { return navigable_[slot(b)]; }
  [[nodiscard]] std::vector<vantage::Region> regions(vantage::frontier) const { return frontier_; }

 private:
  using Bits = std::vector<vantage::VoxelBits>;
  static double in_room(double at, double length) { return at - length * std::floor(at / length); }
  static bool solid(const Eigen::Vector3d& p) {
    const double u = in_room(p.x(), 3), v = in_room(p.y(), 10.0 / 3);
    const bool shell = p.x() < 0.2 || p.x() > 11.8 || p.y() < 0.2 || p.y() > 9.8 || p.z() < 0.2 || p.z() > 2.3;
    const bool wall = (u < 0.2 && std::abs(v - 1.7) > 0.45) || (v < 0.2 && std::abs(u - 1.5) > 0.45);
    const bool lintel = (u < 0.2 || v < 0.2) && p.z() > 2;
    return shell || wall || lintel || (u > 2.2 && v > 2.6 && p.z() < 1.6);
  }
  static bool seen(const Eigen::Vector3d& p) {
    const double v = in_room(p.y(), 10.0 / 3);
    return p.x() < 6.2 || std::abs(v - 1.7) < 0.3 + 0.5 * (p.x() - 6.2);
  }
  template <class F>
  void each(F&& f) const {
    for (const Eigen::Vector3i& block : known_)
      vantage::VoxelBits::inside(grid_, block).for_each([&](std::size_t i) { f(vantage::voxel_of(block, i)); });
  }
  [[nodiscard]] std::size_t slot(const Eigen::Vector3i& b) const {
    return static_cast<std::size_t>((b.z() * blocks_.y() + b.y()) * blocks_.x() + b.x());
  }
  [[nodiscard]] bool has(const Bits& bits, const Eigen::Vector3i& v) const {
    return grid_.contains(v) && bits[slot(vantage::block_of(v))][vantage::local_of(v)];
  }
  vantage::VoxelGrid grid_;
  Eigen::Vector3i blocks_;
  std::vector<Eigen::Vector3i> known_;
  Bits free_, occupied_, unexplored_, navigable_;
  std::vector<vantage::Region> frontier_;
};

}  // namespace bench

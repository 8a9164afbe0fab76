// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/mission/canvas.hpp>

namespace scene {

using namespace vantage;

/// A voxel map from above, a value a column of voxels, row = y and column = x: occupied if any of the voxels between
/// `low_m` and `high_m` is, else free if any is.
struct FloorPlan {
  Image<std::uint8_t> columns;  ///< of Space
  VoxelGrid grid;

  template <VoxelOccupancy M>
  FloorPlan(const M& map, double low_m, double high_m)
      : columns(Image<std::uint8_t>::Zero(map.grid().size().y(), map.grid().size().x())), grid(map.grid()) {
    const auto put = [&](const Eigen::Vector3i& block, const VoxelBits& bits, Space space) {
      bits.for_each([&](std::size_t local) {
        const Eigen::Vector3i v = voxel_of(block, local);
        const double z = grid.centre(v).z();
        if (z < low_m || z > high_m) return;
        auto& column = columns(v.y(), v.x());
        column = std::max(column, static_cast<std::uint8_t>(space));
      });
    };
    for (const Eigen::Vector3i& block : map.known_blocks()) {
      put(block, map.free_in(block), Space::free);
      put(block, map.occupied_in(block), Space::occupied);
    }
  }

  [[nodiscard]] Space at(const Eigen::Vector2d& p) const {
    const Eigen::Vector3i v = grid.voxel_at({p.x(), p.y(), grid.origin().z()});
    return v.x() >= 0 && v.x() < columns.cols() && v.y() >= 0 && v.y() < columns.rows()
               ? static_cast<Space>(columns(v.y(), v.x()))
               : Space::unknown;
  }
  /// Around all that is known, and a bit more.
  [[nodiscard]] Box2 known() const {
    Box2 box;
    const Eigen::Vector2d origin = grid.origin().head<2>(), edge = grid.voxel_m().head<2>();
    for (Eigen::Index y = 0; y < columns.rows(); ++y)
      for (Eigen::Index x = 0; x < columns.cols(); ++x)
        if (columns(y, x) != 0) {
          const Eigen::Vector2d corner(static_cast<double>(x), static_cast<double>(y));
          box.extend(Eigen::Vector2d(origin + corner.cwiseProduct(edge)));
          box.extend(Eigen::Vector2d(origin + (corner.array() + 1).matrix().cwiseProduct(edge)));
        }
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.1);
    return box.isEmpty() ? Box2(grid.box().min().head<2>(), grid.box().max().head<2>())
                         : Box2(box.min() - margin, box.max() + margin);
  }
  void fill(Canvas& canvas) const {
    canvas.fill([this](const Eigen::Vector2d& p) {
      switch (at(p)) {
        case Space::free:
          return Rgb{252, 252, 250};
        case Space::occupied:
          return Rgb{62, 68, 76};
        default:
          return Rgb{205, 209, 214};
      }
    });
  }
};

}  // namespace scene

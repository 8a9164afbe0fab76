// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/mission/canvas.hpp>

namespace scene {

using namespace vantage;

/// A voxel map from above, a value a column of voxels, row = y and column = x: occupied if any of the voxels between
/// `low_m` and `high_m` is, else free if any is.
struct FloorPlan {
  Image<std::uint8_t> columns = {};  ///< of Space
  Eigen::Vector2d origin = {}, voxel_m = {};

  FloorPlan() = default;
  template <VoxelOccupancy M>
  FloorPlan(const M& map, double low_m, double high_m)
      : columns(Image<std::uint8_t>::Zero(map.grid().size().y(), map.grid().size().x())),
        origin(map.grid().origin().template head<2>()),
        voxel_m(map.grid().voxel_m().template head<2>()) {
    const VoxelGrid& grid = map.grid();
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
    const Eigen::Vector2i v = (p - origin).cwiseQuotient(voxel_m).array().floor().cast<int>();
    return v.x() >= 0 && v.x() < columns.cols() && v.y() >= 0 && v.y() < columns.rows()
               ? static_cast<Space>(columns(v.y(), v.x()))
               : Space::unknown;
  }
  /// Around all that is known, and a bit more.
  [[nodiscard]] Box2 known() const {
    Box2 box;
    for (Eigen::Index y = 0; y < columns.rows(); ++y)
      for (Eigen::Index x = 0; x < columns.cols(); ++x)
        if (columns(y, x) != 0) {
          const Eigen::Vector2d corner(static_cast<double>(x), static_cast<double>(y));
          box.extend(Eigen::Vector2d(origin + corner.cwiseProduct(voxel_m)));
          box.extend(Eigen::Vector2d(origin + (corner.array() + 1).matrix().cwiseProduct(voxel_m)));
        }
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.1);
    if (!box.isEmpty()) return {box.min() - margin, box.max() + margin};
    const Eigen::Vector2d size(static_cast<double>(columns.cols()), static_cast<double>(columns.rows()));
    return {origin, origin + voxel_m.cwiseProduct(size)};
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

  void save(Sink& sink) const {
    for (const double x : {origin.x(), origin.y(), voxel_m.x(), voxel_m.y()}) sink.put(x);
    sink.put(columns);
  }
  void load(Source& source) {
    for (double* x : {&origin.x(), &origin.y(), &voxel_m.x(), &voxel_m.y()}) source.get(*x);
    source.get(columns);
  }
};

}  // namespace scene

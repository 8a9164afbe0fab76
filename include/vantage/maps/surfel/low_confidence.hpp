// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/map.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/maps/surfel/surfel_normal.hpp>
#include <vantage/maps/surfel/surfels.hpp>

namespace vantage {

/// Which voxels are of low confidence (section 6.1.5).
struct LowConfidenceConfig {
  int more_than = 5;        ///< surfels in the voxel, each
  double confidence = 0.3;  ///< of less confidence than this
  double opacity = 0.7;     ///< and of more opacity than this, in [0, 1)

  void validate() const {
    Check check("LowConfidenceConfig");
    check(more_than >= 0, "more_than", more_than, ">= 0");
    check.finite("confidence", confidence);
    check(opacity >= 0 && opacity < 1, "opacity", opacity, "in [0, 1)");
    check.done();
  }
};

/// Voxels that hold many opaque surfels of low confidence and touch a free voxel (one of 6 neighbours), by their
/// centres; the normal is the normalised mean of those surfels' normals, or, where these cancel out, up. In the order
/// of x, then y, then z. O(surfels log surfels).
template <VoxelOccupancy Voxels>
std::vector<Region> low_confidence_regions(const Surfels& surfels, const Voxels& voxels,
                                           const LowConfidenceConfig& config = {}) {
  const VoxelGrid& grid = voxels.grid();
  const Box3 box = grid.box();
  std::vector<std::pair<std::uint64_t, std::size_t>> low;  // voxel, surfel
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    if (!(surfels.confidence[i] < static_cast<float>(config.confidence)) ||
        !(opacity_of(surfels, i) > static_cast<float>(config.opacity)))
      continue;
    const Eigen::Vector3d p = position_of(surfels, i).cast<double>();
    if (!box.contains(p)) continue;
    const Eigen::Vector3i voxel = grid.voxel_at(p);
    if (!grid.contains(voxel)) continue;
    std::uint64_t key = 0;
    for (int a = 0; a < 3; ++a) key = key << 20 | static_cast<std::uint64_t>(voxel[a]);
    low.emplace_back(key, i);
  }
  std::sort(low.begin(), low.end());
  const auto touches_free = [&](const Eigen::Vector3i& voxel) {
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        Eigen::Vector3i other = voxel;
        other[axis] += step;
        if (grid.contains(other) && voxels.state(other) == Space::free) return true;
      }
    return false;
  };
  std::vector<Region> found;
  for (std::size_t first = 0, last = 0; first < low.size(); first = last) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (; last < low.size() && low[last].first == low[first].first; ++last)
      sum += normal_of(surfels, low[last].second).cast<double>();
    if (last - first <= static_cast<std::size_t>(config.more_than)) continue;
    const std::uint64_t key = low[first].first;
    const Eigen::Vector3i voxel(static_cast<int>(key >> 40), static_cast<int>(key >> 20 & 0xFFFFF),
                                static_cast<int>(key & 0xFFFFF));
    if (!touches_free(voxel)) continue;
    found.push_back({grid.centre(voxel), sum.norm() > 1e-9 ? sum.normalized() : Eigen::Vector3d::UnitZ().eval()});
  }
  return found;
}

}  // namespace vantage

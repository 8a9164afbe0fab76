// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/triangle_mesh.hpp>

namespace vantage {

/// Points on a mesh, and the triangle on which each lies.
struct SurfaceSamples {
  std::vector<Eigen::Vector3f> points;  ///< world frame [m]
  std::vector<std::uint32_t> triangles;

  [[nodiscard]] std::size_t size() const { return points.size(); }
  /// Those whose flag is not 0, in their order.
  [[nodiscard]] SurfaceSamples where(const std::vector<std::uint8_t>& flags) const {
    if (flags.size() != size())
      throw Error("SurfaceSamples::where", concat(flags.size(), " flags"),
                  concat("one for each of ", size(), " points"));
    SurfaceSamples kept;
    for (std::size_t i = 0; i < size(); ++i)
      if (flags[i] != 0) {
        kept.points.push_back(points[i]);
        kept.triangles.push_back(triangles[i]);
      }
    return kept;
  }
};

/// n points on a mesh, uniform by area and stratified: laid side by side, the triangles are cut into n pieces of the
/// same area, and each piece gets one point, uniform on it. Points are in the order of the triangles. The same bits
/// with any number of threads. Throws Error for a mesh that is not valid or has no area, and for n = 0. O(triangles + n
/// log triangles).
inline SurfaceSamples sample_surface(const TriangleMesh& mesh, std::size_t n, const Rng& rng) {
  mesh.validate("sample_surface");
  if (n == 0) throw Error("sample_surface", "n = 0", "at least one point");
  std::vector<double> area_up_to(mesh.triangles.size());
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) area_up_to[i] = area += mesh.area_normal(i).norm();
  if (!(area > 0)) throw Error("sample_surface", "the mesh has no area", "a triangle that is not degenerate");
  SurfaceSamples samples;
  samples.points.resize(n);
  samples.triangles.resize(n);
  parallel_for_blocks(n, 4096, [&](std::size_t begin, std::size_t end) {
    Rng mine = rng.fork(begin);
    for (std::size_t i = begin; i < end; ++i) {
      const double at = area * ((static_cast<double>(i) + mine.uniform()) / static_cast<double>(n));
      const auto found = std::ranges::upper_bound(area_up_to, std::min(at, std::nextafter(area, 0.0)));
      const auto triangle = static_cast<std::size_t>(found - area_up_to.begin());
      const auto [a, b, c] = mesh.corners(triangle);
      // Uniform on a triangle: the distance from a grows as the square root of the area below it.
      const double s = std::sqrt(mine.uniform()), t = mine.uniform();
      samples.points[i] = ((1 - s) * a + s * (1 - t) * b + s * t * c).cast<float>();
      samples.triangles[i] = static_cast<std::uint32_t>(triangle);
    }
  });
  return samples;
}

}  // namespace vantage

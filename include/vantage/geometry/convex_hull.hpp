// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/qhull.hpp>
#include <vantage/geometry/box.hpp>

namespace vantage {

/// A closed surface around a convex solid; triangles counter-clockwise as seen from outside.
struct ConvexHull {
  std::vector<Eigen::Vector3d> vertices;  ///< [m]; none lies inside of the hull
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The convex hull of points [m], by Qhull (Barber et al., "The quickhull algorithm for convex hulls", ACM TOMS 1996).
/// Throws Error for fewer than four points or more than a million, for points that are not finite, and if all lie in a
/// plane. O(n log n).
inline ConvexHull convex_hull(std::span<const Eigen::Vector3d> points) {
  if (points.size() < 4 || points.size() > 1'000'000)
    throw Error("convex_hull", concat(points.size(), " points"), "4 to 1000000");
  Box3 box;
  for (const Eigen::Vector3d& p : points) {
    if (!p.allFinite()) throw Error("convex_hull", "a point is not finite", "finite coordinates");
    box.extend(p);
  }
  const double size = box.sizes().maxCoeff();
  if (!(size > 0 && std::isfinite(size)))
    throw Error("convex_hull", "all points coincide or lie infinitely apart", "points with an extent");
  std::vector<double> unit;
  unit.reserve(3 * points.size());
  for (const Eigen::Vector3d& p : points)
    for (const double x : Eigen::Vector3d((p - box.min()) / size)) unit.push_back(x);

  detail::Qhull run("convex_hull", "qhull Qt", 3, unit);
  if (run.code != 0)
    throw Error("convex_hull", "Qhull refuses the points: " + run.message(), "points that do not all lie in a plane");
  qhT* const qh = &run.qh;
  ConvexHull hull;
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> index(points.size(), none);
  for (const facetT* facet = qh->facet_list; facet && facet->next; facet = facet->next) {
    std::array<std::uint32_t, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i =
          static_cast<std::size_t>(qh_pointid(qh, static_cast<const vertexT*>(facet->vertices->e[k].p)->point));
      if (index[i] == none) {
        index[i] = static_cast<std::uint32_t>(hull.vertices.size());
        hull.vertices.push_back(points[i]);
      }
      triangle[k] = index[i];
    }
    // Qhull orders a facet's vertices by their age, and says in which sense that runs.
    if (facet->toporient == True) std::swap(triangle[1], triangle[2]);
    hull.triangles.push_back(triangle);
  }
  return hull;
}

}  // namespace vantage

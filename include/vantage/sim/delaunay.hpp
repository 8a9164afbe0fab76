// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/qhull.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/scalar_field.hpp>

// Triangulation by Qhull (its reentrant library), and linear interpolation over it.
namespace vantage {

/// Corners of a triangle, as indices into the points.
using Triangle = std::array<std::size_t, 3>;

/// The Delaunay triangulation of distinct points (any unit); triangles without area are left out. Throws Error for
/// fewer than three points, for points that are not finite, and if all lie on a line. O(n log n).
inline std::vector<Triangle> delaunay(std::span<const Eigen::Vector2d> points) {
  if (points.size() < 3 || points.size() > 10'000'000)
    throw Error("delaunay", concat(points.size(), " points"), "3 to 10000000");
  Box2 box;
  for (const Eigen::Vector2d& p : points) {
    if (!p.allFinite()) throw Error("delaunay", "a point is not finite", "finite coordinates");
    box.extend(p);
  }
  const double size = box.sizes().maxCoeff();
  if (!(size > 0 && std::isfinite(size)))
    throw Error("delaunay", "all points coincide or lie infinitely apart", "points with an extent");
  std::vector<double> unit;  // Qhull's tolerances are made for coordinates around 1
  unit.reserve(2 * points.size());
  for (const Eigen::Vector2d& p : points)
    for (const double x : Eigen::Vector2d((p - box.min()) / size)) unit.push_back(x);

  detail::Qhull run("delaunay", "qhull d Qt Qbb Qc Qz Q12", 2, unit);
  if (run.code != 0)
    throw Error("delaunay", "Qhull refuses the points: " + run.message(), "points that do not all lie on a line");
  qhT* const qh = &run.qh;
  std::vector<Triangle> triangles;
  for (const facetT* facet = qh->facet_list; facet && facet->next; facet = facet->next) {
    if (facet->upperdelaunay || qh_setsize(qh, facet->vertices) != 3) continue;
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k)
      t[k] = static_cast<std::size_t>(qh_pointid(qh, static_cast<const vertexT*>(facet->vertices->e[k].p)->point));
    const Eigen::Map<const Eigen::Vector2d> a(&unit[2 * t[0]]), b(&unit[2 * t[1]]), c(&unit[2 * t[2]]);
    if (std::abs((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) > 1e-14) triangles.push_back(t);
  }
  if (triangles.empty()) throw Error("delaunay", "all points lie on a line", "three that do not");
  return triangles;
}

/// Linear interpolation of scattered samples over their Delaunay triangulation, at the centres of a raster of rows x
/// columns pixels over `area_m`; NaN outside of the samples' convex hull. Positions in metres. O(n log n + pixels).
inline Image<double> interpolate_scattered(std::span<const FieldSample> samples, const Box2& area_m, Eigen::Index rows,
                                           Eigen::Index columns) {
  const Eigen::Vector2d pixel_m =
      area_m.sizes().cwiseQuotient(Eigen::Vector2d(static_cast<double>(columns), static_cast<double>(rows)));
  // In pixel coordinates the centre of pixel (row, column) is the point (column, row).
  std::vector<Eigen::Vector2d> points(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    points[i] = (samples[i].position - area_m.min()).cwiseQuotient(pixel_m) - Eigen::Vector2d::Constant(0.5);

  Image<double> image = Image<double>::Constant(rows, columns, std::numeric_limits<double>::quiet_NaN());
  constexpr double slack = 1e-9;  // [px]: centres on a shared edge belong to either side, which agree there
  const auto first = [](double x) {
    return std::max<Eigen::Index>(0, static_cast<Eigen::Index>(std::ceil(std::max(x - slack, -1.0))));
  };
  const auto last = [](double x, Eigen::Index n) {
    return static_cast<Eigen::Index>(std::floor(std::min(x + slack, static_cast<double>(n - 1))));
  };
  for (const Triangle& t : delaunay(points)) {
    const Eigen::Vector2d a = points[t[0]], u = points[t[1]] - a, v = points[t[2]] - a;
    const double fa = samples[t[0]].value, fu = samples[t[1]].value - fa, fv = samples[t[2]].value - fa;
    const double det = u.x() * v.y() - u.y() * v.x();
    const double slope_x = (fu * v.y() - fv * u.y()) / det, slope_y = (fv * u.x() - fu * v.x()) / det;
    const auto [low, high] = std::minmax({a.y(), points[t[1]].y(), points[t[2]].y()});
    for (Eigen::Index row = first(low); row <= last(high, rows); ++row) {
      const double y = std::clamp(static_cast<double>(row), low, high);  // where this row's line crosses the triangle
      double left = std::numeric_limits<double>::infinity(), right = -left;
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector2d &p = points[t[k]], &q = points[t[(k + 1) % 3]];
        if ((y < p.y() && y < q.y()) || (y > p.y() && y > q.y())) continue;
        const double x0 = p.y() == q.y() ? p.x() : p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
        const double x1 = p.y() == q.y() ? q.x() : x0;
        left = std::min({left, x0, x1});
        right = std::max({right, x0, x1});
      }
      for (Eigen::Index column = first(left); column <= last(right, columns); ++column)
        image(row, column) =
            fa + slope_x * (static_cast<double>(column) - a.x()) + slope_y * (static_cast<double>(row) - a.y());
    }
  }
  return image;
}

}  // namespace vantage

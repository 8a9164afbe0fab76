// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <ccd/ccd.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/view.hpp>

// The only file that knows libccd.
namespace vantage {

/// What a camera sees between two depths: a convex body with eight corners.
struct ViewFrustum {
  std::array<Eigen::Vector3d, 8> corners;  ///< world frame [m]; the four at the near depth first

  /// Depths are camera z [m]; a near depth of 0 makes a pyramid. Throws Error for a bad camera, view or depth.
  static ViewFrustum of(const View& view, const Camera& camera, double near_m, double far_m) {
    camera.validate();
    check_view(view, "ViewFrustum");
    Check check("ViewFrustum");
    check.not_negative("near_m", near_m);
    check(far_m > near_m && far_m <= 1e6, "far_m", far_m, "above near_m, up to 1e6");
    check(view.position().cwiseAbs().maxCoeff() <= 1e6, "position", view.position().transpose(), "within 1e6 m");
    check.done();
    ViewFrustum frustum;
    for (std::size_t i = 0; i < 8; ++i)
      frustum.corners[i] =
          view.T_W_C * ((i < 4 ? near_m : far_m) * camera.ray(i & 1 ? camera.width : 0, i & 2 ? camera.height : 0));
    return frustum;
  }
  /// The middle of its corners, which is inside.
  [[nodiscard]] Eigen::Vector3d centre() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& c : corners) sum += c;
    return sum / 8;
  }
  /// Along its edges: right, down, and the four from near to far.
  [[nodiscard]] std::array<Eigen::Vector3d, 6> edges() const {
    return {corners[5] - corners[4], corners[6] - corners[4], corners[4] - corners[0],
            corners[5] - corners[1], corners[6] - corners[2], corners[7] - corners[3]};
  }
  /// The corner farthest along a direction.
  [[nodiscard]] const Eigen::Vector3d& support(const Eigen::Vector3d& direction) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < 8; ++i)
      if (corners[i].dot(direction) > corners[best].dot(direction)) best = i;
    return corners[best];
  }
};

namespace detail {

/// A frustum as libccd sees it.
struct CcdFrustum {
  ViewFrustum frustum;
  Eigen::Vector3d last_direction = Eigen::Vector3d::Zero();  ///< in which it was asked for a corner

  static void support(const void* body, const ccd_vec3_t* direction, ccd_vec3_t* corner) {
    auto& self = *static_cast<CcdFrustum*>(const_cast<void*>(body));  // ours, and not const: libccd passes it through
    self.last_direction = {direction->v[0], direction->v[1], direction->v[2]};
    const Eigen::Vector3d& c = self.frustum.support(self.last_direction);
    ccdVec3Set(corner, c.x(), c.y(), c.z());
  }
};

}  // namespace detail

/// Whether two frusta share space: exact to rounding, at which those that touch overlap. They do not if a plane lies
/// between them. libccd's GJK (Gilbert, Johnson and Keerthi, 1988) proposes one, which is checked; where it proposes
/// none that holds, all that can be are tried, so that "no" is proven and "not converged" is no answer. Frusta that are
/// not finite overlap. About a microsecond; runs concurrently.
inline bool overlaps(const ViewFrustum& a, const ViewFrustum& b) {
  // In a frame of their own, scaled to a size around 1, which GJK's tolerances are made for.
  const Eigen::Vector3d middle = 0.5 * (a.centre() + b.centre());
  double size = 0;
  for (const ViewFrustum* f : {&a, &b})
    for (const Eigen::Vector3d& c : f->corners) {
      if (!c.allFinite()) return true;
      size = std::max(size, (c - middle).cwiseAbs().maxCoeff());
    }
  if (!(size > 0)) return true;
  const auto scaled = [&](const ViewFrustum& f) {
    detail::CcdFrustum body;
    for (std::size_t i = 0; i < 8; ++i) body.frustum.corners[i] = (f.corners[i] - middle) / size;
    return body;
  };
  detail::CcdFrustum first = scaled(a), second = scaled(b);
  const auto is_between = [&](const Eigen::Vector3d& normal) {
    const double gap = (second.frustum.support(-normal) - first.frustum.support(normal)).dot(normal);
    return gap > 1e-12 * normal.norm();  // false for a normal that is not finite
  };

  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = detail::CcdFrustum::support;
  ccd.max_iterations = 100;
  if (ccdGJKIntersect(&first, &second, &ccd) != 0) return true;
  // It asked the first frustum along the direction of the plane, and the second against it.
  if (is_between(first.last_direction)) return false;
  // It gives up where corners line up, as those of views along the world's axes do. Of two convex polyhedra that are
  // apart, a face of one, or an edge of each, lies along some plane between them.
  const auto edges = first.frustum.edges(), others = second.frustum.edges();
  const auto is_between_both_ways = [&](const Eigen::Vector3d& normal) {
    return is_between(normal) || is_between(-normal);
  };
  for (const auto* e : {&edges, &others})
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < i; ++k)  // those that share a face, and some that do not
        if (is_between_both_ways((*e)[i].cross((*e)[k]))) return false;
  for (const Eigen::Vector3d& e : edges)
    for (const Eigen::Vector3d& o : others)
      if (is_between_both_ways(e.cross(o))) return false;
  return true;
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/mesh_sampling.hpp>

namespace vantage {

/// Says whether nothing lies between two points (world frame [m]): called concurrently. `to` lies on a surface: what is
/// within about a millimetre of it must not count.
template <class F>
concept LineOfSight = std::predicate<const F&, const Eigen::Vector3d&, const Eigen::Vector3d&>;

/// What a camera can measure: depths from near_m to far_m [m].
struct SensingRange {
  double near_m = 0;  ///< >= 0
  double far_m = 5;   ///< > near_m

  void validate() const {
    Check check("SensingRange");
    check.not_negative("near_m", near_m);
    check(std::isfinite(far_m) && far_m > near_m, "far_m", far_m, "finite and > near_m");
    check.done();
  }
};

/// For each surface point 1 if it can be seen from one of the positions at least, else 0: within the range (of the
/// distance, a camera may look in any direction) and in line of sight; from either side of the surface. Only such
/// points should count in metrics: walls have an inside. A point that is seen costs few lines of sight, as the position
/// that saw the one before it is tried first; a hidden one costs one for every position in range: 0.3 to 0.5 m between
/// positions will do. Throws Error for points or positions that are not finite, or no positions.
template <LineOfSight F>
std::vector<std::uint8_t> visible_surface(const SurfaceSamples& surface, std::span<const Eigen::Vector3d> positions,
                                          const SensingRange& range, const F& visible) {
  range.validate();
  if (positions.empty()) throw Error("visible_surface", "no positions", "at least one");
  for (const Eigen::Vector3d& p : positions)
    if (!p.allFinite()) throw Error("visible_surface", "a position is not finite", "finite coordinates");
  for (const Eigen::Vector3f& p : surface.points)
    if (!p.allFinite()) throw Error("visible_surface", "a surface point is not finite", "finite coordinates");
  std::vector<std::uint8_t> seen(surface.size());
  parallel_for_blocks(surface.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> order(positions.size());  // whoever saw a point moves to the front
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d point = surface.points[i].template cast<double>();
      const auto sees = [&](std::size_t k) {
        const double distance_m = (positions[k] - point).norm();
        return distance_m >= range.near_m && distance_m <= range.far_m && distance_m > 0 &&
               visible(positions[k], point);
      };
      const auto found = std::ranges::find_if(order, sees);
      if (found == order.end()) continue;
      seen[i] = 1;
      std::swap(*order.begin(), *found);
    }
  });
  return seen;
}

/// Which share of a surface was seen so far, measurement by measurement. Depends on no map.
class SurfaceCoverage {
 public:
  /// How far a point may lie from the depth measured at its pixel [m]: absolute_m + share * depth. The defaults allow
  /// three deviations of a sensor whose noise is 1 % of the depth.
  struct Tolerance {
    double absolute_m = 0.02;  ///< >= 0
    double share = 0.03;       ///< >= 0
  };

  /// `surface`: what counts, as sample_surface and visible_surface give it. Throws Error if it is empty or not finite.
  explicit SurfaceCoverage(SurfaceSamples surface) : SurfaceCoverage(std::move(surface), Tolerance()) {}
  SurfaceCoverage(SurfaceSamples surface, const Tolerance& tolerance)
      : surface_(std::move(surface)), tolerance_(tolerance), seen_(surface_.size()) {
    Check check("SurfaceCoverage::Tolerance");
    check.not_negative("absolute_m", tolerance.absolute_m);
    check.not_negative("share", tolerance.share);
    check.done();
    if (surface_.size() == 0) throw Error("SurfaceCoverage", "no surface points", "at least one");
    for (const Eigen::Vector3f& p : surface_.points)
      if (!p.allFinite()) throw Error("SurfaceCoverage", "a surface point is not finite", "finite coordinates");
  }

  /// Adds what a frame saw: the points in front of the camera and inside of its image whose camera z differs from the
  /// depth of the pixel that they fall into by no more than the tolerance. Throws Error, and changes nothing, for a bad
  /// frame or one without depth. Returns how many points are new. O(points), concurrent.
  std::size_t add(const Frame& frame) {
    frame.validate("SurfaceCoverage::add");
    if (frame.depth.size() == 0) throw Error("SurfaceCoverage::add", "the frame has no depth", "a depth image");
    return add(frame.view, frame.camera, [&](const Eigen::Vector3d&, double z, Eigen::Index row, Eigen::Index column) {
      const auto depth = static_cast<double>(frame.depth(row, column));  // NaN: not seen
      return std::abs(z - depth) <= tolerance_.absolute_m + tolerance_.share * depth;
    });
  }
  /// Adds what a camera would see without noise: the points inside of its image, with a depth in range and in line of
  /// sight from it. Throws Error, and changes nothing, for a bad view, camera or range.
  template <LineOfSight F>
  std::size_t add(const View& view, const Camera& camera, const SensingRange& range, const F& visible) {
    check_view(view, "SurfaceCoverage::add");
    camera.validate();
    range.validate();
    const Eigen::Vector3d eye = view.position();
    return add(view, camera, [&](const Eigen::Vector3d& point, double z, Eigen::Index, Eigen::Index) {
      return z >= range.near_m && z <= range.far_m && visible(eye, point);
    });
  }

  /// [0, 1]
  [[nodiscard]] double coverage() const {
    return static_cast<double>(seen_points_) / static_cast<double>(seen_.size());
  }
  [[nodiscard]] const SurfaceSamples& surface() const { return surface_; }
  [[nodiscard]] const std::vector<std::uint8_t>& seen() const { return seen_; }  ///< of each point: 1 or 0

 private:
  // Asks sees(point, z, row, column) for the points inside of the image that were not seen yet.
  template <class F>
  requires std::predicate<const F&, const Eigen::Vector3d&, double, Eigen::Index, Eigen::Index> std::size_t add(
      const View& view, const Camera& camera, const F& sees) {
    const Eigen::Isometry3d T_C_W = view.T_W_C.inverse();
    const std::size_t fresh = parallel_sum(seen_.size(), 4096, std::size_t{0}, [&](std::size_t begin, std::size_t end) {
      std::size_t n = 0;
      for (std::size_t i = begin; i < end; ++i) {
        if (seen_[i] != 0) continue;
        const Eigen::Vector3d point = surface_.points[i].template cast<double>(), p = T_C_W * point;
        if (!(p.z() > 0)) continue;
        const double u = camera.fx * p.x() / p.z() + camera.cx, v = camera.fy * p.y() / p.z() + camera.cy;
        if (!(u >= 0 && u < camera.width && v >= 0 && v < camera.height)) continue;
        if (!sees(point, p.z(), static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(u))) continue;
        seen_[i] = 1;
        ++n;
      }
      return n;
    });
    seen_points_ += fresh;
    return fresh;
  }

  SurfaceSamples surface_;
  Tolerance tolerance_;
  std::vector<std::uint8_t> seen_;
  std::size_t seen_points_ = 0;
};

}  // namespace vantage

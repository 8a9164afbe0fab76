// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>
#include <string_view>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>

// Poses of a robot's body, T_W_B: body points to world points. Spaces of poses from which a sampling planner draws.
namespace vantage {

/// Whether a robot's body is clear of everything at a pose, and all the way between two, as a RigidMotion goes.
/// Whatever a library could not decide is not free. May be called concurrently by others, not by RrtStar. Among the
/// voxels of a map: BoxInVoxels; in a scene's mesh: CollisionChecker.
template <class C>
concept CollisionFree = requires(const C c, const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  { c.is_free(from) } -> std::convertible_to<bool>;
  { c.is_free(from, to) } -> std::convertible_to<bool>;
};

/// A space of poses: how many dimensions it has, how large it is in these (> 0) [m^dimension], and a uniform draw. A
/// turn by an angle counts as long as a way of `metres_per_rad` times it.
template <class S>
concept PoseSpace = requires(const S s, Rng& rng) {
  { s.dimension() } -> std::convertible_to<int>;
  { s.metres_per_rad } -> std::convertible_to<double>;
  { s.volume() } -> std::convertible_to<double>;
  { s.draw(rng) } -> std::same_as<Eigen::Isometry3d>;
  s.check();  // throws Error naming every bad member
};

inline double turn_rad(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  // By sine and cosine, that small turns keep their digits.
  const Eigen::Matrix3d r = a.linear().transpose() * b.linear();
  const Eigen::Vector3d axis(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  return std::atan2(0.5 * axis.norm(), 0.5 * (r.trace() - 1));
}
/// The metric of the product of places and rotations [m].
inline double pose_distance_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double metres_per_rad) {
  return std::hypot((b.translation() - a.translation()).norm(), metres_per_rad * turn_rad(a, b));
}
inline void check_pose_space(std::string_view where, const Box3& bounds, double metres_per_rad) {
  Check check(where);
  check(bounds.min().allFinite() && bounds.max().allFinite() && !bounds.isEmpty(), "bounds",
        concat("(", bounds.min().transpose(), ") to (", bounds.max().transpose(), ")"), "finite, not empty");
  check.positive("metres_per_rad", metres_per_rad);
  check.done();
}

namespace detail {

/// Along how many axes a box has extent (a nanometre or more), and its length, area or volume in these [m^axes].
struct Extent {
  int axes = 0;
  double measure = 1;
  explicit Extent(const Box3& box) {
    for (int i = 0; i < 3; ++i)
      if (const double length_m = box.max()[i] - box.min()[i]; length_m >= 1e-9) ++axes, measure *= length_m;
  }
};

}  // namespace detail

/// Places in a box and turns about the world's z axis: robots that stay upright. A box that is flat, as that of a robot
/// on the ground, makes a space of fewer dimensions.
struct UprightPoses {
  Box3 bounds;                  ///< [m]
  double metres_per_rad = 0.3;  ///< > 0
  [[nodiscard]] int dimension() const { return detail::Extent(bounds).axes + 1; }
  [[nodiscard]] double volume() const { return detail::Extent(bounds).measure * 2 * std::numbers::pi * metres_per_rad; }
  [[nodiscard]] Eigen::Isometry3d draw(Rng& rng) const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 3; ++i) pose.translation()[i] = rng.uniform(bounds.min()[i], bounds.max()[i]);
    pose.rotate(Eigen::AngleAxisd(rng.uniform(-std::numbers::pi, std::numbers::pi), Eigen::Vector3d::UnitZ()));
    return pose;
  }
  void check() const { check_pose_space("UprightPoses", bounds, metres_per_rad); }
};

/// Places in a box, which may be flat, and all rotations: SE(3).
struct FreePoses {
  Box3 bounds;                  ///< [m]
  double metres_per_rad = 0.3;  ///< > 0
  [[nodiscard]] int dimension() const { return detail::Extent(bounds).axes + 3; }
  [[nodiscard]] double volume() const {
    return detail::Extent(bounds).measure * 8 * std::numbers::pi * std::numbers::pi * std::pow(metres_per_rad, 3);
  }
  /// The rotation uniform (Shoemake, "Uniform random rotations", Graphics Gems III, 1992).
  [[nodiscard]] Eigen::Isometry3d draw(Rng& rng) const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 3; ++i) pose.translation()[i] = rng.uniform(bounds.min()[i], bounds.max()[i]);
    const double u = rng.uniform(), a = rng.uniform(0, 2 * std::numbers::pi), b = rng.uniform(0, 2 * std::numbers::pi);
    const double s = std::sqrt(1 - u), c = std::sqrt(u);
    pose.linear() =
        Eigen::Quaterniond(c * std::cos(b), s * std::sin(a), s * std::cos(a), c * std::sin(b)).toRotationMatrix();
    return pose;
  }
  void check() const { check_pose_space("FreePoses", bounds, metres_per_rad); }
};

}  // namespace vantage

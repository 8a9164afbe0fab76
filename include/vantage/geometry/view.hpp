// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>

namespace vantage {

/// From where to look: the camera's pose. Camera x right, y down, z forward; world z up; metres.
struct View {
  Eigen::Isometry3d T_W_C = Eigen::Isometry3d::Identity();  ///< camera points to world points

  [[nodiscard]] Eigen::Vector3d position() const { return T_W_C.translation(); }
  [[nodiscard]] Eigen::Vector3d forward() const { return T_W_C.linear().col(2); }
  /// World points to camera points; for a rigid pose. Coefficient by coefficient, since Transform::inverse makes every
  /// includer compile Eigen's general inverses.
  [[nodiscard]] Eigen::Isometry3d T_C_W() const {
    Eigen::Isometry3d inverse = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        inverse(i, j) = T_W_C(j, i);
        inverse(i, 3) -= T_W_C(j, i) * T_W_C(j, 3);
      }
    return inverse;
  }

  void save(Sink& sink) const { sink.put(Eigen::Matrix4d(T_W_C.matrix())); }
  /// Throws Error, the view unchanged, unless it is a pose.
  void load(Source& source);
};

using Views = std::span<const View>;

/// A view straight down from (x, y, z) [m]: camera x = world x, camera y = -world y.
inline View nadir(double x_m, double y_m, double z_m) {
  View v;
  v.T_W_C.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  v.T_W_C.translation() << x_m, y_m, z_m;
  return v;
}

/// A view from `eye` towards `target` [m] whose image is upright (world z up; looking along z, up is world y).
inline View look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  Eigen::Vector3d forward = target - eye;
  if (!(forward.norm() > 0)) throw Error("look_at", "eye and target coincide or are not finite", "two distinct points");
  forward.normalize();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (forward.cross(up).norm() < 1e-9) up = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  View v;
  v.T_W_C.linear() << right, forward.cross(right), forward;
  v.T_W_C.translation() = eye;
  return v;
}

/// Straight-line distance between two views [m]; orientation does not count.
inline double distance_m(const View& a, const View& b) { return (a.position() - b.position()).norm(); }

/// Whether two views are taken from the same point, to a nanometre; orientation does not count.
inline bool same_place(const View& a, const View& b) { return distance_m(a, b) <= 1e-9; }

/// Whether a pose is finite and its linear part a rotation (to 1e-6): no shear, no scale, no mirror.
inline bool is_rigid(const Eigen::Isometry3d& pose) {
  if (!pose.matrix().allFinite()) return false;
  const Eigen::Vector3d x = pose.linear().col(0), y = pose.linear().col(1), z = pose.linear().col(2);
  const auto unit = [](const Eigen::Vector3d& v) { return std::abs(v.norm() - 1) <= 1e-6; };
  return unit(x) && unit(y) && unit(z) && std::abs(x.dot(y)) <= 1e-6 && (x.cross(y) - z).norm() <= 1e-6;
}

/// Throws Error unless the view's pose is_rigid.
inline void check_view(const View& view, std::string_view where) {
  if (!view.T_W_C.matrix().allFinite()) throw Error(where, "the view's pose is not finite", "finite coefficients");
  if (!is_rigid(view.T_W_C))
    throw Error(where, "the view's pose is no rigid transform", "a rotation with determinant 1");
}

inline void View::load(Source& source) {
  Eigen::MatrixXd pose;
  source.get(pose);
  if (pose.rows() != 4 || pose.cols() != 4) throw Error(source.where(), "a pose of another size", "4 x 4");
  View v;
  v.T_W_C.matrix() = pose;
  check_view(v, source.where());
  *this = v;
}

inline void save_views(Sink& sink, Views views) {
  sink.put(static_cast<std::uint64_t>(views.size()));
  for (const View& v : views) v.save(sink);
}
/// What save_views wrote. Throws Error unless all are poses.
inline std::vector<View> load_views(Source& source) {
  const auto n = source.get<std::uint64_t>();
  if (n > source.left() / sizeof(Eigen::Matrix4d))
    throw Error(source.where(), concat(n, " views"), "no more than the bytes that are left hold");
  std::vector<View> views(static_cast<std::size_t>(n));
  for (View& v : views) v.load(source);
  return views;
}

}  // namespace vantage

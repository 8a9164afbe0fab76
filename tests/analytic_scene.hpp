// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <vantage/geometry/box.hpp>
#include <vantage/geometry/frame.hpp>

// Surfaces of which every ray's depth is known in closed form, and frames of them. A surface is called with a ray
// (from, direction) and gives the least t > 0 at which from + t direction lies on it, or infinity.
namespace vantage::test {

inline constexpr double nowhere = std::numeric_limits<double>::infinity();

struct Sphere {
  Eigen::Vector3d centre;
  double radius_m = 1;
  double operator()(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d o = from - centre;
    const double a = direction.squaredNorm(), b = o.dot(direction), c = o.squaredNorm() - radius_m * radius_m;
    const double root = b * b - a * c;
    if (root < 0) return nowhere;
    const double near = (-b - std::sqrt(root)) / a, far = (-b + std::sqrt(root)) / a;
    return near > 0 ? near : far > 0 ? far : nowhere;
  }
};

/// Seen from outside or, as a room, from inside.
struct Cuboid {
  Box3 box;
  double operator()(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    const Eigen::Array3d inverse = direction.array().inverse();
    const Eigen::Array3d a = (box.min() - from).array() * inverse, b = (box.max() - from).array() * inverse;
    const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
    if (enter > leave || leave <= 0) return nowhere;
    return enter > 0 ? enter : leave;
  }
};

/// The points with normal . x = offset.
struct Plane {
  Eigen::Vector3d normal;
  double offset_m = 0;
  double operator()(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    const double t = (offset_m - normal.dot(from)) / normal.dot(direction);
    return t > 0 ? t : nowhere;
  }
};

/// The nearest of several surfaces.
template <class... S>
auto all_of(S... surface) {
  return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
    double t = nowhere;
    ((t = std::min(t, surface(from, direction))), ...);
    return t;
  };
}

/// Depth without noise, no value beyond `far_m`; the colour is where the surface point lies in `coloured`.
template <class S>
Frame observe(const S& surface, const View& view, const Camera& camera, const Box3& coloured, double far_m = 10) {
  Frame f;
  f.camera = camera;
  f.view = view;
  f.depth.resize(camera.height, camera.width);
  f.colour.resize(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d direction = view.T_W_C.linear() * camera.ray(u + 0.5, v + 0.5);  // camera z = 1
      const double z = surface(view.position(), direction);
      f.depth(v, u) = z <= far_m ? static_cast<float>(z) : std::numeric_limits<float>::quiet_NaN();
      Eigen::Array3d c = Eigen::Array3d::Zero();
      if (z <= far_m)
        c = ((view.position() + z * direction - coloured.min()).array() / coloured.sizes().array()).max(0).min(1);
      f.colour.r(v, u) = static_cast<float>(c.x());
      f.colour.g(v, u) = static_cast<float>(c.y());
      f.colour.b(v, u) = static_cast<float>(c.z());
    }
  return f;
}

}  // namespace vantage::test

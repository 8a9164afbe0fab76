// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/maps/surfel/rasteriser.hpp>

namespace bench {

/// A flat piece of a room: a corner and two sides [m], seen from the side to which u x v points.
struct Panel {
  Eigen::Vector3d corner, u, v;
  Eigen::Vector3d colour;
  [[nodiscard]] double area() const { return u.cross(v).norm(); }
};

/// A furnished room of 6 x 5 x 2.6 m: two cupboards, a table, a bed, a sofa and a chest. 158 m^2 of surface, the sides
/// that nobody sees included, so that 300 k surfels are one every 2.3 cm: about as the mapping step spawns them.
inline std::vector<Panel> room_panels() {
  using Eigen::Vector3d;
  std::vector<Panel> panels;
  const auto box = [&](const Vector3d& low, const Vector3d& high, bool inside, const Vector3d& colour) {
    const Vector3d d = high - low, x(d.x(), 0, 0), y(0, d.y(), 0), z(0, 0, d.z());
    const auto side = [&](const Vector3d& corner, const Vector3d& u, const Vector3d& v) {
      panels.push_back({corner, inside ? v : u, inside ? u : v, colour});
    };
    side(low, y, x);
    side(low + z, x, y);
    side(low, x, z);
    side(low + y, z, x);
    side(low, z, y);
    side(low + x, y, z);
  };
  box({0, 0, 0}, {6, 5, 2.6}, true, {0.8, 0.8, 0.7});
  box({0.1, 3.2, 0}, {0.7, 4.8, 2.0}, false, {0.5, 0.3, 0.2});
  box({5.4, 0.3, 0}, {5.9, 1.5, 2.1}, false, {0.6, 0.4, 0.3});
  box({2.6, 1.9, 0.7}, {3.8, 2.7, 0.75}, false, {0.7, 0.5, 0.3});
  box({3.7, 3.2, 0}, {5.8, 4.8, 0.5}, false, {0.3, 0.6, 0.3});
  box({1.4, 4.2, 0}, {2.9, 4.9, 0.8}, false, {0.2, 0.4, 0.6});
  box({0.2, 0.2, 0}, {1.2, 0.8, 0.9}, false, {0.6, 0.6, 0.2});
  return panels;
}

/// n surfels spread evenly over the panels in the order in which a scan of each would meet them, sigma about
/// `sigma_m`, trained to opacities of 0.5 to 0.99.
inline vantage::Surfels room_surfels(std::size_t n, double sigma_m = 0.01, std::uint64_t seed = 1) {
  using namespace vantage;
  const std::vector<Panel> panels = room_panels();
  double area = 0;
  for (const Panel& p : panels) area += p.area();
  Rng rng(seed);
  Surfels s;
  s.scale = {0.01F, 0.05F};
  double owed = 0;
  for (const Panel& p : panels) {
    owed += static_cast<double>(n) * p.area() / area;
    const double spacing = std::sqrt(area / static_cast<double>(n));
    const Eigen::Vector3d normal = p.u.cross(p.v).normalized();
    const Eigen::Quaterniond along = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
    const int columns = std::max(1, static_cast<int>(p.u.norm() / spacing));
    const int here = static_cast<int>(owed);
    owed -= here;
    const int rows = (here + columns - 1) / columns;
    for (int k = 0; k < here; ++k) {
      const double a = (k % columns + rng.uniform()) / columns, b = (k / columns + rng.uniform()) / rows;
      const Eigen::Vector3d x = p.corner + a * p.u + b * p.v + 0.002 * rng.normal() * normal;
      const Eigen::Vector3d tilt(0.05 * rng.normal(), 0.05 * rng.normal(), rng.uniform(-3.1, 3.1));
      const Eigen::Quaterniond q =
          along * Eigen::AngleAxisd(tilt.z(), Eigen::Vector3d::UnitZ()) * Eigen::Quaterniond(1, tilt.x(), tilt.y(), 0);
      const auto number = [](double v) { return static_cast<float>(v); };
      const auto log_scale = [&] { return number(std::log(sigma_m / 0.01) + 0.25 * rng.normal()); };
      const double shade = rng.uniform(0.8, 1);
      Surfel one;
      one.parameter = {number(x.x()),
                       number(x.y()),
                       number(x.z()),
                       number(q.w()),
                       number(q.x()),
                       number(q.y()),
                       number(q.z()),
                       log_scale(),
                       log_scale(),
                       number(shade * p.colour.x()),
                       number(shade * p.colour.y()),
                       number(shade * p.colour.z()),
                       number(rng.uniform(0, 4.5))};
      one.confidence = number(rng.uniform());
      s.push_back(one);
    }
  }
  return s;
}

/// From the middle of the room to a wall with furniture, 60 degrees.
inline vantage::RasterView room_view(int pixels) {
  vantage::RasterView v;
  v.view = vantage::look_at({2.2, 2.4, 1.5}, {1.9, 5.0, 0.8});
  v.camera = vantage::Camera::from_fov(pixels, pixels, vantage::deg(60));
  return v;
}

}  // namespace bench

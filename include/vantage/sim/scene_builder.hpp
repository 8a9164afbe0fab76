// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/geometry/scene.hpp>

namespace vantage {

/// Puts a scene together from solids: boxes, turned and round things, each closed, counter-clockwise from outside.
///
/// Solids are given in the frame `pose` (identity at first) and take `label`. Textures lie flat on them, `repeat_m` of
/// surface to a repetition. No edge of a flat face is longer than `edge_m`.
class SceneBuilder {
 public:
  /// A surface: which material, and how much of it one repetition of its texture covers (0: the whole face, once).
  struct Look {
    std::uint32_t material = 0;
    double repeat_m = 1;
  };
  /// `edge_m` > 0: longest edge of a triangle along a flat face; infinite: two triangles a face.
  explicit SceneBuilder(double edge_m = std::numeric_limits<double>::infinity()) : edge_m_(edge_m) {
    Check check("SceneBuilder");
    check(edge_m > 0, "edge_m", edge_m, "> 0");
    check.done();
    scene_.materials.clear();
  }

  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< solids to world
  std::uint16_t label = 0;

  std::uint16_t class_of(const std::string& name) { return scene_.class_of(name); }
  Look plain(const std::string& name, const Eigen::Vector3f& colour) {
    scene_.materials.push_back({name, colour, std::nullopt});
    return {static_cast<std::uint32_t>(scene_.materials.size() - 1), 1};
  }
  Look textured(const std::string& name, Texture texture, double repeat_m) {
    scene_.textures.push_back(std::move(texture));
    scene_.materials.push_back({name, Eigen::Vector3f::Ones(), static_cast<std::uint32_t>(scene_.textures.size() - 1)});
    return {static_cast<std::uint32_t>(scene_.materials.size() - 1), repeat_m};
  }

  /// The parallelogram origin, origin + a, origin + a + b, origin + b [m], counter-clockwise; u runs along a, v along
  /// b.
  void quad(const Eigen::Vector3d& origin, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Look& look) {
    const Eigen::Vector2d size(a.norm(), b.norm());
    const Eigen::Vector2d repeats = look.repeat_m > 0 ? Eigen::Vector2d(size / look.repeat_m) : Eigen::Vector2d::Ones();
    grid(
        pieces(size.x()), pieces(size.y()), look,
        [&](double s, double t) { return Eigen::Vector3d(origin + s * a + t * b); },
        [&](double s, double t) { return Eigen::Vector2d(s * repeats.x(), t * repeats.y()); });
  }
  /// The box [low, high] [m]. Textures run along the longer side of each face, as wood grows; those that cover a whole
  /// face stand upright.
  void box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const Look& look) {
    const Eigen::Vector3d size = high - low, x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
    const auto face = [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      if (look.repeat_m > 0 && b.norm() > a.norm())
        quad(origin + a, b, -a, look);
      else
        quad(origin, a, b, look);
    };
    face(low, x, z);           // y = low, seen from -y
    face(low + x, y, z);       // x = high
    face(low + x + y, -x, z);  // y = high
    face(low + y, -y, z);      // x = low
    face(low + z, x, y);       // top
    face(low + y, x, -y);      // underside
  }
  /// The solid that a polygon (radius, height) [m], from the lowest point on the axis to the highest, describes about
  /// the vertical line through `base`. Radii >= 0; a first or last radius above 0 is closed by a disc.
  template <std::size_t N>
  void turned(const Eigen::Vector3d& base, const std::array<Eigen::Vector2d, N>& profile, const Look& look) {
    double widest = 0;
    for (const Eigen::Vector2d& p : profile) widest = std::max(widest, p.x());
    const double around = 2 * std::numbers::pi;
    const std::size_t segments = std::clamp<std::size_t>(pieces(around * widest), 16, 256);
    const auto ring = [&](const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
      const Eigen::Vector2d step = high - low;
      const double length = step.norm();
      if (!(length > 0)) return;
      const double repeat = look.repeat_m > 0 ? look.repeat_m : length;
      const double turns = look.repeat_m > 0 ? std::max(1.0, std::round(around * widest / repeat)) : 1;  // no seam
      grid(
          segments, pieces(length), look,
          [&](double s, double t) {
            const Eigen::Vector2d p = low + t * step;
            return Eigen::Vector3d(base +
                                   Eigen::Vector3d(p.x() * std::cos(around * s), p.x() * std::sin(around * s), p.y()));
          },
          [&](double s, double t) { return Eigen::Vector2d(s * turns, t * length / repeat); });
    };
    ring({0, profile.front().y()}, profile.front());
    for (std::size_t i = 0; i + 1 < N; ++i) ring(profile[i], profile[i + 1]);
    ring(profile.back(), {0, profile.back().y()});
  }
  /// A vertical cylinder or cone frustum [m].
  void cylinder(const Eigen::Vector3d& base, double radius_m, double top_radius_m, double height_m, const Look& look) {
    turned(base, std::array<Eigen::Vector2d, 2>{{{radius_m, 0}, {top_radius_m, height_m}}}, look);
  }
  /// An ellipsoid with these half axes [m].
  void ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& half, const Look& look) {
    const double around = 2 * std::numbers::pi, largest = half.maxCoeff();
    const std::size_t segments = std::clamp<std::size_t>(pieces(around * largest), 16, 256);
    const double repeat = look.repeat_m > 0 ? look.repeat_m : around * largest;
    const double turns = std::max(1.0, std::round(around * largest / repeat));
    grid(
        segments, segments / 2, look,
        [&](double s, double t) {
          const double phi = around * s, theta = std::numbers::pi * (t - 0.5);
          return Eigen::Vector3d(centre +
                                 half.cwiseProduct(Eigen::Vector3d(std::cos(theta) * std::cos(phi),
                                                                   std::cos(theta) * std::sin(phi), std::sin(theta))));
        },
        [&](double s, double t) { return Eigen::Vector2d(s * turns, t * turns / 2); });
  }

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] Scene take() && { return std::move(scene_); }

 private:
  [[nodiscard]] std::size_t pieces(double length_m) const {
    return static_cast<std::size_t>(std::clamp(std::ceil(length_m / edge_m_), 1.0, 4096.0));
  }
  /// columns x rows quadrilaterals of place(s, t), (s, t) in [0, 1]^2; those without an area are left out.
  template <class Place, class Uv>
  void grid(std::size_t columns, std::size_t rows, const Look& look, Place&& place, Uv&& uv) {
    const auto first = static_cast<std::uint32_t>(scene_.mesh.vertices.size());
    const auto at = [&](std::size_t i, std::size_t j) {
      return std::pair(static_cast<double>(i) / static_cast<double>(columns),
                       static_cast<double>(j) / static_cast<double>(rows));
    };
    for (std::size_t j = 0; j <= rows; ++j)
      for (std::size_t i = 0; i <= columns; ++i) {
        const auto [s, t] = at(i % columns == 0 && closes(place) ? 0 : i, j);
        scene_.mesh.vertices.push_back((pose * place(s, t)).template cast<float>());
      }
    const auto stride = static_cast<std::uint32_t>(columns + 1);
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i) {
        const std::uint32_t a = first + static_cast<std::uint32_t>(j) * stride + static_cast<std::uint32_t>(i),
                            b = a + 1, c = b + stride, d = a + stride;
        const auto corner = [&](std::size_t di, std::size_t dj) -> Eigen::Vector2f {
          const auto [s, t] = at(i + di, j + dj);
          return uv(s, t).template cast<float>();
        };
        triangle({a, b, c}, {corner(0, 0), corner(1, 0), corner(1, 1)}, look);
        triangle({a, c, d}, {corner(0, 0), corner(1, 1), corner(0, 1)}, look);
      }
  }
  /// Whether the grid's last column is its first one.
  template <class Place>
  static bool closes(Place&& place) {
    return (place(0.0, 0.5) - place(1.0, 0.5)).norm() < 1e-9;
  }
  void triangle(const std::array<std::uint32_t, 3>& corners, const std::array<Eigen::Vector2f, 3>& uv,
                const Look& look) {
    const auto& v = scene_.mesh.vertices;
    if (v[corners[0]] == v[corners[1]] || v[corners[1]] == v[corners[2]] || v[corners[2]] == v[corners[0]]) return;
    scene_.mesh.triangles.push_back(corners);
    scene_.uv.push_back(uv);
    scene_.material.push_back(look.material);
    scene_.label.push_back(label);
  }

  double edge_m_;
  Scene scene_;
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <vantage/eval/nearest_points.hpp>
#include <vantage/eval/reachable_space.hpp>
#include <vantage/eval/surface_coverage.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/mesh_sampling.hpp>
#include <vantage/sim/ray_scene.hpp>

#include "options.hpp"

// Where a robot can be in a scene, and what can be seen from there.
namespace scene {

/// Whether nothing lies between two points; surfaces that hold one of them do not count.
struct Unoccluded {
  const RayScene& rays;
  bool operator()(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const double distance_m = (to - from).norm();
    return !rays.occluded({from, (to - from) / distance_m, 0, distance_m - 1e-3});
  }
};

/// The share of all directions in which nothing lies: near 0 in a room, a half and more outside.
inline double open_sky(const RayScene& rays, const Eigen::Vector3d& from) {
  constexpr int count = 500;  // evenly over the sphere (Fibonacci's spiral)
  int open = 0;
  for (int i = 0; i < count; ++i) {
    const double z = (2 * i + 1.0) / count - 1, r = std::sqrt(1 - z * z),
                 turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    open += rays.occluded({from, {r * std::cos(turn), r * std::sin(turn), z}}) ? 0 : 1;
  }
  return static_cast<double>(open) / count;
}

/// Between the positions that are asked.
inline double spacing_m(const Options& o) { return std::clamp(o.body_radius_m, 0.05, 0.25); }

/// Everywhere that the robot's body reaches from the start, if it is free there.
inline std::vector<Eigen::Vector3d> free_positions(const Scene& scene, const Eigen::Vector3d& start, const Options& o) {
  const SurfaceSamples samples = sample_surface(scene.mesh, 200'000, Rng(o.seed).fork(10));
  const NearestPoints nearest(samples.points);
  const auto is_free = [&](const Eigen::Vector3d& p) {
    return static_cast<double>(nearest(p.cast<float>()).distance_m) >= o.body_radius_m;
  };
  return reachable_positions(scene.mesh.bounds(), spacing_m(o), start, is_free);
}

/// The part of the surface that can be seen from some of the positions. Not more than 1500 of them are asked, spread
/// evenly.
inline SurfaceSamples seen_from(const Scene& scene, const RayScene& rays, const std::vector<Eigen::Vector3d>& positions,
                                const Options& o) {
  const SurfaceSamples all = sample_surface(scene.mesh, 50'000, Rng(o.seed).fork(11));
  std::vector<Eigen::Vector3d> asked;
  const std::size_t stride = positions.size() / 1500 + 1;
  for (std::size_t i = 0; i < positions.size(); i += stride) asked.push_back(positions[i]);
  return all.where(visible_surface(all, asked, {.far_m = o.range_m}, Unoccluded{rays}));
}

/// Which of the surface that can be seen was seen: by a camera that had it in its image, in range, and nothing between.
class SeenSurface {
 public:
  SeenSurface(SurfaceSamples surface, RayScene rays, double range_m)
      : coverage_(std::move(surface)), rays_(std::move(rays)), range_m_(range_m) {}

  void add(const Frame& frame) { coverage_.add(frame.view, frame.camera, {.far_m = range_m_}, Unoccluded{rays_}); }
  [[nodiscard]] double share() const { return coverage_.coverage(); }
  [[nodiscard]] const SurfaceSamples& surface() const { return coverage_.surface(); }
  [[nodiscard]] const std::vector<std::uint8_t>& seen() const { return coverage_.seen(); }  ///< of each point: 1 or 0

 private:
  SurfaceCoverage coverage_;
  RayScene rays_;
  double range_m_;
};

}  // namespace scene

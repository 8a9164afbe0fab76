// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/colour_image.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/marching_cubes.hpp>
#include <vantage/geometry/mesh_components.hpp>
#include <vantage/geometry/triangle_mesh.hpp>
#include <vantage/geometry/tsdf.hpp>

namespace vantage {

struct SurfelMeshConfig {
  double voxel_m = 0.02;                         ///< of the volume in which renderings are fused, > 0
  double truncation_m = 0.10;                    ///< of its distances, >= voxel_m
  double least_opacity = 0.5;                    ///< a pixel with no more than this shows no surface, [0, 1)
  std::size_t least_triangles = 50;              ///< connected parts of fewer are left out
  std::size_t max_bytes = std::size_t{4} << 30;  ///< of the volume

  void validate() const {
    Check check("SurfelMeshConfig");
    check.positive("voxel_m", voxel_m);
    check.positive("truncation_m", truncation_m);
    check(least_opacity >= 0 && least_opacity < 1, "least_opacity", least_opacity, "in [0, 1)");
    check.done();
  }
};

/// The surface of a surfel map within `bounds` [m], as chapter 6 evaluates it (section 6.2.1): depth and colour
/// rendered where the map's frames were taken (`frames()`, each with a view and a camera), where they are opaque, fused
/// into a Tsdf that reaches a truncation beyond the bounds, so that what lies on them has two sides; marching cubes,
/// without crumbs. Coloured; empty if nothing is opaque. Throws Error for a bad config or bounds, or too little memory.
/// Cost: one rendering a frame, and what Tsdf and marching_cubes take.
template <Renders<channel::Colour, channel::Depth, channel::Opacity> M>
requires requires(const M& m) { m.frames(); }
TriangleMesh surfel_mesh(const M& map, const Box3& bounds, const SurfelMeshConfig& config = {}) {
  config.validate();
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(config.truncation_m);
  Tsdf volume({.bounds = Box3(bounds.min() - margin, bounds.max() + margin),
               .voxel_m = config.voxel_m,
               .truncation_m = config.truncation_m,
               .max_bytes = config.max_bytes});
  const auto least = static_cast<float>(config.least_opacity);
  for (const auto& taken : map.frames()) {
    Rendering<channel::Colour, channel::Depth, channel::Opacity> image;
    map.render(taken.view, taken.camera, image);
    const ColourImage& colour = image;
    Frame frame{.camera = taken.camera, .view = taken.view, .colour = colour, .depth = {}, .labels = {}};
    frame.depth = (image.opacity > least).select(image.depth, std::numeric_limits<float>::quiet_NaN());
    if (!frame.depth.isNaN().all()) volume.integrate(frame);
  }
  return without_small_components(marching_cubes(volume), config.least_triangles);
}

}  // namespace vantage

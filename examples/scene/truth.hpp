// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

#include <vantage/eval/mesh_metrics.hpp>
#include <vantage/geometry/triangle_mesh.hpp>
#include <vantage/mission/canvas.hpp>

#include "input.hpp"

// Results beside the true scene.
namespace scene {

/// A reconstructed mesh against the surface that can be seen.
inline MeshMetrics against_truth(const TriangleMesh& mesh, const Input& input, double threshold_m) {
  return mesh_metrics(mesh, input.scene->mesh, input.surface, {.threshold_m = threshold_m, .samples = 200'000}, Rng(1));
}

/// From above: surface that was seen (grey) and that was not (red); without floor and ceiling, which hide the rest.
inline void draw_seen(Canvas& canvas, const SeenSurface& truth, const Box3& bounds) {
  const double floor_m = bounds.min().z() + 0.1, ceiling_m = bounds.max().z() - 0.3;
  const SurfaceSamples& surface = truth.surface();
  for (const bool seen : {true, false})
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const Eigen::Vector3d p = surface.points[i].cast<double>();
      if ((truth.seen()[i] != 0) != seen || p.z() < floor_m || p.z() > ceiling_m) continue;
      canvas.dot(p.head<2>(), 1.1, seen ? Rgb{120, 128, 136} : Rgb{214, 69, 61}, seen ? 0.25 : 0.7);
    }
}

}  // namespace scene

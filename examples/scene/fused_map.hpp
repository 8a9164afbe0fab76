// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <limits>
#include <optional>
#include <utility>

#include <vantage/core/rng.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/marching_cubes.hpp>
#include <vantage/geometry/mesh_components.hpp>
#include <vantage/geometry/tsdf.hpp>

#include "visible_space.hpp"

namespace scene {

using namespace vantage;

/// The volume in which a scene is fused: its bounds, and enough around them that what lies on them has two sides.
inline Tsdf::Config around(const Box3& bounds, double voxel_m, bool colour = true) {
  const double truncation_m = 5 * voxel_m;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(truncation_m);
  return {.bounds = Box3(bounds.min() - margin, bounds.max() + margin),
          .voxel_m = voxel_m,
          .truncation_m = truncation_m,
          .colour = colour};
}

/// The map of a look-around: all depth fused, and which part of the true surface that was. It learns nothing that a
/// utility could ask for; chapter 6's map does.
class FusedMap {
 public:
  using Measurement = Frame;

  FusedMap(const Tsdf::Config& config, std::optional<SeenSurface> truth) : volume_(config), truth_(std::move(truth)) {}

  void integrate(const Frame& frame, Rng& rng) {
    volume_.integrate(frame, rng);
    if (truth_) truth_->add(frame);
  }
  [[nodiscard]] Box3 bounds() const { return volume_.bounds(); }
  [[nodiscard]] const Tsdf& volume() const { return volume_; }
  [[nodiscard]] const std::optional<SeenSurface>& truth() const { return truth_; }
  /// The surface so far, without the crumbs that noise makes.
  [[nodiscard]] TriangleMesh mesh() const { return without_small_components(marching_cubes(volume_)); }

 private:
  Tsdf volume_;
  std::optional<SeenSurface> truth_;
};

}  // namespace scene

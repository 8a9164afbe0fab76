// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// How uncertain the map is of what is where along the rays of a view (eq. 5.12, divided by the number of rays):
///
///     psi(v) = mean over rays of H_ray,    H_ray = sum over points of T H(o)
///
/// with o the probability that a point is occupied, H(o) its entropy and T the chance that the ray gets there
/// (eq. 5.10, 5.11); with voxels for points it is the occlusion-aware gain of Isler et al., ICRA 2016. The map renders
/// H_ray. [nats]. Cost: one rendering a view.
class RayEntropy {
 public:
  using MapNeeds = Needs<need::Channels<channel::Entropy>>;

  RayEntropy() : RayEntropy(Camera::from_fov(128, 128, deg(60))) {}
  /// Throws Error unless the camera is valid.
  explicit RayEntropy(const Camera& camera) : camera_(camera) { camera_.validate(); }

  template <Renders<channel::Entropy> M>
  double operator()(const M& map, const View& view) const {
    Rendering<channel::Entropy> image;
    map.render(view, camera_, image);
    return image.entropy.template cast<double>().mean();
  }
  [[nodiscard]] const Camera& camera() const { return camera_; }

 private:
  Camera camera_;
};

}  // namespace vantage

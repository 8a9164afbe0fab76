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

/// How much of the map's entropy a measurement from a view is expected to take away, a ray:
///
///     psi(v) = mean over rays of E_z[H(map) - H(map | z)]
///
/// the expectation over where the ray ends, by the map's own belief and its own model of the sensor, which is what the
/// map renders (channel::InformationGain). Rays count as independent, as in Isler et al., "An information gain
/// formulation for active volumetric 3D reconstruction", ICRA 2016. [nats]. Cost: one rendering a view.
class InformationGain {
 public:
  using MapNeeds = Needs<need::Channels<channel::InformationGain>>;

  InformationGain() : InformationGain(Camera::from_fov(128, 128, deg(60))) {}
  /// Throws Error unless the camera is valid.
  explicit InformationGain(const Camera& camera) : camera_(camera) { camera_.validate(); }

  template <Renders<channel::InformationGain> M>
  double operator()(const M& map, const View& view) const {
    Rendering<channel::InformationGain> image;
    map.render(view, camera_, image);
    return image.information_gain.template cast<double>().mean();
  }
  [[nodiscard]] const Camera& camera() const { return camera_; }

 private:
  Camera camera_;
};

}  // namespace vantage

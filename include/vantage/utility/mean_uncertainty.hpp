// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>

namespace vantage {

/// How uncertain the map is of what it would see, averaged over the image (eq. 4.3):
///
///     psi(v) = mean over pixels of U_v
///
/// Works with every map: rendering uncertainty is what they all share. In the unit of the map's uncertainty. Cost: one
/// rendering a view, so a small camera pays.
class MeanUncertainty {
 public:
  using MapNeeds = Needs<need::Uncertainty>;

  MeanUncertainty() : MeanUncertainty(Camera::from_fov(60, 60, deg(60))) {}
  /// Throws Error unless the camera is valid.
  explicit MeanUncertainty(const Camera& camera) : camera_(camera) { camera_.validate(); }

  template <UncertainMap M>
  double operator()(const M& map, const View& view) const {
    Rendering<channel::Uncertainty> image;
    map.render(view, camera_, image);
    return image.uncertainty.template cast<double>().mean();
  }
  [[nodiscard]] const Camera& camera() const { return camera_; }

 private:
  Camera camera_;
};

}  // namespace vantage

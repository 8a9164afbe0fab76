// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// A utility that is the mean over the image of what the map draws in one channel, in the channel's unit. Cost: one
/// rendering a view, so a small camera pays.
template <class Channel, Image<float> Channel::*pixels>
class MeanOfChannel {
 public:
  using MapNeeds = Needs<need::Channels<Channel>>;

  /// Throws Error unless the camera is valid.
  explicit MeanOfChannel(const Camera& camera) : camera_(camera) { camera_.validate(); }

  template <Renders<Channel> M>
  double operator()(const M& map, const View& view) const {
    Rendering<Channel> image;
    map.render(view, camera_, image);
    return (image.*pixels).template cast<double>().mean();
  }
  [[nodiscard]] const Camera& camera() const { return camera_; }

 private:
  Camera camera_;
};

}  // namespace vantage

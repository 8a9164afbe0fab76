// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <vantage/concepts/channels.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/sim/gaussian_pixels.hpp>
#include <vantage/sim/scene_renderer.hpp>

namespace vantage {

/// What a camera makes of what is there. The default is the camera of ch. 6: 512 x 512 px, 60 deg, depth to 5 m with a
/// deviation of a hundredth of it.
struct RgbdConfig {
  Camera camera = Camera::from_fov(512, 512, deg(60));
  double depth_noise = 0.01;  ///< standard deviation of a depth, in depths; >= 0
  double min_depth_m = 0;     ///< readings must be above; >= 0
  double max_depth_m = 5;     ///< readings above have no value; may be infinite
  double colour_noise = 0;    ///< standard deviation of a colour, of each channel; >= 0
  SceneRendererConfig renderer = {};

  /// The camera of ch. 4: 400 x 400 px, f = 400 px, colours with a deviation of 2/255, black background.
  static RgbdConfig image_based() {
    return {.camera = {400, 400, 400, 400, 200, 200},
            .depth_noise = 0,
            .max_depth_m = std::numeric_limits<double>::infinity(),
            .colour_noise = 2.0 / 255,
            .renderer = {.lighting = Lighting::object()}};
  }
  /// The camera of ch. 5: 400 x 400 px, 1 rad, exact, white background.
  static RgbdConfig semantic() {
    return {.camera = Camera::from_fov(400, 400, 1.0),
            .depth_noise = 0,
            .max_depth_m = std::numeric_limits<double>::infinity(),
            .renderer = {.lighting = Lighting::object(), .background = Eigen::Vector3f::Ones()}};
  }
  void validate() const {
    camera.validate();
    Check check("RgbdConfig");
    check.not_negative("depth_noise", depth_noise);
    check.not_negative("min_depth_m", min_depth_m);
    check(max_depth_m > min_depth_m, "max_depth_m", max_depth_m, "above min_depth_m");
    check.not_negative("colour_noise", colour_noise);
    check.done();
  }
};

/// A simulated RGB-D camera that also knows the class of what it sees.
///
/// Depth is camera z with zero-mean Gaussian noise that grows with it; a reading out of range, and a pixel that sees
/// nothing, is NaN. Colours get Gaussian noise and are clamped to [0, 1]; labels are exact. The noise is a function of
/// (stream, pose): the same view gives the same bytes, whoever looks in between, with any number of threads. Const
/// members run concurrently.
class RgbdCamera {
 public:
  using Config = RgbdConfig;

  /// Throws Error as SceneRenderer does, and for a bad configuration.
  explicit RgbdCamera(const Scene& scene, const Config& config = {})
      : config_((config.validate(), config)), renderer_(scene, config.renderer) {}

  /// What it sees from `view`, with noise from the fork of `stream` that the pose names. Throws Error for a view that
  /// is not finite or no rigid transform. O(pixels).
  [[nodiscard]] Frame capture(const View& view, const Rng& stream) const {
    Frame frame;
    capture(view, stream, frame);
    return frame;
  }
  /// The same into a frame whose images are used again.
  void capture(const View& view, const Rng& stream, Frame& frame) const;

  [[nodiscard]] const Config& config() const { return config_; }
  [[nodiscard]] const SceneRenderer& renderer() const { return renderer_; }

 private:
  static std::uint64_t bits_of(const View& view) {
    std::array<double, 12> pose;  // + 0.0: minus zero is zero
    for (Eigen::Index k = 0; k < 12; ++k) pose[static_cast<std::size_t>(k)] = view.T_W_C.matrix()(k % 3, k / 3) + 0.0;
    return fnv1a(std::as_bytes(std::span(pose)));
  }
  Config config_;
  SceneRenderer renderer_;
};

inline void RgbdCamera::capture(const View& view, const Rng& stream, Frame& frame) const {
  Rendering<channel::Colour, channel::Depth, channel::Labels> seen;
  ColourImage& colour = seen;
  std::swap(colour, frame.colour);
  seen.depth.swap(frame.depth);
  seen.labels.swap(frame.labels);
  renderer_.render(view, config_.camera, seen);
  frame.camera = config_.camera;
  frame.view = view;
  std::swap(colour, frame.colour);
  frame.depth.swap(seen.depth);
  frame.labels.swap(seen.labels);

  const GaussianPixels noise(stream.fork(bits_of(view)));
  const auto low = static_cast<float>(config_.min_depth_m), high = static_cast<float>(config_.max_depth_m);
  const auto depth_noise = static_cast<float>(config_.depth_noise),
             colour_noise = static_cast<float>(config_.colour_noise);
  parallel_for_blocks(static_cast<std::size_t>(config_.camera.height), 16, [&](std::size_t begin, std::size_t end) {
    Eigen::ArrayXf normal = Eigen::ArrayXf::Zero(config_.camera.width);
    const auto draw = [&](std::size_t row, std::uint32_t channel) {
      noise.normals(static_cast<std::uint32_t>(row), channel, {normal.data(), static_cast<std::size_t>(normal.size())});
    };
    for (std::size_t row = begin; row < end; ++row) {
      auto depth = frame.depth.row(static_cast<Eigen::Index>(row)).transpose();
      if (depth_noise > 0) {
        draw(row, 0);
        depth *= 1 + depth_noise * normal;
      }
      depth = (depth > low && depth <= high).select(depth, std::numeric_limits<float>::quiet_NaN());
      if (!(colour_noise > 0)) continue;
      std::uint32_t channel = 0;
      for (Image<float>* plane : {&frame.colour.r, &frame.colour.g, &frame.colour.b}) {
        draw(row, ++channel);
        auto values = plane->row(static_cast<Eigen::Index>(row)).transpose();
        values = (values + colour_noise * normal).max(0.F).min(1.F);
      }
    }
  });
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// A frame to train on. Colours are kept as 8 bits (off by 1/510 at most), depths as they were measured: 7 bytes a
/// pixel.
class TrainingFrame {
 public:
  static constexpr double unseen_error = 10;  ///< of a frame that was not trained on yet

  TrainingFrame() = default;
  /// `frame` is valid and has colour and depth.
  explicit TrainingFrame(const Frame& frame) : camera(frame.camera), view(frame.view), metres(frame.depth) {
    const auto n = static_cast<std::size_t>(metres.size());
    levels_.resize(3 * n);
    std::uint8_t* to = levels_.data();
    for (const Image<float>* plane : {&frame.colour.r, &frame.colour.g, &frame.colour.b})
      for (std::size_t i = 0; i < n; ++i) *to++ = static_cast<std::uint8_t>(std::lrint(plane->data()[i] * 255.0F));
  }

  Camera camera;
  View view;
  Image<float> metres;          ///< depth, NaN = none
  double error = unseen_error;  ///< of colour and depth, when it was last trained on

  // As SurfelLoss reads a target.
  void colour(int channel, Eigen::Index row, float* out) const {
    const auto k = static_cast<Eigen::Index>(channel) * metres.rows() + row;
    const std::uint8_t* const from = levels_.data() + k * metres.cols();
    for (Eigen::Index u = 0; u < metres.cols(); ++u) out[u] = static_cast<float>(from[u]) * (1.0F / 255);
  }
  void depth(Eigen::Index row, float* out) const {
    const float* const from = metres.data() + row * metres.cols();
    for (Eigen::Index u = 0; u < metres.cols(); ++u) out[u] = from[u] > 0 ? from[u] : 0;
  }
  [[nodiscard]] std::size_t bytes() const {
    return sizeof *this + levels_.size() + static_cast<std::size_t>(metres.size()) * sizeof(float);
  }

  void save(Sink& sink) const {
    sink.put(camera.width), sink.put(camera.height);
    for (const double x : {camera.fx, camera.fy, camera.cx, camera.cy}) sink.put(x);
    for (Eigen::Index k = 0; k < 16; ++k) sink.put(view.T_W_C.matrix().data()[k]);
    sink.put(error);
    sink.put(levels_);
    sink.put(metres);
  }
  /// Throws Error unless it is a valid frame.
  void load(Source& source) {
    source.get(camera.width), source.get(camera.height);
    for (double* x : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) source.get(*x);
    for (Eigen::Index k = 0; k < 16; ++k) source.get(view.T_W_C.matrix().data()[k]);
    source.get(error);
    source.get(levels_);
    source.get(metres);
    camera.validate();
    check_view(view, source.where());
    const auto refuse = [&](const std::string& what, const std::string& expected) {
      throw Error(source.where(), concat("a training frame with ", what), expected);
    };
    if (metres.rows() != camera.height || metres.cols() != camera.width)
      refuse(concat(metres.cols(), " x ", metres.rows(), " depths"), concat(camera.width, " x ", camera.height));
    if (levels_.size() != 3 * static_cast<std::size_t>(metres.size()))
      refuse(concat(levels_.size(), " colours"), "three a pixel");
    if (!(error >= 0) || !std::isfinite(error)) refuse(concat("error ", error), "finite and >= 0");
    if (!(metres.isNaN() || (metres > 0 && metres <= std::numeric_limits<float>::max())).all())
      refuse("a bad depth", "finite and > 0 m, or NaN");
  }

 private:
  std::vector<std::uint8_t> levels_;  // red, then green, then blue
};

}  // namespace vantage

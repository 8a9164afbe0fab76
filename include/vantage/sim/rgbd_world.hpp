// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/sim/rgbd_camera.hpp>

namespace vantage {

/// A simulated RGB-D-semantic camera that is wherever it is asked to be: a World for the maps that read a Frame. The
/// noise is a function of (stream, pose), so that a mission resumed from a checkpoint sees the same bytes. Not shared
/// between threads.
class RgbdWorld {
 public:
  /// Throws what RgbdCamera throws.
  RgbdWorld(const Scene& scene, const Rng& rng, const RgbdConfig& config = {})
      : camera_(scene, rng, config), hash_(hash(scene, rng)) {}

  /// What the camera sees from `view`; always something, be it nothing but background. Throws Error for a view that is
  /// not finite or no rigid transform. O(pixels log triangles).
  std::optional<Frame> observe(const View& view) {
    std::optional<Frame> frame = camera_.capture(view);
    ++measurements_;
    return frame;
  }
  [[nodiscard]] const RgbdCamera& camera() const { return camera_; }
  /// Frames taken so far.
  [[nodiscard]] std::uint64_t measurements() const { return measurements_; }

  void save(Sink& sink) const {
    sink.put(hash_);
    sink.put(measurements_);
  }
  /// Throws Error if it was saved over another scene, or with other noise; the world is then unchanged.
  void load(Source& source) {
    if (source.get<std::uint64_t>() != hash_)
      throw Error(source.where(), "the world was saved over another scene", "the scene and seed of this mission");
    measurements_ = source.get<std::uint64_t>();
  }

 private:
  static std::uint64_t hash(const Scene& scene, const Rng& rng) {
    Sink sink;
    for (const std::uint64_t word : rng.state()) sink.put(word);
    sink.put(fnv1a(std::as_bytes(std::span(scene.mesh.vertices))));
    sink.put(fnv1a(std::as_bytes(std::span(scene.mesh.triangles))));
    return fnv1a(sink.bytes());
  }
  RgbdCamera camera_;
  std::uint64_t hash_, measurements_ = 0;
};

}  // namespace vantage

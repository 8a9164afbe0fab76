// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/sim/rgbd_camera.hpp>

namespace vantage {

/// A known scene seen by a simulated RGB-D camera: a World for the maps that read a Frame.
///
/// The noise of a measurement is a function of the world's stream and the pose, so that a mission resumed from a
/// checkpoint sees the same bytes. Scenes may be open: see RgbdCamera. Copies share what does not change. Not shared
/// between threads.
class RgbdWorld {
 public:
  using Config = RgbdConfig;

  /// Throws Error for a scene that is empty or does not fit together, and for a bad configuration.
  RgbdWorld(const Scene& scene, const Rng& rng, const Config& config = {}) : camera_(scene, config), rng_(rng) {
    const auto hash = [](const auto& items) { return fnv1a(std::as_bytes(std::span(items))); };
    const std::array<std::uint64_t, 3> parts = {hash(scene.mesh.vertices), hash(scene.mesh.triangles),
                                                hash(scene.label)};
    scene_hash_ = hash(parts);
  }

  [[nodiscard]] const RgbdCamera& camera() const { return camera_; }
  /// Images taken so far.
  [[nodiscard]] std::uint64_t measurements() const { return measurements_; }

  /// What the camera sees from `view`; always something. Throws Error for a view that is not finite or no rigid
  /// transform. O(pixels log triangles).
  std::optional<Frame> observe(const View& view) {
    Frame frame = camera_.capture(view, rng_);
    ++measurements_;
    return frame;
  }

  void save(Sink& sink) const {
    sink.put(scene_hash_);
    for (const std::uint64_t word : rng_.state()) sink.put(word);
    sink.put(measurements_);
  }
  /// Throws Error if it was saved over another scene; the world is then unchanged.
  void load(Source& source) {
    const auto hash = source.get<std::uint64_t>();
    if (hash != scene_hash_)
      throw Error(source.where(), "the world was saved over another scene", "the scene of this mission");
    const auto key = source.get<std::uint64_t>(), counter = source.get<std::uint64_t>();
    const auto measurements = source.get<std::uint64_t>();
    rng_ = Rng::restored({key, counter});
    measurements_ = measurements;
  }

 private:
  RgbdCamera camera_;
  Rng rng_;
  std::uint64_t measurements_ = 0, scene_hash_ = 0;
};

}  // namespace vantage

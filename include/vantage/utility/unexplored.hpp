// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/visible_voxels.hpp>
#include <vantage/utility/unexplored_voxels.hpp>

namespace vantage {

/// How much unexplored space a view would show, as the share of all voxels (ch. 6):
///
///     psi_V(v) = visible unexplored voxels / all voxels
///
/// A voxel is visible if its centre is in the image, in range, and nearer than the depth that the map renders there; a
/// pixel without depth sees as far as the range. Works with every map that renders depth and knows occupancy: the
/// voxels are those of the map if it has any, else of a grid over its bounds. Views already in the sequence have seen
/// what they see. In [0, 1]. Cost: one rendering a view (one a step of those given), and the
/// unexplored voxels in its frustum.
class Unexplored {
 public:
  using MapNeeds = Needs<need::Depth, need::Occupancy>;

  struct Config {
    Camera camera = Camera::from_fov(128, 128, deg(60));  ///< what is rendered
    double far_m = 5;                                     ///< range of the sensor, camera z; finite and > 0
    double voxel_m = 0.2;  ///< edge of a voxel, for maps that have none of their own; finite and > 0
  };

  Unexplored() : Unexplored(Config()) {}
  /// Throws Error naming every bad member.
  explicit Unexplored(const Config& config) : config_(config) {
    config.camera.validate();
    Check check("Unexplored::Config");
    check.positive("far_m", config.far_m);
    check.positive("voxel_m", config.voxel_m);
    check.done();
  }

  template <DepthMap M>
  requires OccupancyMap<M>
  auto prepare(const M& map, const Situation&, Rng) const {
    return [scene = std::make_shared<const Scene<M>>(config_, map)](Views given, Views views, std::span<double> out) {
      const auto count = scene->counts(given, views);
      for (std::size_t i = 0; i < views.size(); ++i)
        out[i] = static_cast<double>(count[i]) / static_cast<double>(scene->voxels.grid().count());
    };
  }
  /// Visible unexplored voxels from each of `views`, had those `given` been measured before.
  template <DepthMap M>
  requires OccupancyMap<M>
  [[nodiscard]] std::vector<std::uint64_t> count(const M& map, Views views, Views given = {}) const {
    return Scene<M>(config_, map).counts(given, views);
  }
  [[nodiscard]] const Config& config() const { return config_; }

 private:
  template <class M>
  struct Scene {
    Scene(const Config& c, const M& m) : config(c), map(&m), voxels(m, c.voxel_m) {}

    Config config;
    const M* map;
    UnexploredVoxels<M> voxels;
    ViewsSeen seen = {};

    [[nodiscard]] std::vector<std::uint64_t> counts(Views given, Views views) const {
      const auto render = [this](const View& view) {
        Rendering<channel::Depth> image;
        map->render(view, config.camera, image);
        return VisibleVoxels(voxels.grid(), view, config.camera, std::move(image.depth), config.far_m);
      };
      const auto before = seen(given, render);
      std::vector<std::uint64_t> count(views.size());
      parallel_for(views.size(), [&](std::size_t i) { count[i] = count_unexplored(voxels, render(views[i]), before); });
      return count;
    }
  };
  Config config_;
};

}  // namespace vantage

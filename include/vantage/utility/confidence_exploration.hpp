// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/visible_voxels.hpp>
#include <vantage/utility/unexplored_voxels.hpp>

namespace vantage {

// What there is to gain from looking at known surfaces again, from a rendering of confidence K and depth D (NaN:
// nothing there) of a sensor that sees `far_m`.

/// The published code's: psi_G = mean((1 - K) D / far), where what is beyond `far_m` counts 0 and a pixel without a
/// surface as half way to it: surfaces without confidence, the wider in sight the better. Any K <= 1 gives psi_G >= 0.
struct UnsureSurface {
  double operator()(const Image<float>& confidence, const Image<float>& depth, double far_m) const {
    double sum = 0;
    for (Eigen::Index k = 0; k < depth.size(); ++k) {
      const float d = depth.data()[k];
      const double z = d > 0 ? static_cast<double>(d) : 0.5 * far_m;
      sum += z > far_m ? 0 : (1 - static_cast<double>(confidence.data()[k])) * z;
    }
    return sum / (far_m * static_cast<double>(std::max<Eigen::Index>(depth.size(), 1)));
  }
};
/// The text's: psi_G = -mean(K) (section 6.1.4), at most 0. Negative utilities have no shares (eq. 6.11): see
/// TravelTradeoff.
struct LeastConfidence {
  double operator()(const Image<float>& confidence, const Image<float>&, double) const {
    return -confidence.cast<double>().mean();
  }
};

/// Exploration of unknown space together with closer inspection of surfaces that were seen too little (eq. 6.10):
///
///     psi(v) = phi psi_V(v) + psi_G(v)
///
/// psi_V is what Unexplored is, psi_G the Exploitation, both from one rendering of depth and confidence. Views already
/// in a sequence have seen what they see of unknown space; what they would teach of surfaces is not foretold. Cost: one
/// rendering a view, and the unexplored voxels in its frustum.
template <class Exploitation = UnsureSurface>
class ConfidenceExploration {
 public:
  using MapNeeds = Needs<need::Channels<channel::Depth, channel::Confidence>, need::Occupancy>;

  struct Config {
    double exploration_weight = 1000;                     ///< phi, >= 0
    Camera camera = Camera::from_fov(128, 128, deg(60));  ///< what is rendered
    double far_m = 5;                                     ///< range of the sensor, camera z; finite and > 0
    double voxel_m = 0.2;  ///< edge of a voxel, for maps that have none of their own; finite and > 0
  };

  ConfidenceExploration() : ConfidenceExploration(Config()) {}
  /// Throws Error naming every bad member.
  explicit ConfidenceExploration(const Config& config) : config_(config) {
    config.camera.validate();
    Check check("ConfidenceExploration::Config");
    check.not_negative("exploration_weight", config.exploration_weight);
    check.positive("far_m", config.far_m);
    check.positive("voxel_m", config.voxel_m);
    check.done();
  }

  template <Renders<channel::Depth, channel::Confidence> M>
  requires OccupancyMap<M>
  auto prepare(const M& map, const Situation&, Rng) const {
    return [config = config_, &map, shared = std::make_shared<const Shared<M>>(map, config_.voxel_m)](
               Views given, Views views, std::span<double> out) {
      using Image = Rendering<channel::Depth, channel::Confidence>;
      const auto render = [&](const View& view) {
        Image image;
        map.render(view, config.camera, image);
        return image;
      };
      const auto visible = [&](const View& view, Image&& image) {
        return VisibleVoxels(shared->voxels.grid(), view, config.camera, std::move(image.depth), config.far_m);
      };
      const auto before = shared->seen(given, [&](const View& view) { return visible(view, render(view)); });
      parallel_for(views.size(), [&](std::size_t i) {
        Image image = render(views[i]);
        const double psi_G = Exploitation{}(image.confidence, image.depth, config.far_m);
        const double psi_V =
            static_cast<double>(count_unexplored(shared->voxels, visible(views[i], std::move(image)), before)) /
            static_cast<double>(shared->voxels.grid().count());
        out[i] = config.exploration_weight * psi_V + psi_G;
      });
    };
  }
  [[nodiscard]] const Config& config() const { return config_; }

 private:
  /// What a step's candidates share.
  template <class M>
  struct Shared {
    Shared(const M& map, double voxel_m) : voxels(map, voxel_m) {}
    UnexploredVoxels<M> voxels;
    ViewsSeen seen = {};
  };
  Config config_;
};

}  // namespace vantage

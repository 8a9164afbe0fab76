// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>

namespace vantage {

/// What a view would teach of the map's parameters, after all views that were measured (FisherRF: Jiang et al.,
/// "FisherRF: Active view selection and mapping with radiance fields using Fisher information", ECCV 2024; section
/// 6.2.2):
///
///     psi(v) = sum_k H_k(v) / (H_k(measured) + lambda)
///
/// H is the diagonal of the Fisher information of the map's parameters in the colours rendered; that of the measured
/// views is summed up once a step, that of views already in a sequence is added. >= 0. Cost: one rendering and one
/// backward pass a view, measured ones included, one view after another. Memory: parameters() numbers for the measured
/// views, shared, and twice as many for every call: those of the views known, and those of one view.
class FisherInformation {
 public:
  using MapNeeds = Needs<need::Fisher>;

  struct Config {
    Camera camera = Camera::from_fov(128, 128, deg(60));  ///< what is rendered
    double lambda = 1e-6;                                 ///< information that is there before any view, > 0
  };

  FisherInformation() : FisherInformation(Config()) {}
  /// Throws Error naming every bad member.
  explicit FisherInformation(const Config& config) : config_(config) {
    config.camera.validate();
    Check check("FisherInformation::Config");
    check.positive("lambda", config.lambda);
    check.done();
  }

  template <FisherMap M>
  auto prepare(const M& map, const Situation& q, Rng) const {
    std::vector<double> measured(map.parameters(), config_.lambda);
    for (const View& view : q.visited) map.fisher(view, config_.camera, measured);
    return [camera = config_.camera, &map, measured = std::make_shared<const std::vector<double>>(std::move(measured))](
               Views given, Views views, std::span<double> out) {
      std::vector<double> known = *measured, own(known.size());
      for (const View& view : given) map.fisher(view, camera, known);
      for (std::size_t i = 0; i < views.size(); ++i) {
        std::fill(own.begin(), own.end(), 0.0);
        map.fisher(views[i], camera, own);
        out[i] = parallel_sum(own.size(), 1 << 16, 0.0, [&](std::size_t begin, std::size_t end) {
          double sum = 0;
          for (std::size_t k = begin; k < end; ++k) sum += own[k] / known[k];
          return sum;
        });
      }
    };
  }
  [[nodiscard]] const Config& config() const { return config_; }

 private:
  Config config_;
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/image.hpp>

namespace vantage {

struct BilateralConfig {
  int diameter_px = 15;  ///< of the disc of neighbours; odd, 1 to 63
  double range_m = 0.5;  ///< deviation in depth, > 0
  double space_px = 20;  ///< deviation in the image, > 0

  void validate() const {
    Check check("BilateralConfig");
    check(diameter_px >= 1 && diameter_px <= 63 && diameter_px % 2 == 1, "diameter_px", diameter_px, "odd, 1 to 63");
    check.positive("range_m", range_m);
    check.positive("space_px", space_px);
    check.done();
  }
};

/// A depth image without its noise, its edges kept (Tomasi and Manduchi, "Bilateral filtering for gray and color
/// images", ICCV 1998): each pixel the mean of those in a disc around it, weighted by
/// exp(-|du|^2 / (2 space_px^2) - dD^2 / (2 range_m^2)). Holes (NaN) weigh nothing and stay holes. Depths up to 1e5 m.
/// O(pixels * disc), concurrently; the same bits with any number of threads.
inline Image<float> bilateral_filter(const Image<float>& depth, const BilateralConfig& config = {}) {
  config.validate();
  const Eigen::Index height = depth.rows(), width = depth.cols(), reach = config.diameter_px / 2;
  constexpr float far = 1e6F;  // so far behind everything that it weighs exp(-88)
  Image<float> padded = Image<float>::Constant(height + 2 * reach, width + 2 * reach, far);
  for (Eigen::Index v = 0; v < height; ++v) {
    const float* const from = depth.data() + v * width;
    float* const to = padded.data() + (v + reach) * padded.cols() + reach;
    for (Eigen::Index u = 0; u < width; ++u) to[u] = from[u] < far ? from[u] : far;
  }
  const auto by_range = static_cast<float>(-0.5 / (config.range_m * config.range_m));
  const double by_space = -0.5 / (config.space_px * config.space_px);
  Image<float> filtered(height, width);
  parallel_for_blocks(static_cast<std::size_t>(height), 8, [&](std::size_t begin, std::size_t end) {
    using Row = Eigen::Array<float, 1, Eigen::Dynamic>;
    Row centre(width), weight(width), weights(width), sum(width);
    for (auto v = static_cast<Eigen::Index>(begin); v < static_cast<Eigen::Index>(end); ++v) {
      centre = padded.row(v + reach).segment(reach, width);
      weights.setZero();
      sum.setZero();
      for (Eigen::Index dy = -reach; dy <= reach; ++dy)
        for (Eigen::Index dx = -reach; dx <= reach; ++dx) {
          const Eigen::Index square = dx * dx + dy * dy;
          if (square > reach * reach) continue;
          const Eigen::Map<const Row> other(padded.data() + (v + reach + dy) * padded.cols() + reach + dx, width);
          weight =
              ((other - centre).square() * by_range + static_cast<float>(by_space * static_cast<double>(square))).exp();
          weights += weight;
          sum += weight * (other - centre);
        }
      float* const to = filtered.data() + v * width;
      for (Eigen::Index u = 0; u < width; ++u)
        to[u] = centre[u] < far ? centre[u] + sum[u] / weights[u] : std::numeric_limits<float>::quiet_NaN();
    }
  });
  return filtered;
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/maps/surfel/bilateral_filter.hpp>
#include <vantage/maps/surfel/depth_normals.hpp>
#include <vantage/maps/surfel/one_per_voxel.hpp>
#include <vantage/maps/surfel/surfel_normal.hpp>
#include <vantage/maps/surfel/surfels.hpp>

namespace vantage {

struct DensifyConfig {
  double least_opacity = 0.5;        ///< new surfels where less is rendered, [0, 1]
  double most_colour_error = 0.25;   ///< ... or the colour's error is larger, > 0
  bool squared_colour_error = true;  ///< the mean of squares over channels, <thesis> of absolute values
  double most_behind_share = 0.05;   ///< ... or the depth is larger than the measured one by so much of it, > 0
  double least_cosine = 0.01;        ///< of a new surfel's normal with the way to the camera, [0, 1)
  double spacing_m = 0.02;           ///< edge of the voxels that take one new surfel each, > 0
  double scale_m = 0.01;             ///< of new surfels, > 0
  double opacity = 0.5;              ///< of new surfels, in (0, 1)
  BilateralConfig filter = {};       ///< of the depth, before normals are computed

  void validate() const {
    Check check("DensifyConfig");
    check(least_opacity >= 0 && least_opacity <= 1, "least_opacity", least_opacity, "in [0, 1]");
    check.positive("most_colour_error", most_colour_error);
    check.positive("most_behind_share", most_behind_share);
    check(least_cosine >= 0 && least_cosine < 1, "least_cosine", least_cosine, "in [0, 1)");
    check.positive("spacing_m", spacing_m);
    check.positive("scale_m", scale_m);
    check(opacity > 0 && opacity < 1, "opacity", opacity, "in (0, 1)");
    check.done();
    filter.validate();
  }
};

/// Whether a pixel wants a new surfel (eq. 6.4): colour c rendered and c* measured, depth d and d*, opacity o. A depth
/// of NaN (nothing rendered) is not behind anything.
inline bool wants_surfel(const DensifyConfig& config, float opacity, const Eigen::Array3f& error, float depth,
                         float measured_m) {
  const float colour = config.squared_colour_error ? error.square().mean() : error.abs().mean();
  return opacity < static_cast<float>(config.least_opacity) || colour > static_cast<float>(config.most_colour_error) ||
         depth - measured_m > static_cast<float>(config.most_behind_share) * measured_m;
}

/// Appends surfels for the pixels of a valid frame with colour and depth that want one (eq. 6.4), have a depth and a
/// normal, and are not seen at a grazing angle; one random point a voxel of all these. Position and colour are the
/// pixel's, the normal is by central differences of the filtered depth, the confidence 0. `drawn`: r, g, b, depth and
/// opacity as rendered from there. Returns how many. O(pixels * filter); the same bits with any number of threads.
template <class Drawn>
std::size_t densify(Surfels& surfels, const Frame& frame, const Drawn& drawn, const DensifyConfig& config, Rng& rng) {
  const Rng stream = rng.fork(0);
  (void)rng();
  const NormalImage normals = normals_of(bilateral_filter(frame.depth, config.filter), frame.camera);
  const Eigen::Index width = frame.depth.cols();
  const auto ray_of = [&](std::size_t i) -> Eigen::Vector3d {
    const auto k = static_cast<Eigen::Index>(i), row = k / width;
    return frame.camera.ray(static_cast<double>(k - row * width) + 0.5, static_cast<double>(row) + 0.5);
  };
  const auto pixels = static_cast<std::size_t>(frame.depth.size());
  std::vector<std::uint8_t> wanted(pixels), stays(pixels);
  parallel_for_blocks(pixels, 8192, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float measured_m = frame.depth.data()[i];
      if (!(measured_m > 0)) continue;
      const Eigen::Array3f error(drawn.r.data()[i] - frame.colour.r.data()[i],
                                 drawn.g.data()[i] - frame.colour.g.data()[i],
                                 drawn.b.data()[i] - frame.colour.b.data()[i]);
      if (!wants_surfel(config, drawn.opacity.data()[i], error, drawn.depth.data()[i], measured_m)) continue;
      const Eigen::Vector3d n(normals.x.data()[i], normals.y.data()[i], normals.z.data()[i]);
      wanted[i] = n.dot(ray_of(i).normalized()) < -config.least_cosine;  // false for no normal
    }
  });
  std::size_t candidates = 0;
  for (const std::uint8_t w : wanted) candidates += w;
  OnePerVoxel voxels(candidates, config.spacing_m);
  const double most_m = config.spacing_m * (1 << 20);
  const auto point_of = [&](std::size_t i) -> Eigen::Vector3d {
    return frame.view.T_W_C * Eigen::Vector3d(static_cast<double>(frame.depth.data()[i]) * ray_of(i));
  };
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!wanted[i]) continue;
    const Eigen::Vector3d p = point_of(i);
    if (p.cwiseAbs().maxCoeff() < most_m) voxels.add(p, static_cast<std::uint32_t>(i), stream.fork(i)());
  }
  voxels.mark(stays);
  const float log_scale = std::log(static_cast<float>(config.scale_m) / surfels.scale.unit_m);
  const auto logit = static_cast<float>(std::log(config.opacity / (1 - config.opacity)));
  std::size_t added = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!stays[i]) continue;
    const Eigen::Vector3d at = point_of(i);
    const Eigen::Vector3f p = at.cast<float>();
    const Eigen::Vector3d n(normals.x.data()[i], normals.y.data()[i], normals.z.data()[i]);
    const std::array<float, 4> q =
        quaternion_towards<float>((frame.view.T_W_C.linear() * n).normalized().cast<float>());
    surfels.push_back({{p.x(), p.y(), p.z(), q[0], q[1], q[2], q[3], log_scale, log_scale, frame.colour.r.data()[i],
                        frame.colour.g.data()[i], frame.colour.b.data()[i], logit},
                       0});
    ++added;
  }
  return added;
}

}  // namespace vantage

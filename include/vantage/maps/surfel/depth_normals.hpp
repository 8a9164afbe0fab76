// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

#include <Eigen/Core>

#include <vantage/core/parallel.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/maps/surfel/padded_rows.hpp>
#include <vantage/maps/surfel/rendered_normals.hpp>

namespace vantage {

/// Three planes: unit vectors in the camera's frame, or 0.
struct NormalImage {
  Image<float> x, y, z;
};

/// Normals by central differences of the points of a depth image (NaN = no value), towards the camera; a neighbour that
/// is missing counts as the pixel itself, and where nothing is left the normal is 0. See DepthNormalRows. `camera` is
/// of the image's size. O(pixels), concurrently.
inline NormalImage normals_of(const Image<float>& depth, const Camera& camera) {
  const Eigen::Index height = depth.rows(), width = depth.cols();
  NormalImage normals;
  for (Image<float>* plane : {&normals.x, &normals.y, &normals.z}) plane->resize(height, width);
  const PixelRays<float> rays(camera);
  constexpr std::size_t block = 16;
  parallel_for_blocks(static_cast<std::size_t>(height), block, [&](std::size_t begin, std::size_t end) {
    enum Plane : Eigen::Index { metres, valid, planes };
    const auto first = static_cast<Eigen::Index>(begin), last = static_cast<Eigen::Index>(end);
    PaddedRows<float> rows;
    rows.resize(planes, static_cast<Eigen::Index>(block) + 2, width);
    for (Eigen::Index v = first - 1; v < last + 1; ++v) {
      if (v < 0 || v >= height) continue;
      const float* const from = depth.data() + v * width;
      float *const d = rows(metres, v - first + 1).data(), *const there = rows(valid, v - first + 1).data();
      for (Eigen::Index u = 0; u < width; ++u) {
        there[u] = from[u] > 0 ? 1.0F : 0.0F;
        d[u] = from[u] > 0 ? from[u] : 0.0F;
      }
    }
    DepthNormalRows<float> surface;
    for (Eigen::Index v = first; v < last; ++v) {
      surface(rows, metres, valid, v - first + 1, rays, v);
      const auto there = rows(valid, v - first + 1);
      normals.x.row(v) = surface.n.x * there;
      normals.y.row(v) = surface.n.y * there;
      normals.z.row(v) = surface.n.z * there;
    }
  });
  return normals;
}

}  // namespace vantage

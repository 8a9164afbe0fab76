// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

struct NormalsConfig {
  int reach_px = 2;               ///< between a pixel and the neighbours that its normal comes from, 1 to 16
  double most_step_share = 0.03;  ///< of depth, between them: more is an edge, and no normal; > 0
};

/// The surface that a depth image shows: a point and a normal a pixel, in the camera's frame. Const members run
/// concurrently.
class DepthSurface {
 public:
  /// `depth`: camera z [m], NaN = no value. A normal is the cross product of the differences to the neighbours left and
  /// right, above and below, `reach_px` away, and faces the camera. Throws Error if camera, view or configuration are
  /// bad, or the image is of another size. O(pixels), concurrently.
  DepthSurface(const Camera& camera, const View& view, Image<float> depth, const NormalsConfig& config = {})
      : camera_(camera), view_(view), depth_(std::move(depth)) {
    Check check("NormalsConfig");
    check(config.reach_px >= 1 && config.reach_px <= 16, "reach_px", config.reach_px, "1 to 16");
    check.positive("most_step_share", config.most_step_share);
    check.done();
    camera_.validate();
    check_view(view_, "DepthSurface");
    if (depth_.rows() != camera_.height || depth_.cols() != camera_.width)
      throw Error("DepthSurface", concat("depth of ", depth_.cols(), " x ", depth_.rows(), " px"),
                  concat("the camera's ", camera_.width, " x ", camera_.height));
    for (Image<float>* n : {&nx_, &ny_, &nz_})
      n->setConstant(depth_.rows(), depth_.cols(), std::numeric_limits<float>::quiet_NaN());
    const Eigen::Index k = config.reach_px, rows = depth_.rows() - 2 * k;
    if (rows <= 0) return;
    parallel_for(static_cast<std::size_t>(rows), [&](std::size_t i) {
      const Eigen::Index row = k + static_cast<Eigen::Index>(i);
      for (Eigen::Index column = k; column < depth_.cols() - k; ++column) {
        const auto most = static_cast<float>(config.most_step_share) * depth_(row, column);
        const auto near = [&](Eigen::Index r, Eigen::Index c) {
          return std::abs(depth_(r, c) - depth_(row, column)) <= most;  // false for NaN
        };
        if (!near(row, column - k) || !near(row, column + k) || !near(row - k, column) || !near(row + k, column))
          continue;
        const Eigen::Vector3d across = point(row, column + k) - point(row, column - k);
        const Eigen::Vector3d down = point(row + k, column) - point(row - k, column);
        const Eigen::Vector3f n = down.cross(across).normalized().cast<float>();
        nx_(row, column) = n.x();
        ny_(row, column) = n.y();
        nz_(row, column) = n.z();
      }
    });
  }

  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] const View& view() const { return view_; }
  [[nodiscard]] Eigen::Index rows() const { return depth_.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return depth_.cols(); }
  /// Whether the pixel has a point and a normal.
  [[nodiscard]] bool has(Eigen::Index row, Eigen::Index column) const { return !std::isnan(nx_(row, column)); }
  /// The point at the centre of a pixel, in the camera's frame [m].
  [[nodiscard]] Eigen::Vector3d point(Eigen::Index row, Eigen::Index column) const {
    return static_cast<double>(depth_(row, column)) *
           camera_.ray(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
  }
  /// The unit normal there, in the camera's frame, towards the camera.
  [[nodiscard]] Eigen::Vector3d normal(Eigen::Index row, Eigen::Index column) const {
    return {nx_(row, column), ny_(row, column), nz_(row, column)};
  }

 private:
  Camera camera_;
  View view_;
  Image<float> depth_, nx_, ny_, nz_;
};

}  // namespace vantage

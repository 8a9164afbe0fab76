// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string_view>

#include <vantage/core/error.hpp>

namespace vantage {

/// Pinhole camera [px]; the centre of pixel (0, 0) is (0.5, 0.5).
struct Camera {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;

  /// Square pixels, principal point in the middle; `fov_x_rad` in (0, pi) is the full horizontal angle.
  static Camera from_fov(int width, int height, double fov_x_rad) {
    Check check("Camera::from_fov");
    check(fov_x_rad > 0 && fov_x_rad < std::numbers::pi, "fov_x_rad", fov_x_rad, "in (0, pi)");
    check.done();
    const double f = 0.5 * width / std::tan(0.5 * fov_x_rad);
    const Camera camera{width, height, f, f, 0.5 * width, 0.5 * height};
    camera.validate();
    return camera;
  }
  /// Throws Error naming `where`, such as the file that tells of the camera, and every bad member.
  void validate(std::string_view where = "Camera") const {
    Check check(where);
    check(width > 0 && width <= 1 << 16, "width", width, "1 to 65536 px");
    check(height > 0 && height <= 1 << 16, "height", height, "1 to 65536 px");
    check.positive("fx", fx);
    check.positive("fy", fy);
    check.finite("cx", cx);
    check.finite("cy", cy);
    check.done();
  }
  /// Direction, in the camera frame with z = 1, of the ray through (u, v) [px].
  [[nodiscard]] Eigen::Vector3d ray(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }
};

}  // namespace vantage

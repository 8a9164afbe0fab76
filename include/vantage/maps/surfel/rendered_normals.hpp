// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <limits>

#include <Eigen/Core>

#include <vantage/geometry/camera.hpp>
#include <vantage/maps/surfel/padded_rows.hpp>

namespace vantage {

/// Directions of the rays through the pixels' centres, camera frame, z = 1.
template <class T>
struct PixelRays {
  Eigen::Array<T, 1, Eigen::Dynamic> x;  ///< one a column, with a border of one column (0) on each side
  Eigen::Array<T, Eigen::Dynamic, 1> y;  ///< one a row

  explicit PixelRays(const Camera& camera) : x(camera.width + 2), y(camera.height) {
    x.setZero();
    for (int u = 0; u < camera.width; ++u) x[u + 1] = static_cast<T>(camera.ray(u + 0.5, 0).x());
    for (int v = 0; v < camera.height; ++v) y[v] = static_cast<T>(camera.ray(0, v + 0.5).y());
  }
};

/// Normals of the surface that a depth image shows, row by row. With P the point of a pixel and Pu, Pd, Pl, Pr those of
/// its neighbours above, below, left and right,
///
///     n = S / |S|,   S = (Pu - P) x (Pl - P) + (Pl - P) x (Pd - P) + (Pd - P) x (Pr - P) + (Pr - P) x (Pu - P)
///                      = (Pu - Pd) x (Pl - Pr),
///
/// which faces the camera. A neighbour that is not valid, or outside of the image, counts as P itself; where S
/// vanishes, n is 0. Points are depth times ray, so that the gradient by depth passes through both arms of the cross
/// product.
template <class T>
class DepthNormalRows {
 public:
  using Row = Eigen::Array<T, 1, Eigen::Dynamic>;
  struct Vectors {
    Row x, y, z;
    void resize(Eigen::Index size) { x.resize(size), y.resize(size), z.resize(size); }
  };

  /// The normals of row `row` of `rows`, whose planes `depth` [m, 0 where not valid] and `valid` (1 or 0) hold the rows
  /// above and below as well; image row v.
  void operator()(PaddedRows<T>& rows, Eigen::Index depth, Eigen::Index valid, Eigen::Index row,
                  const PixelRays<T>& rays, Eigen::Index v) {
    const Eigen::Index width = rows.width();
    n.resize(width), a.resize(width), b.resize(width);
    const T y = rays.y[v], y_up = v > 0 ? rays.y[v - 1] : y, y_down = v + 1 < rays.y.size() ? rays.y[v + 1] : y;
    const auto d = rows(depth, row), up = rows(depth, row - 1), down = rows(depth, row + 1),
               left = rows(depth, row, -1), right = rows(depth, row, 1);
    const auto has_up = rows(valid, row - 1), has_down = rows(valid, row + 1), has_left = rows(valid, row, -1),
               has_right = rows(valid, row, 1);
    const auto x = rays.x.segment(1, width), x_left = rays.x.segment(0, width), x_right = rays.x.segment(2, width);
    // By differences to P, which are exactly 0 where there is no neighbour, whatever the rounding of the products.
    a.z = has_up * (up - d) - has_down * (down - d);
    a.x = a.z * x;
    a.y = has_up * (up * y_up - d * y) - has_down * (down * y_down - d * y);
    b.z = has_left * (left - d) - has_right * (right - d);
    b.y = b.z * y;
    b.x = has_left * (left * x_left - d * x) - has_right * (right * x_right - d * x);
    n.x = a.y * b.z - a.z * b.y;
    n.y = a.z * b.x - a.x * b.z;
    n.z = a.x * b.y - a.y * b.x;
    inverse = n.x.square() + n.y.square() + n.z.square();
    // 1 / |S|, and 0 for 0: the least that is normal, so that neither overflows.
    constexpr T least = std::numeric_limits<T>::min();
    there_.resize(width);
    mark_above<T>(inverse.data(), least, width, there_.data());
    inverse = there_ * (inverse + least).rsqrt();
    n.x *= inverse, n.y *= inverse, n.z *= inverse;
  }

  Vectors n;     ///< unit normals, or 0
  Vectors a, b;  ///< Pu - Pd and Pl - Pr
  Row inverse;   ///< 1 / |S|

 private:
  Row there_;
};

}  // namespace vantage

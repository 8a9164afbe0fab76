// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include <vantage/core/lanes.hpp>

namespace vantage {

/// What a model of depth depends on: the surfel's centre over its depth, its normal (camera frame) and its depth [m].
template <class T>
struct DepthInput {
  std::array<T, 3> centre;  ///< (px/pz, py/pz, 1)
  std::array<T, 3> normal;
  T z;
};
template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The depth of a surfel at a pixel dx, dy [px] from its centre and how it depends on what it is made of.
template <class T>
struct DepthAt {
  T depth, by_z, by_slope;  ///< by_slope: the derivative by dx zx + dy zy
};

/// The published depth: linear in the pixel, z + dx zx + dy zy, with slopes taken a step of 1e-3 beside the centre. In
/// an ordinary view 0.7 mm off the plane in the mean, metres for large surfels seen at a grazing angle.
struct LinearDepth {
  /// (zx, zy); f: focal lengths [px].
  template <class T, class S>
  static std::array<T, 2> slopes(const DepthInput<T>& in, const std::array<S, 2>& f) {
    const T facing = dot(in.normal, in.centre), scale = -in.z / T(S(0.5) * (f[0] + f[1]));
    return {scale * in.normal[0] / (facing + step<S> * in.normal[0]),
            scale * in.normal[1] / (facing + step<S> * in.normal[1])};
  }
  /// Adds to d the derivatives of a loss, given those by the slopes.
  template <class T, class S>
  static void chain(const DepthInput<T>& in, const std::array<S, 2>& f, const std::array<T, 2>& d_slope,
                    DepthInput<T>& d) {
    const T facing = dot(in.normal, in.centre), scale = T(S(-1) / (S(0.5) * (f[0] + f[1])));
    for (std::size_t i = 0; i < 2; ++i) {
      const T below = T(1) / (facing + step<S> * in.normal[i]), ratio = in.normal[i] * below;
      const T d_ratio = d_slope[i] * scale * in.z, d_facing = -d_ratio * ratio * below;
      d.z += d_slope[i] * scale * ratio;
      d.normal[i] += d_ratio * below + step<S> * d_facing;
      for (std::size_t k = 0; k < 3; ++k) {
        d.normal[k] += d_facing * in.centre[k];
        d.centre[k] += d_facing * in.normal[k];
      }
    }
  }
  template <class T>
  static DepthAt<T> at(const T& z, const T& slope) {
    return {z + slope, T(1), T(1)};
  }

 private:
  template <class S>
  static constexpr S step = S(1e-3);
};

/// The depth of the surfel's plane on the pixel's ray: z / (1 + dx zx + dy zy). Exact, and beyond the plane's horizon
/// negative as that is; the denominator's size is held at 1e-3, so that no depth exceeds 1000 z.
struct RayPlaneDepth {
  template <class T, class S>
  static std::array<T, 2> slopes(const DepthInput<T>& in, const std::array<S, 2>& f) {
    const T facing = T(1) / dot(in.normal, in.centre);
    return {in.normal[0] * facing / f[0], in.normal[1] * facing / f[1]};
  }
  template <class T, class S>
  static void chain(const DepthInput<T>& in, const std::array<S, 2>& f, const std::array<T, 2>& d_slope,
                    DepthInput<T>& d) {
    const T facing = T(1) / dot(in.normal, in.centre);
    for (std::size_t i = 0; i < 2; ++i) {
      const T d_ratio = d_slope[i] / f[i], d_facing = -d_ratio * in.normal[i] * facing * facing;
      d.normal[i] += d_ratio * facing;
      for (std::size_t k = 0; k < 3; ++k) {
        d.normal[k] += d_facing * in.centre[k];
        d.centre[k] += d_facing * in.normal[k];
      }
    }
  }
  template <class T>
  static DepthAt<T> at(const T& z, const T& slope) {
    using S = ScalarOf<T>;
    using std::abs;
    const T below = T(1) + slope, least = T(S(1e-3));
    const auto free = abs(below) > least;
    const T by_z = T(1) / select(free, below, select(below < T(0), -least, least));
    return {z * by_z, by_z, select(free, -z * by_z * by_z, T(0))};
  }
};

}  // namespace vantage

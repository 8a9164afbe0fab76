// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <vantage/core/lanes.hpp>
#include <vantage/maps/surfel/depth_model.hpp>
#include <vantage/maps/surfel/rasteriser.hpp>
#include <vantage/maps/surfel/surfels.hpp>

// From a surfel to its splat, an elliptic Gaussian in the image (section 6.1.1), and the chain rule back. All of it is
// templated on the type of a number: double, float, or sixteen floats.
namespace vantage {

/// A RasterView as projections need it: T_C_W, the camera with the centre of pixel (i, j) at (i, j), and the limits.
template <class S>
struct Projector {
  std::array<std::array<S, 3>, 3> R;  ///< rows of R_C_W
  std::array<S, 3> t;
  std::array<S, 2> f, c, size;         ///< [px]
  std::array<S, 2> nearest, furthest;  ///< of px/pz: where the Jacobian is held, 15 % of the image outside
  SurfelScale scale;
  bool front_only;

  Projector(const RasterView& view, const SurfelScale& scale_) : scale(scale_), front_only(view.front_only) {
    const Eigen::Isometry3d T_C_W = view.view.T_C_W();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      for (std::size_t k = 0; k < 3; ++k) R[i][k] = static_cast<S>(T_C_W(row, static_cast<Eigen::Index>(k)));
      t[i] = static_cast<S>(T_C_W(row, 3));
    }
    const Camera& camera = view.camera;
    const std::array<double, 2> f_px = {camera.fx, camera.fy}, c_px = {camera.cx, camera.cy};
    const std::array<int, 2> pixels = {camera.width, camera.height};
    for (std::size_t i = 0; i < 2; ++i) {
      f[i] = static_cast<S>(f_px[i]);
      c[i] = static_cast<S>(c_px[i] - 0.5);
      size[i] = static_cast<S>(pixels[i]);
      nearest[i] = static_cast<S>((-0.15 * pixels[i] - c_px[i]) / f_px[i]);
      furthest[i] = static_cast<S>((1.15 * pixels[i] - c_px[i]) / f_px[i]);
    }
  }

  template <class T>
  std::array<T, 3> rotate(const std::array<T, 3>& v) const {
    const auto row = [&](std::size_t i) { return R[i][0] * v[0] + R[i][1] * v[1] + R[i][2] * v[2]; };
    return {row(0), row(1), row(2)};
  }
  template <class T>
  std::array<T, 3> rotate_back(const std::array<T, 3>& v) const {
    const auto column = [&](std::size_t i) { return R[0][i] * v[0] + R[1][i] * v[1] + R[2][i] * v[2]; };
    return {column(0), column(1), column(2)};
  }
  template <class T>
  std::array<T, 3> to_camera(const std::array<T, 3>& x) const {
    const std::array<T, 3> p = rotate(x);
    return {p[0] + t[0], p[1] + t[1], p[2] + t[2]};
  }
  /// Where a point of the camera frame is seen [px]; a hair is added to its depth, so that none divides by 0.
  template <class T>
  std::array<T, 2> pixel(const std::array<T, 3>& p) const {
    const T over_z = T(1) / (p[2] + T(S(1e-7)));
    return {f[0] * p[0] * over_z + c[0], f[1] * p[1] * over_z + c[1]};
  }
  /// Before the camera and at most 20 % of the image's size outside of it, counted from the middle of the first pixel
  /// as the published code does; false for NaN.
  template <class T>
  auto in_sight(const std::array<T, 3>& p, const std::array<T, 2>& uv) const {
    const auto inside = [&](std::size_t i) {
      return all_hold(uv[i] >= T(S(-0.2) * size[i]), uv[i] <= T(S(1.2) * size[i]));
    };
    return all_hold(p[2] >= T(0), inside(0), inside(1));
  }
};

/// One surfel in the image, with what the chain rule needs of the way there.
template <class T>
struct Splat {
  std::array<T, 2> centre;               ///< [px], integer at a pixel's centre
  std::array<T, 3> p;                    ///< centre in the camera frame [m]
  std::array<std::array<T, 3>, 3> axis;  ///< columns of R_C_S; the last is the normal
  std::array<T, 2> scale_m;
  std::array<T, 3> covariance, conic;  ///< xx, xy, yy; conic = covariance^-1 [px^2], [1/px^2]
  std::array<T, 2> slope;              ///< of depth, see LinearDepth and RayPlaneDepth
  T opacity;
  std::array<T, 2> ray, held;            ///< px/pz, py/pz, and the same held within limits
  std::array<std::array<T, 2>, 2> semi;  ///< [axis][x or y]: what a scaled axis is in the image [px]
};

/// Derivatives of a loss by what is drawn of a splat.
template <class T>
struct SplatGradient {
  std::array<T, 2> centre;
  std::array<T, 3> conic;  ///< conic[1] counts both off-diagonal entries
  T z;
  std::array<T, 2> slope;
  std::array<T, 3> normal;
  T log_opacity;
};

/// By what is trained of a surfel, colour left out: position, quaternion, logarithms of scales, logit; and by the pose.
template <class T>
struct SurfelChain {
  std::array<T, 3> position;
  std::array<T, 4> quaternion;
  std::array<T, 2> log_scale;
  T logit;
  std::array<T, 6> pose;
};

/// sum += a x b.
template <class T>
void add_cross(const std::array<T, 3>& a, const std::array<T, 3>& b, std::array<T, 3>& sum) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3, l = (i + 2) % 3;
    sum[i] += a[k] * b[l] - a[l] * b[k];
  }
}

namespace surfel {

template <class T>
using Parameters = std::array<T, parameters>;

/// The quaternion (w, x, y, z) at length 1, and its length.
template <class T>
std::pair<std::array<T, 4>, T> unit_quaternion(const Parameters<T>& in) {
  using std::sqrt;
  const T length = sqrt(in[qw] * in[qw] + in[qx] * in[qx] + in[qy] * in[qy] + in[qz] * in[qz]), over = T(1) / length;
  return {{in[qw] * over, in[qx] * over, in[qy] * over, in[qz] * over}, length};
}
/// Columns of R_W_S.
template <class T>
std::array<std::array<T, 3>, 3> rotation(const std::array<T, 4>& unit) {
  const auto& [a, b, c, d] = unit;
  const T one = T(1), two = T(2);
  return {{{one - two * (c * c + d * d), two * (b * c + a * d), two * (b * d - a * c)},
           {two * (b * c - a * d), one - two * (b * b + d * d), two * (c * d + a * b)},
           {two * (b * d + a * c), two * (c * d - a * b), one - two * (b * b + c * c)}}};
}

}  // namespace surfel

/// The splat of a surfel that is in sight. Whether it is drawn says `is_drawn`.
template <class Depth, class T, class S>
Splat<T> project(const Projector<S>& camera, const surfel::Parameters<T>& in) {
  using std::exp;
  using std::max;
  using std::min;
  Splat<T> s;
  s.p = camera.to_camera(std::array<T, 3>{in[surfel::x], in[surfel::y], in[surfel::z]});
  s.centre = camera.pixel(s.p);
  const auto columns = surfel::rotation(surfel::unit_quaternion(in).first);
  for (std::size_t i = 0; i < 3; ++i) s.axis[i] = camera.rotate(columns[i]);

  const T over_z = T(1) / s.p[2];
  for (std::size_t i = 0; i < 2; ++i) {
    s.scale_m[i] = min(T(S(camera.scale.max_m)), S(camera.scale.unit_m) * exp(in[surfel::log_scale_x + i]));
    s.ray[i] = s.p[i] * over_z;
    s.held[i] = max(T(camera.nearest[i]), min(T(camera.furthest[i]), s.ray[i]));
  }
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      s.semi[i][k] = camera.f[k] * over_z * s.scale_m[i] * (s.axis[i][k] - s.held[k] * s.axis[i][2]);
  // A surfel is flat, so that its covariance is of the two semi-axes only. The determinant is written as a sum of what
  // is not negative: nothing cancels for a needle.
  const auto& [a, b] = s.semi;
  const T blur = T(S(0.3));
  const T xx = a[0] * a[0] + b[0] * b[0], yy = a[1] * a[1] + b[1] * b[1], area = a[0] * b[1] - a[1] * b[0];
  s.covariance = {xx + blur, a[0] * a[1] + b[0] * b[1], yy + blur};
  const T over_det = T(1) / (area * area + blur * (xx + yy + blur));
  s.conic = {s.covariance[2] * over_det, -s.covariance[1] * over_det, s.covariance[0] * over_det};
  s.slope = Depth::slopes(DepthInput<T>{{s.ray[0], s.ray[1], T(1)}, s.axis[2], s.p[2]}, camera.f);
  s.opacity = T(1) / (T(1) + exp(-in[surfel::logit]));
  return s;
}

/// Whether a surfel in sight is drawn: not seen from its edge, all finite, and from its front if only those count.
template <class T, class S>
auto is_drawn(const Projector<S>& camera, const surfel::Parameters<T>& in, const T& confidence, const Splat<T>& s) {
  using std::abs;
  const auto seen = [&](const T& rx, const T& ry) {
    const T facing = s.axis[2][0] * rx + s.axis[2][1] * ry + s.axis[2][2];
    return abs(facing) >= S(0.01) * (rx * rx + ry * ry + T(1));
  };
  const T step = T(S(1e-3)), largest = T(S(1e30));
  const T facing_m = dot(s.p, s.axis[2]);
  return all_hold(
      seen(s.ray[0] + step, s.ray[1]), seen(s.ray[0], s.ray[1] + step),
      abs(s.slope[0]) + abs(s.slope[1]) + s.covariance[0] + s.covariance[2] + s.conic[0] + s.conic[2] <= largest,
      abs(in[surfel::red]) + abs(in[surfel::green]) + abs(in[surfel::blue]) + abs(confidence) <= largest,
      s.opacity >= T(0), facing_m <= (camera.front_only ? T(S(-0.01)) : largest));
}

/// The chain rule through `project`.
template <class Depth, class T, class S>
SurfelChain<T> chain(const Projector<S>& camera, const surfel::Parameters<T>& in, const Splat<T>& s,
                     const SplatGradient<T>& g) {
  SurfelChain<T> out;
  const T zero = T(0), over_z = T(1) / s.p[2];
  std::array<T, 3> d_p = {zero, zero, zero};
  std::array<std::array<T, 3>, 3> d_axis = {};
  for (auto& axis : d_axis) axis = {zero, zero, zero};

  DepthInput<T> d_in{{zero, zero, zero}, g.normal, g.z};
  Depth::chain(DepthInput<T>{{s.ray[0], s.ray[1], T(1)}, s.axis[2], s.p[2]}, camera.f, g.slope, d_in);
  d_axis[2] = d_in.normal;
  d_p[2] += d_in.z;

  // Covariance: -conic G conic for the symmetric G of the conic's derivatives.
  const auto& [A, B, C] = s.conic;
  const T ga = g.conic[0], gb = S(0.5) * g.conic[1], gc = g.conic[2];
  const T row_a = A * ga + B * gb, row_b = A * gb + B * gc, row_c = B * ga + C * gb, row_d = B * gb + C * gc;
  const T d_xx = -(row_a * A + row_b * B), d_xy = -(row_a * B + row_b * C), d_yy = -(row_c * B + row_d * C);

  std::array<T, 2> d_ray = {d_in.centre[0], d_in.centre[1]};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::array<T, 2> d_semi = {S(2) * (d_xx * s.semi[i][0] + d_xy * s.semi[i][1]),
                                     S(2) * (d_xy * s.semi[i][0] + d_yy * s.semi[i][1])};
    T d_scale = zero;
    for (std::size_t k = 0; k < 2; ++k) {
      const T d = camera.f[k] * over_z * d_semi[k], d_scaled = d * s.scale_m[i];
      d_axis[i][k] += d_scaled;
      d_axis[i][2] -= d_scaled * s.held[k];
      const auto free = all_hold(s.ray[k] > T(camera.nearest[k]), s.ray[k] < T(camera.furthest[k]));
      d_ray[k] -= select(free, d_scaled * s.axis[i][2], zero);
      d_p[2] -= d_semi[k] * s.semi[i][k] * over_z;
      d_scale += d * (s.axis[i][k] - s.held[k] * s.axis[i][2]);
    }
    out.log_scale[i] = select(s.scale_m[i] < T(S(camera.scale.max_m)), d_scale * s.scale_m[i], zero);
  }
  const T over_hair = T(1) / (s.p[2] + T(S(1e-7)));
  for (std::size_t k = 0; k < 2; ++k) {
    const T d = camera.f[k] * over_hair * g.centre[k];
    d_p[k] += d + d_ray[k] * over_z;
    d_p[2] -= d * s.p[k] * over_hair + d_ray[k] * s.ray[k] * over_z;
  }

  out.logit = g.log_opacity * (T(1) - s.opacity);
  out.position = camera.rotate_back(d_p);
  // A small turn of the surfel by phi changes the loss by torque . phi and its unit quaternion by (0, phi) q / 2.
  std::array<T, 3> torque = {zero, zero, zero};
  for (std::size_t i = 0; i < 3; ++i) add_cross(s.axis[i], d_axis[i], torque);
  const auto [unit, length] = surfel::unit_quaternion(in);
  const std::array<T, 3> turn = camera.rotate_back(torque), imaginary = {unit[1], unit[2], unit[3]};
  std::array<T, 3> turned = {unit[0] * turn[0], unit[0] * turn[1], unit[0] * turn[2]};
  add_cross(turn, imaginary, turned);
  const T twice = T(2) / length;
  out.quaternion = {-dot(turn, imaginary) * twice, turned[0] * twice, turned[1] * twice, turned[2] * twice};

  // A motion xi of the camera moves what it sees by exp(-xi).
  add_cross(s.p, d_p, torque);
  out.pose = {-d_p[0], -d_p[1], -d_p[2], -torque[0], -torque[1], -torque[2]};
  return out;
}

}  // namespace vantage

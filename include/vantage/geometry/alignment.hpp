// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/symmetric_eigen.hpp>
#include <vantage/geometry/depth_surface.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

struct AlignmentConfig {
  double most_apart_m = 0.1;         ///< between points put together, at the finest level; doubled at each coarser; > 0
  double most_turn_rad = 0.6;        ///< between their normals, in (0, pi)
  double huber_m = 0.005;            ///< residuals beyond count linearly, > 0
  int levels = 3;                    ///< of points: every 4th, every 2nd, every pixel; 1 to 6
  int most_iterations = 20;          ///< a level, 1 to 1000
  double least_step_m = 1e-6;        ///< a smaller step, at the surface's size, ends a level; > 0
  double least_overlap = 0.2;        ///< share of the points that must find a partner, in (0, 1]
  double least_conditioning = 1e-4;  ///< below, some motion is not observable (a plane slides, a ball turns); in [0, 1)
};

/// How a depth image was aligned.
struct Alignment {
  View view;                ///< from where it was taken
  std::size_t pairs = 0;    ///< points that found a partner
  double overlap = 0;       ///< their share of all points
  double rms_m = 0;         ///< of their distances along the normal
  double conditioning = 0;  ///< smallest over largest eigenvalue of the normal equations, turns at the surface's size
  int iterations = 0;
};

namespace detail {

/// Sums of J^T w J, J^T w r and so on, over pairs of points.
struct NormalEquations {
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
  double squares = 0;
  std::size_t pairs = 0, points = 0;

  NormalEquations& operator+=(const NormalEquations& o) {
    A += o.A;
    b += o.b;
    squares += o.squares;
    pairs += o.pairs;
    points += o.points;
    return *this;
  }
};

/// One linearisation at T (source camera to model camera). Turns are about `centre` and scaled by `size_m`, so that all
/// six unknowns are lengths.
inline NormalEquations linearise(const DepthSurface& source, const DepthSurface& model, const Eigen::Isometry3d& T,
                                 const Eigen::Vector3d& centre, double size_m, int stride, double most_apart_m,
                                 const AlignmentConfig& config) {
  const double least_cosine = std::cos(config.most_turn_rad);
  const auto rows = static_cast<std::size_t>((source.rows() + stride - 1) / stride);
  return parallel_sum(rows, 8, NormalEquations{}, [&](std::size_t begin, std::size_t end) {
    NormalEquations sum;
    for (std::size_t i = begin; i < end; ++i)
      for (Eigen::Index row = static_cast<Eigen::Index>(i) * stride, column = 0; column < source.cols();
           column += stride) {
        if (!source.has(row, column)) continue;
        ++sum.points;
        const Eigen::Vector3d p = T * source.point(row, column);
        if (!(p.z() > 0)) continue;
        const Camera& camera = model.camera();
        const double u = camera.fx * p.x() / p.z() + camera.cx, v = camera.fy * p.y() / p.z() + camera.cy;
        if (!(u >= 0 && v >= 0 && u < camera.width && v < camera.height)) continue;
        const auto r = static_cast<Eigen::Index>(v), c = static_cast<Eigen::Index>(u);
        if (!model.has(r, c)) continue;
        const Eigen::Vector3d q = model.point(r, c), n = model.normal(r, c);
        if ((p - q).squaredNorm() > most_apart_m * most_apart_m) continue;
        if (n.dot(T.linear() * source.normal(row, column)) < least_cosine) continue;
        const double residual = n.dot(p - q);
        const double weight = std::min(1.0, config.huber_m / std::max(std::abs(residual), 1e-300));
        Eigen::Matrix<double, 6, 1> J;
        J << (p - centre).cross(n) / size_m, n;
        for (int a = 0; a < 6; ++a)
          for (int b = 0; b <= a; ++b) sum.A(a, b) += weight * J[a] * J[b];  // only the lower triangle
        sum.b += weight * residual * J;
        sum.squares += residual * residual;
        ++sum.pairs;
      }
    return sum;
  });
}

/// Mean and root mean square distance from it of a surface's points.
inline std::pair<Eigen::Vector3d, double> centre_and_size(const DepthSurface& s) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0, n = 0;
  for (Eigen::Index row = 0; row < s.rows(); row += 4)
    for (Eigen::Index column = 0; column < s.cols(); column += 4)
      if (s.has(row, column)) {
        const Eigen::Vector3d p = s.point(row, column);
        sum += p;
        squares += p.squaredNorm();
        ++n;
      }
  if (n == 0) return {sum, 0};
  return {sum / n, std::sqrt(std::max(0.0, squares / n - (sum / n).squaredNorm()))};
}

}  // namespace detail

/// Aligns a depth image to a surface seen from another view: point-to-plane ICP (Chen and Medioni, "Object modelling by
/// registration of multiple range images", 1992) with projective data association (Blais and Levine, 1995; Newcombe et
/// al., "KinectFusion", ISMAR 2011), Huber weights, coarse to fine; each step solves
///
///     min over xi of  sum_i w_i (n_i . (exp(xi) T p_i - q_i))^2
///
/// by Gauss-Newton. `source.view()` is the first guess; `model` may be another depth image or a map's rendering.
/// None if too few points find a partner, the motion is not observable or the steps do not come to rest at the finest
/// level. The same bits with any number of threads. O(pixels) an iteration. Throws Error for a bad configuration.
inline std::optional<Alignment> align(const DepthSurface& source, const DepthSurface& model,
                                      const AlignmentConfig& config = {}) {
  Check check("AlignmentConfig");
  check.positive("most_apart_m", config.most_apart_m);
  check(config.most_turn_rad > 0 && config.most_turn_rad < std::numbers::pi, "most_turn_rad", config.most_turn_rad,
        "in (0, pi)");
  check.positive("huber_m", config.huber_m);
  check(config.levels >= 1 && config.levels <= 6, "levels", config.levels, "1 to 6");
  check(config.most_iterations >= 1 && config.most_iterations <= 1000, "most_iterations", config.most_iterations,
        "1 to 1000");
  check.positive("least_step_m", config.least_step_m);
  check(config.least_overlap > 0 && config.least_overlap <= 1, "least_overlap", config.least_overlap, "in (0, 1]");
  check(config.least_conditioning >= 0 && config.least_conditioning < 1, "least_conditioning",
        config.least_conditioning, "in [0, 1)");
  check.done();

  Alignment result;
  Eigen::Isometry3d T = model.view().T_C_W() * source.view().T_W_C;
  const auto [source_centre, size_m] = detail::centre_and_size(source);
  if (!(size_m > 0)) return std::nullopt;
  bool at_rest = false;
  for (int level = config.levels - 1; level >= 0; --level) {
    const int stride = 1 << level;
    at_rest = false;
    for (int k = 0; k < config.most_iterations && !at_rest; ++k) {
      const Eigen::Vector3d centre = T * source_centre;
      const detail::NormalEquations e =
          detail::linearise(source, model, T, centre, size_m, stride, config.most_apart_m * stride, config);
      const auto pairs = static_cast<double>(e.pairs);
      result.pairs = e.pairs;
      result.overlap = e.points == 0 ? 0 : pairs / static_cast<double>(e.points);
      if (e.pairs < 6 || result.overlap < config.least_overlap) return std::nullopt;
      result.rms_m = std::sqrt(e.squares / pairs);
      const SymmetricEigen<6> eigen(e.A);
      result.conditioning = std::max(0.0, eigen.smallest()) / eigen.largest();
      if (!(result.conditioning >= config.least_conditioning) || !(eigen.smallest() > 0)) return std::nullopt;

      const Eigen::Matrix<double, 6, 1> xi = -eigen.solve(e.b);
      const Eigen::Vector3d turn = xi.head<3>() / size_m;
      if (!xi.allFinite()) return std::nullopt;
      const Eigen::AngleAxisd rotation(turn.norm(), turn.norm() > 0 ? turn.normalized() : Eigen::Vector3d::UnitX());
      const Eigen::Matrix3d R = rotation.toRotationMatrix();
      T.translation() = R * (T.translation() - centre) + centre + xi.tail<3>();
      T.linear() = R * T.linear();
      ++result.iterations;
      at_rest = xi.norm() < config.least_step_m;
    }
  }
  if (!at_rest) return std::nullopt;
  result.view.T_W_C = model.view().T_W_C * T;
  result.view.T_W_C.linear() = Eigen::Quaterniond(result.view.T_W_C.linear()).normalized().toRotationMatrix();
  return result;
}

}  // namespace vantage

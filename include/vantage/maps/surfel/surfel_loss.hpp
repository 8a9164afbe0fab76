// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <tbb/enumerable_thread_specific.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/maps/surfel/padded_rows.hpp>
#include <vantage/maps/surfel/rendered_normals.hpp>
#include <vantage/maps/surfel/smoothness.hpp>

namespace vantage {

/// Weights of eq. 6.5.
struct LossWeights {
  double colour = 1, depth = 0.8, consistency = 0.1, smoothness = 0.1;  ///< >= 0

  void validate() const {
    Check check("LossWeights");
    check.not_negative("colour", colour);
    check.not_negative("depth", depth);
    check.not_negative("consistency", consistency);
    check.not_negative("smoothness", smoothness);
    check.done();
  }
};

/// Terms of the loss of a frame, not weighted: each a mean over all pixels of the image.
struct LossTerms {
  double colour = 0, depth = 0, consistency = 0, smoothness = 0;

  [[nodiscard]] double total(const LossWeights& w) const {
    return w.colour * colour + w.depth * depth + w.consistency * consistency + w.smoothness * smoothness;
  }
  LossTerms& operator+=(const LossTerms& o) {
    colour += o.colour, depth += o.depth, consistency += o.consistency, smoothness += o.smoothness;
    return *this;
  }
};

/// The loss of a rendered frame (eq. 6.5) and its derivatives by the images. With O the opacity, D* the measured depth
/// (0 = none), n = N / |N| where O > 0.01 and 0 elsewhere, n_D the normal of the rendered depth (DepthNormalRows, of
/// pixels with O > 0.01):
///
///     colour       mean |C - C*| [O > 1e-3]            over channels as well
///     depth        mean |D - D*| [D* > 0]
///     consistency  mean (1 - n . n_D) [O > 1e-3]       by n and, through n_D, by D
///     smoothness   mean over 4 neighbours of Variation
///
/// O decides only what counts; its derivative is 0. Exact, but for the kinks. Concurrent calls are safe; the same bits
/// with any number of threads. O(pixels). T is double in tests.
template <class Variation = EdgeAwareVariation, class T = float>
class SurfelLoss {
 public:
  static constexpr Eigen::Index block_rows = 16;  ///< that are computed together, and summed

  explicit SurfelLoss(const LossWeights& weights = {}) : weights_(weights) { weights.validate(); }
  [[nodiscard]] const LossWeights& weights() const { return weights_; }

  /// `drawn`: r, g, b, depth (NaN = nothing), opacity, x, y, z (normal). `target.colour(channel, row, out)` and
  /// `target.depth(row, out)` write a row of what was measured (0 = no depth). `gradient`: colour.r, .g, .b, depth,
  /// normal_x, normal_y, normal_z are resized and written. Images are of the camera's size.
  template <class Drawn, class Target, class Gradient>
  LossTerms operator()(const Camera& camera, const Drawn& drawn, const Target& target, Gradient& gradient) const {
    for (Image<T>* image : {&gradient.colour.r, &gradient.colour.g, &gradient.colour.b, &gradient.depth,
                            &gradient.normal_x, &gradient.normal_y, &gradient.normal_z})
      image->resize(camera.height, camera.width);
    const PixelRays<T> rays(camera);
    return parallel_sum(static_cast<std::size_t>(camera.height), block_rows, LossTerms{},
                        [&](std::size_t begin, std::size_t end) {
                          Block& block = blocks_.local();
                          return block(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end), camera,
                                       weights_, rays, drawn, target, gradient);
                        });
  }

 private:
  using Row = Eigen::Array<T, 1, Eigen::Dynamic>;
  enum Plane : Eigen::Index {
    depth,
    valid,
    nx,
    ny,
    nz,
    length,
    counts,
    measured,
    star,
    ax,
    ay,
    az,
    bx,
    by,
    bz,
    sx,
    sy,
    sz,
    planes
  };

  // What a thread needs for one block of rows; scratch row r is image row first + r - 2.
  struct Block {
    PaddedRows<T> rows;
    DepthNormalRows<T> surface;
    Row penalty, factor, weight, dot, dx, dy, dz, up_x, up_y, up_z;
    typename DepthNormalRows<T>::Vectors g;  // of the loss by n

    template <class Drawn, class Target, class Gradient>
    LossTerms operator()(Eigen::Index first, Eigen::Index last, const Camera& camera, const LossWeights& weights,
                         const PixelRays<T>& rays, const Drawn& drawn, const Target& target, Gradient& gradient) {
      const Eigen::Index height = camera.height, width = camera.width, shift = 2 - first;
      const double pixels = static_cast<double>(height) * static_cast<double>(width);
      rows.resize(planes, block_rows + 4, width);
      g.resize(width);
      LossTerms terms;
      for (Eigen::Index v = first - 2; v < last + 2; ++v) prepare(v, v + shift, height, drawn, target);
      const auto by_consistency = static_cast<T>(weights.consistency / pixels);
      for (Eigen::Index v = first - 1; v < last + 1; ++v) {
        const bool own = v >= first && v < last;
        const double sum = curve(v, v + shift, height, rays, by_consistency);
        if (own) terms.consistency += sum / pixels;
      }
      const auto by_smoothness = static_cast<T>(weights.smoothness / (4 * pixels));
      for (Eigen::Index v = first; v < last; ++v) {
        const Eigen::Index r = v + shift;
        g.x.setZero(width), g.y.setZero(width), g.z.setZero(width);
        if (v == first && v > 0) vertical(r - 1, by_smoothness);
        if (v > 0) g.x -= up_x, g.y -= up_y, g.z -= up_z;
        terms.smoothness += horizontal(r, by_smoothness) / (4 * pixels);
        if (v + 1 < height) {
          terms.smoothness += vertical(r, by_smoothness) / (4 * pixels);
          g.x += up_x, g.y += up_y, g.z += up_z;
        }
        weight = by_consistency * rows(counts, r);
        g.x -= weight * rows(sx, r);
        g.y -= weight * rows(sy, r);
        g.z -= weight * rows(sz, r);
        dot = rows(nx, r) * g.x + rows(ny, r) * g.y + rows(nz, r) * g.z;
        gradient.normal_x.row(v) = (g.x - rows(nx, r) * dot) * rows(length, r);
        gradient.normal_y.row(v) = (g.y - rows(ny, r) * dot) * rows(length, r);
        gradient.normal_z.row(v) = (g.z - rows(nz, r) * dot) * rows(length, r);

        weight = rows(depth, r) - rows(star, r);
        terms.depth += static_cast<double>((weight.abs() * rows(measured, r)).sum()) / pixels;
        gradient.depth.row(v) =
            static_cast<T>(weights.depth / pixels) * weight.sign() * rows(measured, r) + bend(r, rays, v);
        terms.colour += colour(0, v, r, drawn.r, target, weights, pixels, gradient.colour.r) +
                        colour(1, v, r, drawn.g, target, weights, pixels, gradient.colour.g) +
                        colour(2, v, r, drawn.b, target, weights, pixels, gradient.colour.b);
      }
      return terms;
    }

    // Reads a row of the images: depth without NaN, masks, unit normals. Rows outside of the image are 0.
    template <class Drawn, class Target>
    void prepare(Eigen::Index v, Eigen::Index r, Eigen::Index height, const Drawn& drawn, const Target& target) {
      if (v < 0 || v >= height) {
        for (Eigen::Index p = 0; p < planes; ++p) rows(p, r).setZero();
        return;
      }
      const Eigen::Index width = rows.width();
      const T* const opacity = drawn.opacity.data() + v * width;
      mark_above<T>(opacity, T(0.01), width, rows(valid, r).data());
      mark_above<T>(opacity, T(1e-3), width, rows(counts, r).data());
      const T* const from = drawn.depth.data() + v * width;
      T* const to = rows(depth, r).data();
      for (Eigen::Index u = 0; u < width; ++u) to[u] = from[u] > 0 ? from[u] : 0;
      target.depth(v, rows(star, r).data());
      mark_above<T>(rows(star, r).data(), T(0), width, rows(measured, r).data());
      const auto x = drawn.x.row(v), y = drawn.y.row(v), z = drawn.z.row(v);
      constexpr T least = std::numeric_limits<T>::min();
      weight = x.square() + y.square() + z.square();
      mark_above<T>(weight.data(), least, width, rows(length, r).data());
      rows(length, r) *= rows(valid, r) * (weight + least).rsqrt();
      rows(nx, r) = x * rows(length, r);
      rows(ny, r) = y * rows(length, r);
      rows(nz, r) = z * rows(length, r);
    }

    // Derivatives of the consistency of a row by both arms of its cross products; returns the sum of 1 - n . n_D.
    double curve(Eigen::Index v, Eigen::Index r, Eigen::Index height, const PixelRays<T>& rays, T scale) {
      if (v < 0 || v >= height) {
        for (const Eigen::Index p : {ax, ay, az, bx, by, bz}) rows(p, r).setZero();
        return 0;
      }
      surface(rows, depth, valid, r, rays, v);
      const auto &n = surface.n, &a = surface.a, &b = surface.b;
      dot = rows(nx, r) * n.x + rows(ny, r) * n.y + rows(nz, r) * n.z;
      weight = -scale * rows(counts, r) * surface.inverse;
      g.x = weight * (rows(nx, r) - n.x * dot);  // by S
      g.y = weight * (rows(ny, r) - n.y * dot);
      g.z = weight * (rows(nz, r) - n.z * dot);
      rows(ax, r) = b.y * g.z - b.z * g.y;
      rows(ay, r) = b.z * g.x - b.x * g.z;
      rows(az, r) = b.x * g.y - b.y * g.x;
      rows(bx, r) = g.y * a.z - g.z * a.y;
      rows(by, r) = g.z * a.x - g.x * a.z;
      rows(bz, r) = g.x * a.y - g.y * a.x;
      rows(sx, r) = n.x, rows(sy, r) = n.y, rows(sz, r) = n.z;
      return static_cast<double>((rows(counts, r) * (1 - dot)).sum());
    }

    // Derivative of the consistency by the depths of a row: those that have a pixel of it as an arm, and its own.
    auto bend(Eigen::Index r, const PixelRays<T>& rays, Eigen::Index v) {
      const auto along = [&](Eigen::Index a, Eigen::Index b, Row& out) {
        out = rows(valid, r) * (rows(a, r + 1) - rows(a, r - 1) + rows(b, r, 1) - rows(b, r, -1)) +
              (rows(valid, r + 1) - rows(valid, r - 1)) * rows(a, r) +
              (rows(valid, r, 1) - rows(valid, r, -1)) * rows(b, r);
      };
      along(ax, bx, dx);
      along(ay, by, dy);
      along(az, bz, dz);
      return dx * rays.x.segment(1, rows.width()) + dy * rays.y[v] + dz;
    }

    // Pairs of a row and the one below: derivatives by the upper pixel's normal into up_x, up_y, up_z.
    double vertical(Eigen::Index r, T scale) {
      up_x = rows(nx, r) - rows(nx, r + 1);
      up_y = rows(ny, r) - rows(ny, r + 1);
      up_z = rows(nz, r) - rows(nz, r + 1);
      Variation{}(up_x, up_y, up_z, rows(depth, r) - rows(depth, r + 1), penalty, factor);
      if constexpr (Variation::measured_only)
        weight = rows(measured, r) + rows(measured, r + 1);
      else
        weight.setConstant(rows.width(), 2);
      penalty *= weight;
      weight *= scale;
      up_x *= weight, up_y *= weight, up_z *= weight;
      return static_cast<double>(penalty.sum());
    }

    // Pairs of neighbours within a row, added to the derivatives by n.
    double horizontal(Eigen::Index r, T scale) {
      const Eigen::Index pairs = rows.width() - 1;
      dx = rows(nx, r) - rows(nx, r, 1);
      dy = rows(ny, r) - rows(ny, r, 1);
      dz = rows(nz, r) - rows(nz, r, 1);
      Variation{}(dx, dy, dz, rows(depth, r) - rows(depth, r, 1), penalty, factor);
      if constexpr (Variation::measured_only)
        weight = rows(measured, r) + rows(measured, r, 1);
      else
        weight.setConstant(rows.width(), 2);
      weight[pairs] = 0;  // there is no pixel to the right of the last
      penalty *= weight;
      weight *= scale;
      dx *= weight, dy *= weight, dz *= weight;
      g.x += dx, g.y += dy, g.z += dz;
      g.x.tail(pairs) -= dx.head(pairs);
      g.y.tail(pairs) -= dy.head(pairs);
      g.z.tail(pairs) -= dz.head(pairs);
      return static_cast<double>(penalty.sum());
    }

    template <class Target>
    double colour(int channel, Eigen::Index v, Eigen::Index r, const Image<T>& drawn, const Target& target,
                  const LossWeights& weights, double pixels, Image<T>& gradient) {
      weight.resize(rows.width());
      target.colour(channel, v, weight.data());
      weight = drawn.row(v) - weight;
      const auto sum = static_cast<double>((weight.abs() * rows(counts, r)).sum());
      take_sign(weight.data(), rows.width(), weight.data());
      gradient.row(v) = static_cast<T>(weights.colour / (3 * pixels)) * weight * rows(counts, r);
      return sum / (3 * pixels);
    }
  };

  LossWeights weights_;
  mutable tbb::enumerable_thread_specific<Block> blocks_;
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/io/png.hpp>

namespace vantage {

/// A picture of a rectangle of the ground, +x to the right and +y up, to be drawn on in metres; lines are in pixels,
/// and smooth. What lies outside is cut off. Not shared between threads.
class Canvas {
 public:
  /// The longer side gets `longer_px` pixels, 16 to 8192; throws Error for other sizes, and for an area that is empty.
  Canvas(const Box2& area_m, int longer_px)
      : area_(checked(area_m, longer_px)),
        px_per_m_(longer_px / area_m.sizes().maxCoeff()),
        picture_(side(area_m.sizes().x()), side(area_m.sizes().y())) {}

  [[nodiscard]] const Picture& picture() const { return picture_; }
  [[nodiscard]] double px_per_m() const { return px_per_m_; }
  /// Position on the picture [px] of a point [m], and the point under a pixel's centre.
  [[nodiscard]] Eigen::Vector2d to_px(const Eigen::Vector2d& p) const {
    return {px_per_m_ * (p.x() - area_.min().x()), px_per_m_ * (area_.max().y() - p.y())};
  }
  [[nodiscard]] Eigen::Vector2d centre(int row, int column) const {
    const Eigen::Vector2d p(area_.min().x() + (column + 0.5) / px_per_m_, area_.max().y() - (row + 0.5) / px_per_m_);
    return p.cwiseMax(area_.min()).cwiseMin(area_.max());
  }

  /// Every pixel the colour f(point [m]). f runs concurrently.
  template <class F>
  void fill(F&& f) {
    parallel_for(static_cast<std::size_t>(picture_.height()), [&](std::size_t r) {
      const auto row = static_cast<int>(r);
      for (int column = 0; column < picture_.width(); ++column) picture_(row, column) = f(centre(row, column));
    });
  }
  /// A line where `inside`(point [m]) changes.
  template <class F>
  void outline(F&& inside, Rgb colour, double opacity = 1) {
    const auto at = [&](int row, int column) { return static_cast<bool>(inside(centre(row, column))); };
    for (int row = 0; row + 1 < picture_.height(); ++row)
      for (int column = 0; column + 1 < picture_.width(); ++column) {
        const bool here = at(row, column);
        if (here != at(row, column + 1) || here != at(row + 1, column))
          for (int k = 0; k < 4; ++k) blend(row + k / 2, column + k % 2, colour, 0.5 * opacity);
      }
  }
  void line(const Eigen::Vector2d& a_m, const Eigen::Vector2d& b_m, double width_px, Rgb colour, double opacity = 1) {
    const Eigen::Vector2d a = to_px(a_m), b = to_px(b_m), along = b - a;
    const double length2 = std::max(along.squaredNorm(), 1e-12), half = 0.5 * width_px;
    stroke(a.cwiseMin(b), a.cwiseMax(b), half, colour, opacity, [&](const Eigen::Vector2d& p) {
      const double t = std::clamp((p - a).dot(along) / length2, 0.0, 1.0);
      return (p - a - t * along).norm() - half;
    });
  }
  void dot(const Eigen::Vector2d& p_m, double radius_px, Rgb colour, double opacity = 1) {
    const Eigen::Vector2d centre_px = to_px(p_m);
    stroke(centre_px, centre_px, radius_px, colour, opacity,
           [&](const Eigen::Vector2d& p) { return (p - centre_px).norm() - radius_px; });
  }
  void rectangle(const Box2& box_m, double width_px, Rgb colour, double opacity = 1) {
    const Eigen::Vector2d &a = box_m.min(), &c = box_m.max(), b(c.x(), a.y()), d(a.x(), c.y());
    line(a, b, width_px, colour, opacity);
    line(b, c, width_px, colour, opacity);
    line(c, d, width_px, colour, opacity);
    line(d, a, width_px, colour, opacity);
  }

 private:
  static const Box2& checked(const Box2& area_m, int longer_px) {
    Check check("Canvas");
    check(area_m.min().allFinite() && area_m.max().allFinite() && area(area_m) > 0, "area_m", area(area_m),
          "finite and > 0 m^2");
    check(longer_px >= 16 && longer_px <= 8192, "longer_px", longer_px, "16 to 8192");
    check.done();
    return area_m;
  }
  [[nodiscard]] int side(double length_m) const {
    return std::max(1, static_cast<int>(std::lround(length_m * px_per_m_)));
  }

  // Pixels within `reach` of the box [low, high], covered by how far (signed, in pixels) they are from the shape's
  // edge.
  template <class Distance>
  void stroke(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double reach, Rgb colour, double opacity,
              Distance&& distance) {
    const auto first = [&](double v) { return static_cast<int>(std::floor(std::clamp(v - reach - 1, -1.0, 1e6))); };
    const auto last = [&](double v) { return static_cast<int>(std::ceil(std::clamp(v + reach + 1, -1.0, 1e6))); };
    for (int row = std::max(0, first(low.y())); row < std::min(picture_.height(), last(high.y())); ++row)
      for (int column = std::max(0, first(low.x())); column < std::min(picture_.width(), last(high.x())); ++column)
        blend(row, column, colour,
              opacity * std::clamp(0.5 - distance(Eigen::Vector2d(column + 0.5, row + 0.5)), 0.0, 1.0));
  }
  void blend(int row, int column, Rgb colour, double opacity) {
    Rgb& pixel = picture_(row, column);
    for (std::size_t k = 0; k < 3; ++k)
      pixel[k] = static_cast<std::uint8_t>(std::lround((1 - opacity) * pixel[k] + opacity * colour[k]));
  }

  Box2 area_;
  double px_per_m_;
  Picture picture_;
};

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/assert.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/image.hpp>

namespace vantage {

/// What a field's values are: "elevation" in "m".
struct Quantity {
  std::string name = "value";
  std::string unit = {};  ///< empty: unitless or not known
};

/// One known value of a field: where [m], and what, in the field's unit; NaN = no value there.
struct FieldSample {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double value = std::numeric_limits<double>::quiet_NaN();
};

/// Samples as a file lists them, before they become a world: positions in one unit of length along both axes (any), or
/// in metres.
struct FieldSamples {
  std::vector<FieldSample> samples;
  Quantity quantity;
  /// Of longitudes and latitudes: the latitude by whose cosine x is shortened; lengths are in degrees of latitude.
  std::optional<double> latitude_deg = {};
};

/// A scalar field that is known everywhere, as a raster over a rectangle of the plane z = 0: the truth of a world.
///
/// values()(row, column): rows along +y, columns along +x of area() [m], each pixel the value at its centre, in the
/// field's unit; NaN = masked (outside of the field, on land, ...). Immutable; safe to read from any thread.
class ScalarField {
 public:
  /// Throws Error if the area is not finite or empty, if there is no pixel or more than 2^28, if a value is infinite,
  /// or if all are masked. O(pixels).
  ScalarField(const Box2& area_m, Image<double> values, Quantity quantity = {})
      : area_(area_m), values_(std::move(values)), quantity_(std::move(quantity)) {
    if (!is_proper(area_))
      throw Error("ScalarField", "the area is empty or not finite", "a rectangle with sides > 0 m");
    constexpr Eigen::Index most = Eigen::Index{1} << 28;
    if (values_.size() == 0 || values_.size() > most)
      throw Error("ScalarField", concat(values_.rows(), " x ", values_.cols(), " pixels"), concat("1 to ", most));
    pixel_m_ =
        area_.sizes().cwiseQuotient(Eigen::Vector2d(static_cast<double>(columns()), static_cast<double>(rows())));
    for (Eigen::Index row = 0; row < rows(); ++row)
      for (Eigen::Index column = 0; column < columns(); ++column) {
        const double v = values_(row, column);
        if (std::isinf(v))
          throw Error("ScalarField", concat("value ", v, " at row ", row, ", column ", column),
                      "finite, or NaN = masked");
        if (std::isnan(v)) continue;
        minimum_ = std::min(minimum_, v);
        maximum_ = std::max(maximum_, v);
        ++valid_;
      }
    if (valid_ == 0) throw Error("ScalarField", "every pixel is masked", "at least one value");
  }

  [[nodiscard]] const Box2& area() const { return area_; }
  [[nodiscard]] const Image<double>& values() const { return values_; }
  [[nodiscard]] const Quantity& quantity() const { return quantity_; }
  [[nodiscard]] Eigen::Index rows() const { return values_.rows(); }
  [[nodiscard]] Eigen::Index columns() const { return values_.cols(); }
  [[nodiscard]] Eigen::Index valid_pixels() const { return valid_; }
  /// Of the pixels that are not masked, in the field's unit.
  [[nodiscard]] double minimum() const { return minimum_; }
  [[nodiscard]] double maximum() const { return maximum_; }
  [[nodiscard]] double range() const { return maximum_ - minimum_; }
  /// Width and height of a pixel [m].
  [[nodiscard]] const Eigen::Vector2d& pixel_m() const { return pixel_m_; }
  [[nodiscard]] Eigen::Vector2d centre(Eigen::Index row, Eigen::Index column) const {
    return area_.min() +
           pixel_m_.cwiseProduct(Eigen::Vector2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5));
  }

  /// The pixel that holds `p` [m]; NaN if it is masked, or if `p` is outside or not finite. O(1).
  [[nodiscard]] double at(const Eigen::Vector2d& p) const {
    if (!area_.contains(p)) return std::numeric_limits<double>::quiet_NaN();
    const Eigen::Vector2d t = (p - area_.min()).cwiseQuotient(pixel_m_);
    return values_(std::min(static_cast<Eigen::Index>(t.y()), rows() - 1),
                   std::min(static_cast<Eigen::Index>(t.x()), columns() - 1));
  }

  /// The average over a rectangle [m] (eq. 3.1 for the truth), each pixel weighted by the area it shares with it;
  /// masked and outer parts do not count; NaN if nothing is left. O(pixels touched).
  [[nodiscard]] double average(const Box2& rectangle_m) const {
    const Box2 box = rectangle_m.intersection(area_);
    if (!is_proper(box)) return std::numeric_limits<double>::quiet_NaN();
    const Eigen::Vector2d low = (box.min() - area_.min()).cwiseQuotient(pixel_m_);
    const Eigen::Vector2d high = (box.max() - area_.min()).cwiseQuotient(pixel_m_);
    const auto overlap = [](double a, double b, Eigen::Index i) {
      return std::min(b, static_cast<double>(i + 1)) - std::max(a, static_cast<double>(i));
    };
    double sum = 0, weight = 0;
    for (auto row = static_cast<Eigen::Index>(low.y()); row < rows() && static_cast<double>(row) < high.y(); ++row)
      for (auto column = static_cast<Eigen::Index>(low.x());
           column < columns() && static_cast<double>(column) < high.x(); ++column) {
        const double v = values_(row, column), w = overlap(low.y(), high.y(), row) * overlap(low.x(), high.x(), column);
        if (std::isnan(v)) continue;
        sum += w * v;
        weight += w;
      }
    return weight > 0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  Box2 area_;
  Image<double> values_;
  Quantity quantity_;
  Eigen::Vector2d pixel_m_ = Eigen::Vector2d::Zero();
  Eigen::Index valid_ = 0;
  double minimum_ = std::numeric_limits<double>::infinity(), maximum_ = -minimum_;
};

}  // namespace vantage

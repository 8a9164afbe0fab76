// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>

#include <vantage/concepts/map.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/scalar_field.hpp>

namespace vantage {

/// How good a field map is, against the truth at the truth's resolution (section 3.2.1). Masked pixels do not count,
/// nor do those that no cell covers.
struct FieldMetrics {
  double rmse = 0;           ///< root mean square error, in the field's unit
  double rmse_hotspots = 0;  ///< the same where the truth is hot; NaN if it is nowhere
  double iou = 0;         ///< intersection over union of the hot pixels of mean and truth, [0, 1]; 1 if neither has any
  std::size_t cells = 0;  ///< of the map
  std::size_t pixels = 0;          ///< that count
  std::size_t hotspot_pixels = 0;  ///< of the truth, that count
};

/// Says which known values are hot: the interest policy of merging and planning, or any type with this one member.
template <class I>
concept HotspotRule = requires(const I i, double value) {
  { i.hot(value) } -> std::convertible_to<bool>;
};

/// Compares a map's means with the truth. A pixel belongs to the cell that holds its centre; on an edge, to the upper
/// right one. The same bits with any number of threads. Throws Error if nothing of the truth lies in the map, or
/// if a mean is not finite. O(pixels + cells): cells are drawn, pixels not looked up.
template <FieldMap M, HotspotRule Interest>
FieldMetrics field_metrics(const M& map, const ScalarField& truth, const Interest& interest) {
  struct Sums {
    double all = 0, hot = 0;
    std::size_t pixels = 0, hot_truth = 0, both = 0, either = 0;
    bool finite = true;
    Sums& operator+=(const Sums& s) {
      all += s.all;
      hot += s.hot;
      pixels += s.pixels;
      hot_truth += s.hot_truth;
      both += s.both;
      either += s.either;
      finite = finite && s.finite;
      return *this;
    }
  };
  // The first pixel whose centre is not below an edge [m]; as neighbours share their edge, no pixel falls between.
  const auto first = [](double edge_m, double origin_m, double pixel_m, Eigen::Index n) {
    return static_cast<Eigen::Index>(
        std::clamp(std::ceil((edge_m - origin_m) / pixel_m - 0.5 - 1e-9), 0.0, static_cast<double>(n)));
  };
  const Box2& area = truth.area();
  const Eigen::Vector2d& pixel = truth.pixel_m();
  const Image<double>& values = truth.values();
  const auto cells = static_cast<std::size_t>(map.size());
  const Sums sums = parallel_sum(cells, 256, Sums{}, [&](std::size_t begin, std::size_t end) {
    Sums s;
    for (std::size_t i = begin; i < end; ++i) {
      const Box2 cell = map.cell(i);
      const double mean = map.mean(i);
      if (!std::isfinite(mean)) {
        s.finite = false;
        continue;
      }
      const bool hot_mean = interest.hot(mean);
      const Eigen::Index left = first(cell.min().x(), area.min().x(), pixel.x(), truth.columns());
      const Eigen::Index right = first(cell.max().x(), area.min().x(), pixel.x(), truth.columns());
      const Eigen::Index bottom = first(cell.min().y(), area.min().y(), pixel.y(), truth.rows());
      const Eigen::Index top = first(cell.max().y(), area.min().y(), pixel.y(), truth.rows());
      for (Eigen::Index row = bottom; row < top; ++row)
        for (Eigen::Index column = left; column < right; ++column) {
          const double value = values(row, column);
          if (std::isnan(value)) continue;
          const double squared = (mean - value) * (mean - value);
          const bool hot = interest.hot(value);
          s.all += squared;
          s.hot += hot ? squared : 0.0;
          ++s.pixels;
          s.hot_truth += hot;
          s.both += hot && hot_mean;
          s.either += hot || hot_mean;
        }
    }
    return s;
  });
  if (!sums.finite) throw Error("field_metrics", "a mean of the map is not finite", "finite means");
  if (sums.pixels == 0)
    throw Error("field_metrics", "no pixel of the truth lies in the map", "a map and a truth that overlap");
  const auto root_mean = [](double sum, std::size_t n) {
    return n ? std::sqrt(sum / static_cast<double>(n)) : std::numeric_limits<double>::quiet_NaN();
  };
  return {.rmse = root_mean(sums.all, sums.pixels),
          .rmse_hotspots = root_mean(sums.hot, sums.hot_truth),
          .iou = sums.either ? static_cast<double>(sums.both) / static_cast<double>(sums.either) : 1.0,
          .cells = cells,
          .pixels = sums.pixels,
          .hotspot_pixels = sums.hot_truth};
}

/// Root mean square error of a map's means at single points, such as the samples that were held out of the truth; in
/// the field's unit. Throws Error if there are none, or for one outside of the map. O(samples) look-ups.
template <FieldMap M>
double rmse_at(const M& map, std::span<const FieldSample> samples) {
  if (samples.empty()) throw Error("rmse_at", "no samples", "at least one");
  double sum = 0;
  for (const FieldSample& s : samples) {
    const double error = map.mean(map.cell_at(s.position)) - s.value;
    sum += error * error;
  }
  if (!std::isfinite(sum)) throw Error("rmse_at", "a sample or a mean is not finite", "finite numbers");
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

}  // namespace vantage

// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/maps/field/nd_tree.hpp>

namespace vantage {

/// Measurements of l cells: which, their values y and the diagonal of R (section 3.1.3). Cells ascend.
struct CellMeasurements {
  std::vector<std::size_t> cells;
  Eigen::VectorXd value, noise_variance;
  std::vector<std::size_t> blank = {};  ///< other cells, seen without any value: masked, on land, outside of the field
};

/// <thesis>: sigma_a^2 = alpha h.
struct VarianceGrowsWithHeight {
  static constexpr std::string_view name = "variance_alpha_h";
  static double variance(double alpha, double height_m) { return alpha * height_m; }
};
/// <reference>: sigma_a = alpha h.
struct DeviationGrowsWithHeight {
  static constexpr std::string_view name = "deviation_alpha_h";
  static double variance(double alpha, double height_m) { return alpha * alpha * height_m * height_m; }
};

/// <thesis>: a cell that is seen in part is measured with sigma_c^2 = beta (1 - a_cover / a_c) more noise.
struct WeighPartial {
  static constexpr std::string_view name = "weigh_partial";
  double beta = 0.1;  ///< >= 0, in the field's unit squared; the thesis gives no value, 0 = full weight
  [[nodiscard]] bool takes(double) const { return true; }
  [[nodiscard]] double variance(double cover) const { return beta * (1 - cover); }
};
/// <reference>, adaptive maps: cells that are seen in part are left out.
struct SkipPartial {
  static constexpr std::string_view name = "skip_partial";
  static constexpr double beta = 0;
  [[nodiscard]] static bool takes(double cover) { return cover >= 1 - 1e-6; }
  [[nodiscard]] static double variance(double) { return 0; }
};

/// <reference>, fixed maps: cells that are seen in part count in full.
struct CountPartial {
  static constexpr std::string_view name = "count_partial";
  static constexpr double beta = 0;
  [[nodiscard]] static bool takes(double) { return true; }
  [[nodiscard]] static double variance(double) { return 0; }
};

/// Sensor model of section 3.1.3 (Fig. 3.2): a cell's measurement is the mean of the pixels whose centres lie in it,
/// with noise that grows with height and with the part of the cell that was not seen. Immutable; thread-safe.
template <class HeightNoise = VarianceGrowsWithHeight, class PartialCells = WeighPartial>
struct CellSensor {
  using HeightNoiseType = HeightNoise;
  using PartialCellsType = PartialCells;
  NadirSensor camera = {};
  double alpha = 0.03;  ///< > 0, in the field's unit (squared, if it is the variance that grows) a metre
  PartialCells partial = {};

  void validate() const {
    camera.validate();
    Check check("CellSensor");
    check.positive("alpha", alpha);
    check.not_negative("partial.beta", partial.beta);
    check.done();
  }

  /// The cells that a footprint at a height covers, and R; values are left empty (they are not needed to plan).
  [[nodiscard]] CellMeasurements covered(const NdTree& tree, const Box2& footprint, double height_m) const {
    CellMeasurements m;
    std::vector<double> noise;
    tree.for_each_overlapping(footprint, [&](std::size_t i) { m.cells.push_back(i); });
    std::sort(m.cells.begin(), m.cells.end());
    const double height_variance = HeightNoise::variance(alpha, height_m);
    std::erase_if(m.cells, [&](std::size_t i) {
      const Box2 box = tree.box(i);
      const double cover = std::min(1.0, area(box.intersection(footprint)) / area(box));
      if (!partial.takes(cover)) return true;
      noise.push_back(height_variance + (cover >= 1 - 1e-6 ? 0.0 : partial.variance(cover)));
      return false;
    });
    m.noise_variance = Eigen::Map<const Eigen::VectorXd>(noise.data(), static_cast<Eigen::Index>(noise.size()));
    return m;
  }

  /// The cells that an image measures. Pixels without a value (NaN) do not count; a cell none of whose pixels has one
  /// is blank. Throws Error on an image that is empty or infinite, or whose footprint is empty or not finite.
  [[nodiscard]] CellMeasurements measure(const NdTree& tree, const FieldImage& image) const {
    constexpr std::string_view where = "CellSensor::measure";
    const Box2& f = image.footprint;
    const Image<double>& v = image.values;
    if (!is_proper(f)) throw Error(where, "the footprint is empty or not finite", "a rectangle of positive area");
    if (v.size() == 0) throw Error(where, "the image has no pixels", "at least one");
    if (v.isInf().any()) throw Error(where, "a pixel is infinite", "finite values, or NaN where there is none");
    const double height_m = image.view.position().z();
    if (!(std::isfinite(height_m) && height_m > 0)) throw Error(where, concat("height ", height_m, " m"), "above 0");
    if (area(f.intersection(tree.config().area)) <= 0)
      throw Error(where, concat("the footprint ", f.min().transpose(), " to ", f.max().transpose(), " is off the map"),
                  concat("an overlap with ", tree.config().area.min().transpose(), " to ",
                         tree.config().area.max().transpose()));
    const CellMeasurements all = covered(tree, f, height_m);
    CellMeasurements m;
    std::vector<double> value, noise;
    for (std::size_t k = 0; k < all.cells.size(); ++k) {
      const Box2 box = tree.box(all.cells[k]);
      const auto [c0, c1] = pixels(box.min().x(), box.max().x(), f.min().x(), f.max().x(), v.cols());
      const auto [r0, r1] = pixels(box.min().y(), box.max().y(), f.min().y(), f.max().y(), v.rows());
      double sum = 0;
      Eigen::Index seen = 0;
      for (Eigen::Index r = r0; r < r1; ++r)
        for (Eigen::Index c = c0; c < c1; ++c)
          if (!std::isnan(v(r, c))) {
            sum += v(r, c);
            ++seen;
          }
      if (seen == 0) {
        m.blank.push_back(all.cells[k]);
        continue;
      }
      m.cells.push_back(all.cells[k]);
      value.push_back(sum / static_cast<double>(seen));
      noise.push_back(all.noise_variance[static_cast<Eigen::Index>(k)]);
    }
    m.value = Eigen::Map<const Eigen::VectorXd>(value.data(), static_cast<Eigen::Index>(value.size()));
    m.noise_variance = Eigen::Map<const Eigen::VectorXd>(noise.data(), static_cast<Eigen::Index>(noise.size()));
    return m;
  }

 private:
  // Pixels [first, last) of n along an axis whose centres lie inside (low, high); the nearest one if there is none. A
  // centre on an edge between two cells counts for neither, so that no noise is shared.
  static std::pair<Eigen::Index, Eigen::Index> pixels(double low, double high, double from, double to, Eigen::Index n) {
    const double pixel = (to - from) / static_cast<double>(n), slack = 1e-6;
    auto first =
        static_cast<Eigen::Index>(std::clamp(std::floor((low - from) / pixel + 0.5 + slack), 0.0, double(n - 1)));
    auto last = static_cast<Eigen::Index>(std::clamp(std::ceil((high - from) / pixel - 0.5 - slack), 1.0, double(n)));
    if (last <= first) last = first + 1;
    return {first, last};
  }
};

}  // namespace vantage

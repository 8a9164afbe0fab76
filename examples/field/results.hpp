// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/maps/field/decompress.hpp>
#include <vantage/mission/record.hpp>

#include "input.hpp"

// What a person looks at when the mission is over: pictures, the map in common formats, the page.
namespace field {

/// Whether a map's belief says how its cells, which stand for averages, covary.
template <class M>
inline constexpr bool decompressible = false;
template <class Kernel, class Belief, class Resolution, class Sensor>
inline constexpr bool decompressible<IntegralGp<Kernel, CellAverage, Belief, Resolution, Sensor>> =
    requires(const Belief b, const NdTree& tree) {
  b.covariance_matrix(tree);
}
|| requires(const Belief b, std::size_t i) { b.covariance(i, i); };

/// A map as numbers, whatever its type: its cells, and rasters at the truth's resolution (rows along +y).
struct Snapshot {
  std::vector<Box2> cell;
  std::vector<double> mean, deviation;
  Image<double> mean_raster, deviation_raster;
  Image<double> decompressed = {};  ///< empty: the map cannot say, or has so many cells that it would take long

  template <FieldMap M>
  Snapshot(const M& map, const ScalarField& truth)
      : mean_raster(truth.rows(), truth.columns()), deviation_raster(mean_raster) {
    for (std::size_t i = 0; i < map.size(); ++i) {
      cell.push_back(map.cell(i));
      mean.push_back(map.mean(i));
      deviation.push_back(std::sqrt(std::max(0.0, map.variance(i))));
    }
    for (Eigen::Index row = 0; row < truth.rows(); ++row)
      for (Eigen::Index column = 0; column < truth.columns(); ++column) {
        const std::size_t i = map.cell_at(truth.centre(row, column));
        mean_raster(row, column) = mean[i];
        deviation_raster(row, column) = deviation[i];
      }
    if constexpr (decompressible<M>)
      if (map.size() <= 2048) {  // its cost grows with the cube of the cells
        const Eigen::Vector2d side = 100 * truth.area().sizes() / truth.area().sizes().maxCoeff();
        const int columns = std::max(1, static_cast<int>(std::lround(side.x()))),
                  rows = std::max(1, static_cast<int>(std::lround(side.y())));
        const Decompressed fine = decompress(map, grid_boxes(truth.area(), columns, rows));
        decompressed = Eigen::Map<const Image<double>>(fine.mean.data(), rows, columns);
      }
  }
};

/// "volcano elevation" from volcano_elevation.
inline std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Writes pictures, map and page into o.out.
void write_results(const Options& o, const Input& input, const Snapshot& map, double threshold,
                   const MissionRecord& record);

}  // namespace field

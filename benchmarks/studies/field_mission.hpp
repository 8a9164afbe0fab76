// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <vantage/eval/field_metrics.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/maps/field/decompress.hpp>
#include <vantage/sampler/lawnmower.hpp>
#include <vantage/selector/in_order.hpp>
#include <vantage/utility/uninformed.hpp>

#include "field_methods.hpp"
#include "statistics.hpp"
#include "table.hpp"
#include "units.hpp"

// The mission of section 3.2.1: one unit of the study of Table 3.1.
namespace study {

/// Sums up the clock's time for mapping.
struct MappingTime {
  double total_s = 0;
  template <class M, class Z>
  void measured(const M&, const Situation&, const Step<Z>& step) {
    total_s += step.mapping_s;
  }
};

/// A map after the mission of section 3.2.1, and what all its updates took, merging included.
template <class MapT>
struct Flown {
  MapT map;
  double construction_s, mapping_s;
  std::vector<View> path;
};

template <class MapT, class Preset>
Flown<MapT> fly(FieldWorld<typename Reading<Preset>::Noise> world, int size) {
  const auto start = std::chrono::steady_clock::now();
  MapT map(map_config<MapT, Preset>(size, FieldTask::mapping));
  const double construction_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Lawnmower lawnmower({.area = world.truth().area(), .height_m = 2.5});
  NbvLoop loop{std::move(map), Uninformed{}, lawnmower, InOrder{}};
  MappingTime time;
  loop.run(world, lawnmower.views().front(), {}, Measurements{lawnmower.views().size()}, MeasuredClock{}, Rng{}, time);
  return {std::move(loop.map), construction_s, time.total_s, lawnmower.views()};
}

/// Fig. 3.4(h): what the map says about 50 x 50 cells, after the mission.
template <class MapT>
ScalarField decompressed(const MapT& map, const Box2& area) {
  constexpr int side = 50;
  const Decompressed d = decompress(map, grid_boxes(area, side, side));
  return {area, Eigen::Map<const Image<double>>(d.mean.data(), side, side)};
}

inline double rmse_between(const ScalarField& estimate, const ScalarField& truth) {
  double squares = 0;
  for (Eigen::Index row = 0; row < truth.rows(); ++row)
    for (Eigen::Index column = 0; column < truth.columns(); ++column) {
      const double error = estimate.at(truth.centre(row, column)) - truth.values()(row, column);
      squares += error * error;
    }
  return std::sqrt(squares / static_cast<double>(truth.rows() * truth.columns()));
}

// A mission of a few milliseconds is flown several times, as the first one warms the caches and the threads up.
inline constexpr double repeat_below_s = 0.2;
inline constexpr std::size_t most_repeats = 5;

template <class MapT, class Preset>
Json run_unit(std::uint64_t seed, std::uint64_t field, int size) {
  const auto world = make_world<Preset>(seed, field);
  std::vector<double> construction_s, mapping_s;
  for (double spent_s = 0; mapping_s.size() < most_repeats && spent_s < repeat_below_s;) {
    const Flown<MapT> flown = fly<MapT, Preset>(world, size);
    construction_s.push_back(flown.construction_s);
    mapping_s.push_back(flown.mapping_s);
    spent_s += flown.construction_s + flown.mapping_s;
    if (mapping_s.size() < most_repeats && spent_s < repeat_below_s) continue;
    const FieldMetrics m = field_metrics(flown.map, world.truth(), flown.map.interest());
    double rmse_decompressed = nan;
    if constexpr (std::is_same_v<MapT, Ours<Preset>>)
      rmse_decompressed = rmse_between(decompressed(flown.map, world.truth().area()), world.truth());
    return {{"rmse", number(m.rmse)},
            {"rmse_decompressed", number(rmse_decompressed)},
            {"rmse_hotspots", number(m.rmse_hotspots)},
            {"iou", number(m.iou)},
            {"mapping_ms", 1e3 * median(mapping_s)},
            {"construction_ms", 1e3 * median(construction_s)},
            {"bytes", flown.map.bytes()},
            {"cells", flown.map.size()},
            {"measurements", flown.path.size()},
            {"missions", mapping_s.size()}};
  }
  throw Error("run_unit", "no mission was flown");
}

}  // namespace study
